/* Vectors of three doubles. */
#ifndef SB_BASE_VEC_H
#define SB_BASE_VEC_H

#include <math.h>

typedef struct sb_vec3 {
    double x, y, z;
} sb_vec3;

static inline sb_vec3 sb_vec(double x, double y, double z)
{
    return (sb_vec3){x, y, z};
}
static inline sb_vec3 sb_add(sb_vec3 a, sb_vec3 b)
{
    return sb_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline sb_vec3 sb_sub(sb_vec3 a, sb_vec3 b)
{
    return sb_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline sb_vec3 sb_scale(sb_vec3 a, double s)
{
    return sb_vec(a.x * s, a.y * s, a.z * s);
}
/* a + s b */
static inline sb_vec3 sb_madd(sb_vec3 a, double s, sb_vec3 b)
{
    return sb_vec(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static inline double sb_dot(sb_vec3 a, sb_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline sb_vec3 sb_cross(sb_vec3 a, sb_vec3 b)
{
    return sb_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double sb_norm(sb_vec3 a)
{
    return sqrt(sb_dot(a, a));
}
/* Returns a / |a|; the zero vector stays zero. */
static inline sb_vec3 sb_normalize(sb_vec3 a)
{
    double length = sb_norm(a);
    return length > 0 ? sb_scale(a, 1 / length) : a;
}
static inline sb_vec3 sb_min(sb_vec3 a, sb_vec3 b)
{
    return sb_vec(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}
static inline sb_vec3 sb_max(sb_vec3 a, sb_vec3 b)
{
    return sb_vec(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}
/* axis: 0, 1 or 2 for x, y or z. */
static inline double sb_component(sb_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline int sb_isfinite(sb_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

#endif

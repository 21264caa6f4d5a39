/* The field's kernel for eight particles at a time. */
#ifndef SB_SURFACE_EIGHT_H
#define SB_SURFACE_EIGHT_H

#include "surface/blocks.h"

#include <string.h>

typedef float sb_eight_floats __attribute__((vector_size(32)));
typedef int32_t sb_eight_ints __attribute__((vector_size(32)));

static inline __attribute__((always_inline)) sb_eight_floats sb_eight_at(const float *values)
{
    sb_eight_floats out;
    memcpy(&out, values, sizeof out);
    return out;
}

/* Cube of the positive part. The part is (t + |t|) / 2, which is exact; comparisons of such long vectors are slow. */
static inline __attribute__((always_inline)) sb_eight_floats sb_eight_cube(sb_eight_floats t)
{
    t = 0.5F * (t + (sb_eight_floats)((sb_eight_ints)t & INT32_MAX));
    return t * t * t;
}

/* All bits set in the lanes before the n-th, n > 0. */
static inline __attribute__((always_inline)) sb_eight_ints sb_eight_before(uint32_t n)
{
    static const int32_t set[16] = {-1, -1, -1, -1, -1, -1, -1, -1};
    sb_eight_ints out;
    memcpy(&out, set + (n < 8 ? 8 - n : 0), sizeof out);
    return out;
}

/* (1 - r^2 scale)^3 for the particles j to j + 7 of `near`, 0 beyond the reach and from `end` on. */
static inline __attribute__((always_inline)) sb_eight_floats
sb_eight_kernel(const sb_near *near, uint32_t j, uint32_t end, const float at[3], float scale)
{
    const sb_eight_floats x = sb_eight_at(near->x + j) - at[0], y = sb_eight_at(near->y + j) - at[1],
                          z = sb_eight_at(near->z + j) - at[2];
    const sb_eight_floats kernel = sb_eight_cube(1 - (x * x + y * y + z * z) * scale);
    return (sb_eight_floats)((sb_eight_ints)kernel & sb_eight_before(end - j));
}

static inline __attribute__((always_inline)) float sb_eight_sum(sb_eight_floats v)
{
    return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

#endif

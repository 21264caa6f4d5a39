/* Finds the nearest point of a mesh, and on which side of an open surface a point lies. */
#include "geometry/solid/tree.h"

/* Returns the point of the segment from a to b nearest to p. */
static sb_vec3 nearest_on_segment(sb_vec3 a, sb_vec3 b, sb_vec3 p)
{
    sb_vec3 along = sb_sub(b, a);
    double length2 = sb_dot(along, along);
    double t = length2 > 0 ? sb_dot(sb_sub(p, a), along) / length2 : 0;
    return t <= 0 ? a : t >= 1 ? b : sb_madd(a, t, along);
}

static double distance2(sb_vec3 a, sb_vec3 b)
{
    sb_vec3 d = sb_sub(a, b);
    return sb_dot(d, d);
}

/* The projection of p is a + (v ab + w ac) / size. It is the nearest point if it lies within the triangle; otherwise
   the nearest point lies on one of the edges that the projection is beyond. */
sb_vec3 sb_solid_nearest_on(const sb_solid_triangle *t, sb_vec3 p)
{
    sb_vec3 ab = sb_sub(t->b, t->a), ac = sb_sub(t->c, t->a), ap = sb_sub(p, t->a);
    double bb = sb_dot(ab, ab), bc = sb_dot(ab, ac), cc = sb_dot(ac, ac);
    double pb = sb_dot(ab, ap), pc = sb_dot(ac, ap);
    double size = bb * cc - bc * bc;
    double v = cc * pb - bc * pc, w = bb * pc - bc * pb;
    bool sliver = size <= 1e-12 * bb * cc;
    if (!sliver && v >= 0 && w >= 0 && v + w <= size) return sb_madd(sb_madd(t->a, v / size, ab), w / size, ac);
    sb_vec3 best = t->a;
    double best2 = HUGE_VAL;
    const sb_vec3 ends[3][2] = {{t->a, t->b}, {t->b, t->c}, {t->c, t->a}};
    const bool beyond[3] = {w<0, v + w> size, v < 0};
    for (int edge = 0; edge < 3; ++edge) {
        if (!sliver && !beyond[edge]) continue;
        sb_vec3 at = nearest_on_segment(ends[edge][0], ends[edge][1], p);
        double d2 = distance2(at, p);
        if (d2 < best2) {
            best2 = d2;
            best = at;
        }
    }
    return best;
}

static sb_vec3 normal_of(const sb_solid_triangle *t)
{
    return sb_normalize(sb_solid_area_vector(t));
}

/* Traverses the tree from near to far and keeps the nearest triangle that counts (NULL: all do). On a tie the first
   triangle is kept. */
static const sb_solid_triangle *find_nearest(const sb_solid *solid, sb_vec3 point, sb_solid_counts *counts,
                                             const void *context, double *limit2, sb_vec3 *nearest)
{
    struct {
        uint32_t node;
        double distance2;
    } stack[SB_SOLID_STACK];
    int depth = 1;
    const sb_solid_triangle *found = NULL;
    stack[0].node = 0;
    stack[0].distance2 = sb_solid_box_distance2(solid->nodes, point);
    while (depth > 0) {
        --depth;
        if (stack[depth].distance2 >= *limit2) continue;
        uint32_t index = stack[depth].node;
        const sb_solid_node *node = solid->nodes + index;
        for (uint32_t i = node->first; i < node->first + node->count; ++i) {
            sb_vec3 at = sb_solid_nearest_on(solid->triangles + i, point);
            double d2 = distance2(at, point);
            if (d2 < *limit2 && (!counts || counts(context, at, normal_of(solid->triangles + i)))) {
                *limit2 = d2;
                *nearest = at;
                found = solid->triangles + i;
            }
        }
        if (node->count > 0) continue;
        uint32_t near = index + 1, far = node->first;
        double near2 = sb_solid_box_distance2(solid->nodes + near, point);
        double far2 = sb_solid_box_distance2(solid->nodes + far, point);
        bool swap = far2 < near2;
        stack[depth].node = swap ? near : far;
        stack[depth++].distance2 = swap ? near2 : far2;
        stack[depth].node = swap ? far : near;
        stack[depth++].distance2 = swap ? far2 : near2;
    }
    return found;
}

double sb_solid_distance_where(const sb_solid *solid, sb_vec3 point, double limit, sb_solid_counts *counts,
                               const void *context, sb_vec3 *nearest, sb_vec3 *normal)
{
    double limit2 = limit > 0 ? limit * limit : 0;
    sb_vec3 at;
    const sb_solid_triangle *found = find_nearest(solid, point, counts, context, &limit2, &at);
    if (!found) return limit;
    if (nearest) *nearest = at;
    if (normal) *normal = normal_of(found);
    return sqrt(limit2);
}

double sb_solid_distance(const sb_solid *solid, sb_vec3 point, double limit, sb_vec3 *nearest, sb_vec3 *normal)
{
    return sb_solid_distance_where(solid, point, limit, NULL, NULL, nearest, normal);
}

/* Returns the angle that a triangle fills around a point on it: its angle at a corner, half a turn on an edge, a
   full turn inside. `near` is the tolerance of "on". */
static double angle_at(const sb_solid_triangle *t, sb_vec3 at, double near)
{
    const sb_vec3 corner[3] = {t->a, t->b, t->c};
    for (int i = 0; i < 3; ++i) {
        if (sb_norm(sb_sub(corner[i], at)) > near) continue;
        sb_vec3 u = sb_sub(corner[(i + 1) % 3], corner[i]);
        sb_vec3 v = sb_sub(corner[(i + 2) % 3], corner[i]);
        return atan2(sb_norm(sb_cross(u, v)), sb_dot(u, v));
    }
    for (int i = 0; i < 3; ++i)
        if (sb_norm(sb_sub(nearest_on_segment(corner[i], corner[(i + 1) % 3], at), at)) <= near) return M_PI;
    return 2 * M_PI;
}

/* The point of the surface nearest to another one, the sum of its triangles' normals there weighted by the angles
   that they fill, and the sum of these angles. */
typedef struct foot {
    sb_vec3 at, normal;
    double angle;
} foot;

static bool find_foot(const sb_solid *solid, sb_vec3 point, foot *out)
{
    double nearest2 = HUGE_VAL;
    sb_vec3 at;
    if (!find_nearest(solid, point, NULL, NULL, &nearest2, &at)) return false;
    /* Finds all triangles that contain the nearest point, within the rounding of coordinates of this size. */
    sb_vec3 size =
        sb_max(sb_max(solid->nodes->max, sb_scale(solid->nodes->min, -1)), sb_max(point, sb_scale(point, -1)));
    double near = 1e-12 * sb_norm(size);
    sb_vec3 normal = {0};
    double angle = 0;
    uint32_t stack[SB_SOLID_STACK] = {0};
    int depth = 1;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const sb_solid_node *node = solid->nodes + index;
        if (sb_solid_box_distance2(node, at) > near * near) continue;
        for (uint32_t i = node->first; i < node->first + node->count; ++i) {
            const sb_solid_triangle *t = solid->triangles + i;
            if (sb_norm(sb_sub(sb_solid_nearest_on(t, at), at)) > near) continue;
            double share = angle_at(t, at, near);
            normal = sb_madd(normal, share, normal_of(t));
            angle += share;
        }
        if (node->count == 0) {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
    }
    *out = (foot){at, normal, angle};
    return true;
}

bool sb_solid_behind(const sb_solid *solid, sb_vec3 point)
{
    foot f;
    return find_foot(solid, point, &f) && sb_dot(sb_sub(point, f.at), f.normal) < 0;
}

bool sb_solid_beside(const sb_solid *solid, sb_vec3 point)
{
    foot f;
    return solid->open_surface && find_foot(solid, point, &f) && f.angle < 1.01 * M_PI;
}

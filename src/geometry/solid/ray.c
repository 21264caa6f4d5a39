/* Casts rays against a mesh. */
#include "geometry/solid/tree.h"

/* Tolerance relative to the triangle: a ray through a shared edge must not pass between its two triangles. */
static const double slack = 1e-10;

/* Returns the distance along the ray at which it enters the node's box, or HUGE_VAL if it misses. */
static double enter(const sb_solid_node *node, sb_vec3 origin, sb_vec3 inverse, double limit)
{
    double begin = 0, end = limit;
    const double low[3] = {(node->min.x - origin.x) * inverse.x, (node->min.y - origin.y) * inverse.y,
                           (node->min.z - origin.z) * inverse.z};
    const double high[3] = {(node->max.x - origin.x) * inverse.x, (node->max.y - origin.y) * inverse.y,
                            (node->max.z - origin.z) * inverse.z};
    for (int axis = 0; axis < 3; ++axis) {
        /* 0 * inf: the ray lies in this face of the box, which therefore does not bound it. */
        if (isnan(low[axis]) || isnan(high[axis])) continue;
        double first = low[axis] < high[axis] ? low[axis] : high[axis];
        double last = low[axis] < high[axis] ? high[axis] : low[axis];
        begin = first > begin ? first : begin;
        end = last < end ? last : end;
    }
    return begin <= end * (1 + slack) ? begin : (double)HUGE_VAL;
}

/* Returns the distance along the ray to the triangle from either side, or a negative number. */
static double hit(const sb_solid_triangle *t, sb_vec3 origin, sb_vec3 direction)
{
    sb_vec3 ab = sb_sub(t->b, t->a), ac = sb_sub(t->c, t->a);
    sb_vec3 normal = sb_cross(ab, ac);
    double facing = sb_dot(normal, direction);
    if (facing == 0) return -1;
    sb_vec3 to = sb_sub(t->a, origin);
    sb_vec3 turned = sb_cross(to, direction);
    double u = sb_dot(ac, turned) / facing;
    double v = -sb_dot(ab, turned) / facing;
    if (!(u >= -slack && v >= -slack && u + v <= 1 + slack)) return -1;
    return sb_dot(to, normal) / facing;
}

double sb_solid_raycast(const sb_solid *solid, sb_vec3 origin, sb_vec3 direction, double limit)
{
    const sb_vec3 inverse = {1 / direction.x, 1 / direction.y, 1 / direction.z};
    struct {
        uint32_t node;
        double enter;
    } stack[SB_SOLID_STACK];
    int depth = 1;
    double best = limit;
    bool found = false;
    stack[0].node = 0;
    stack[0].enter = enter(solid->nodes, origin, inverse, best);
    while (depth > 0) {
        --depth;
        if (stack[depth].enter > best) continue;
        uint32_t index = stack[depth].node;
        const sb_solid_node *node = solid->nodes + index;
        for (uint32_t i = node->first; i < node->first + node->count; ++i) {
            double t = hit(solid->triangles + i, origin, direction);
            if (t > 0 && t <= best) {
                best = t;
                found = true;
            }
        }
        if (node->count > 0) continue;
        uint32_t near = index + 1, far = node->first;
        double near_at = enter(solid->nodes + near, origin, inverse, best);
        double far_at = enter(solid->nodes + far, origin, inverse, best);
        bool swap = far_at < near_at;
        stack[depth].node = swap ? near : far;
        stack[depth++].enter = swap ? near_at : far_at;
        stack[depth].node = swap ? far : near;
        stack[depth++].enter = swap ? far_at : near_at;
    }
    return found ? best : -1;
}

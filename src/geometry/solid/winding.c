/* Computes generalised winding numbers with dipoles for distant nodes: Barill, Dickson, Schmidt, Levin and Jacobson,
   "Fast winding numbers for soups and clouds", ACM Transactions on Graphics 37(4), 2018. */
#include "geometry/solid/tree.h"

/* A node counts as distant from this many of its radii on. The error of the whole sum then stays below 0.01, as the
   test measures. */
static const double far_factor = 4;

/* Returns the radius of a ball around `center` that contains the node's box. */
static double ball_radius(const sb_solid_node *node, sb_vec3 center)
{
    return sb_norm(sb_max(sb_sub(node->max, center), sb_sub(center, node->min)));
}

/* Fills the dipoles of a node and its descendants. Returns the node's area in m^2. */
static double fill_dipole(sb_solid *solid, uint32_t index)
{
    const sb_solid_node *node = solid->nodes + index;
    double area = 0;
    sb_vec3 sum = {0}, moment = {0};
    if (node->count > 0) {
        for (uint32_t i = node->first; i < node->first + node->count; ++i) {
            const sb_solid_triangle *t = solid->triangles + i;
            sb_vec3 vector = sb_solid_area_vector(t);
            sb_vec3 center = sb_scale(sb_add(t->a, sb_add(t->b, t->c)), 1.0 / 3);
            double share = sb_norm(vector);
            area += share;
            sum = sb_add(sum, vector);
            moment = sb_madd(moment, share, center);
        }
    } else {
        const uint32_t child[2] = {index + 1, node->first};
        for (int i = 0; i < 2; ++i) {
            double share = fill_dipole(solid, child[i]);
            area += share;
            sum = sb_add(sum, solid->dipoles[child[i]].area);
            moment = sb_madd(moment, share, solid->dipoles[child[i]].center);
        }
    }
    sb_vec3 center = area > 0 ? sb_scale(moment, 1 / area) : sb_scale(sb_add(node->min, node->max), 0.5);
    solid->dipoles[index] = (sb_solid_dipole){center, sum, ball_radius(node, center)};
    return area;
}

double sb_solid_build_dipoles(sb_solid *solid)
{
    return fill_dipole(solid, 0);
}

/* Returns the solid angle of a triangle seen from p, positive if p is on its back side: tan(angle / 2) = a . (b x c)
   / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|) [van Oosterom, Strackee 1983]. */
static double solid_angle(const sb_solid_triangle *t, sb_vec3 p)
{
    sb_vec3 a = sb_sub(t->a, p), b = sb_sub(t->b, p), c = sb_sub(t->c, p);
    double la = sb_norm(a), lb = sb_norm(b), lc = sb_norm(c);
    double above = sb_dot(a, sb_cross(b, c));
    double below = la * lb * lc + sb_dot(a, b) * lc + sb_dot(b, c) * la + sb_dot(c, a) * lb;
    return above == 0 && below <= 0 ? 0 : 2 * atan2(above, below);
}

double sb_solid_winding(const sb_solid *solid, sb_vec3 point)
{
    uint32_t stack[SB_SOLID_STACK] = {0};
    int depth = 1;
    double sum = 0;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const sb_solid_node *node = solid->nodes + index;
        const sb_solid_dipole *dipole = solid->dipoles + index;
        sb_vec3 arm = sb_sub(dipole->center, point);
        double distance = sb_norm(arm);
        if (distance > far_factor * dipole->radius) {
            sum += sb_dot(arm, dipole->area) / (distance * distance * distance);
        } else if (node->count > 0) {
            for (uint32_t i = node->first; i < node->first + node->count; ++i)
                sum += solid_angle(solid->triangles + i, point);
        } else {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
    }
    return sum / (4 * M_PI);
}

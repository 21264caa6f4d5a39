/* Creates solids and decides whether a point is inside them. */
#include "geometry/solid/solid.h"

#include "base/memory.h"
#include "geometry/solid/tree.h"

/* Fraction |sum of area vectors| / area above which a mesh encloses no significant volume. */
static const double open_share = 0.9;

sb_status sb_solid_create(const sb_mesh *mesh, sb_role role, sb_solid **solid, sb_error *error)
{
    sb_solid *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the search tree of a mesh");
    made->mesh = mesh;
    made->role = role;
    sb_status status = sb_solid_build_tree(made, error);
    if (status != SB_OK) {
        sb_solid_destroy(made);
        return status;
    }
    double area = sb_solid_build_dipoles(made);
    made->open_surface = mesh->open_surface || sb_norm(made->dipoles[0].area) > open_share * area;
    if (role == SB_ROLE_SOLID && !made->open_surface) {
        sb_mesh_report report;
        status = sb_mesh_diagnose(mesh, &report, error);
        if (status != SB_OK) {
            sb_solid_destroy(made);
            return status;
        }
        made->closed = report.watertight;
    }
    *solid = made;
    return SB_OK;
}

void sb_solid_destroy(sb_solid *solid)
{
    if (!solid) return;
    sb_free(solid->triangles);
    sb_free(solid->nodes);
    sb_free(solid->dipoles);
    sb_free(solid);
}

/* Returns on which side of the edge from a to b the point p lies, seen from above. The result for the edge from b to
   a is exactly opposite, so that no point falls between two triangles that share an edge. */
static double side(sb_vec3 a, sb_vec3 b, sb_vec3 p)
{
    bool swap = b.x < a.x || (b.x == a.x && b.y < a.y);
    sb_vec3 from = swap ? b : a, to = swap ? a : b;
    double s = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    return swap ? -s : s;
}

/* Returns the height of the triangle above p at (x, y). The sides may be all positive or all negative. */
static double height_above(const sb_solid_triangle *t, sb_vec3 p, double ab, double bc, double ca)
{
    double whole = ab + bc + ca;
    return bc / whole * (t->a.z - p.z) + ca / whole * (t->b.z - p.z) + ab / whole * (t->c.z - p.z);
}

/* Whether the triangle is above p: it contains (x, y), including its border, and is higher there. */
static bool covers(const sb_solid_triangle *t, sb_vec3 p)
{
    double ab = side(t->a, t->b, p), bc = side(t->b, t->c, p), ca = side(t->c, t->a, p);
    if (!((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))) return false;
    return ab + bc + ca != 0 && height_above(t, p, ab, bc, ca) > 0;
}

/* Returns +1 or -1 for the side, never 0. A point on the line is treated as shifted infinitesimally along x, and by
   a smaller infinitesimal along y. Each point thus belongs to exactly one of the triangles around it. */
static int strict_side(double s, sb_vec3 a, sb_vec3 b)
{
    double tie = s != 0 ? s : a.y != b.y ? a.y - b.y : b.x - a.x;
    return tie > 0 ? 1 : -1;
}

/* Returns the triangle's contribution to the winding number of p if it is straight above p: 1 if it faces upwards,
   -1 if it faces downwards. */
static int crossing(const sb_solid_triangle *t, sb_vec3 p)
{
    double ab = side(t->a, t->b, p), bc = side(t->b, t->c, p), ca = side(t->c, t->a, p);
    int way = strict_side(ab, t->a, t->b);
    if (strict_side(bc, t->b, t->c) != way || strict_side(ca, t->c, t->a) != way) return 0;
    return ab + bc + ca != 0 && height_above(t, p, ab, bc, ca) > 0 ? way : 0;
}

static bool below_node(const sb_solid_node *node, sb_vec3 p)
{
    return p.x >= node->min.x && p.x <= node->max.x && p.y >= node->min.y && p.y <= node->max.y && p.z < node->max.z;
}

static bool below_surface(const sb_solid *solid, sb_vec3 p)
{
    uint32_t stack[SB_SOLID_STACK] = {0};
    int depth = 1;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const sb_solid_node *node = solid->nodes + index;
        if (!below_node(node, p)) continue;
        for (uint32_t i = node->first; i < node->first + node->count; ++i)
            if (covers(solid->triangles + i, p)) return true;
        if (node->count == 0) {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
    }
    return false;
}

/* Returns the winding number for a closed mesh, exactly, as the sum of the crossings straight above. */
static int closed_winding(const sb_solid *solid, sb_vec3 p)
{
    uint32_t stack[SB_SOLID_STACK] = {0};
    int depth = 1, winding = 0;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const sb_solid_node *node = solid->nodes + index;
        if (!below_node(node, p)) continue;
        for (uint32_t i = node->first; i < node->first + node->count; ++i) winding += crossing(solid->triangles + i, p);
        if (node->count == 0) {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
    }
    return winding;
}

bool sb_solid_contains(const sb_solid *solid, sb_vec3 point)
{
    if (solid->role == SB_ROLE_TERRAIN) return below_surface(solid, point);
    if (solid->open_surface) return sb_solid_behind(solid, point);
    if (sb_solid_box_distance2(solid->nodes, point) > 0) return false;
    return solid->closed ? closed_winding(solid, point) != 0 : fabs(sb_solid_winding(solid, point)) > 0.5;
}

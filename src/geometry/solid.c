#include "geometry/solid.h"

#include "base/memory.h"
#include "geometry/solid_tree.h"

/* Above this share of |sum of area vectors| in the area, a mesh can enclose nothing to speak of. */
static const double sheet_share = 0.9;

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
    made->sheet = mesh->sheet || sb_norm(made->dipoles[0].area) > sheet_share * area;
    if (role == SB_ROLE_SOLID && !made->sheet) {
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

/* On which side of the edge from a to b the point p lies, seen from above: exactly opposite for the
   edge from b to a, so that no point falls between two triangles that share an edge. */
static double side(sb_vec3 a, sb_vec3 b, sb_vec3 p)
{
    bool swap = b.x < a.x || (b.x == a.x && b.y < a.y);
    sb_vec3 from = swap ? b : a, to = swap ? a : b;
    double s = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    return swap ? -s : s;
}

/* How much higher than p the triangle is at (x, y); positive or negative sides count as within. */
static double height_above(const sb_solid_triangle *t, sb_vec3 p, double ab, double bc, double ca)
{
    double whole = ab + bc + ca;
    return bc / whole * (t->a.z - p.z) + ca / whole * (t->b.z - p.z) + ab / whole * (t->c.z - p.z);
}

/* The triangle covers p from above: it holds (x, y), its border included, and is higher there. */
static bool covers(const sb_solid_triangle *t, sb_vec3 p)
{
    double ab = side(t->a, t->b, p), bc = side(t->b, t->c, p), ca = side(t->c, t->a, p);
    if (!((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))) return false;
    return ab + bc + ca != 0 && height_above(t, p, ab, bc, ca) > 0;
}

/* +1 or -1 for the side, never 0: on the line it is that of a point a hair further along x, and a
   hair of that hair along y. So each point belongs to one triangle of those around it. */
static int strict_side(double s, sb_vec3 a, sb_vec3 b)
{
    double tie = s != 0 ? s : a.y != b.y ? a.y - b.y : b.x - a.x;
    return tie > 0 ? 1 : -1;
}

/* What the triangle adds to the winding number of p when it is straight above: 1 when it looks up,
   -1 when it looks down. */
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

/* Winding number of a closed mesh, whole and without rounding: the crossings straight above. */
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
    if (solid->sheet) return sb_solid_behind(solid, point);
    if (sb_solid_box_distance2(solid->nodes, point) > 0) return false;
    return solid->closed ? closed_winding(solid, point) != 0 : fabs(sb_solid_winding(solid, point)) > 0.5;
}

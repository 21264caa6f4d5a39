/* Facets of a model: their outlines, what lies behind their edges, and which of them water can meet. */
#include "base/memory.h"
#include "geometry/facets/cuts.h"
#include "geometry/facets/outlines.h"
#include "geometry/mesh/edges.h"
#include "geometry/model/parts.h"
#include "geometry/solid/solid.h"

#include <math.h>

/* In spacings. TOUCHES: surfaces as near as this touch. BEFORE: distance before a facet at which it is tested whether
   the facet is hidden. CUT: shorter lines in which facets of two bodies cross do not count. */
static const double TOUCHES = 1e-3, BEFORE = 0.02, CUT = 0.02;

/* Sine of the angle up to which edges are on one line. */
static const double STRAIGHT = 1e-6;

/* Most points along one axis at which it is tested whether a facet is hidden. */
enum { SAMPLES_MAX = 64 };

/* In spacings: how far a side of the domain that bodies cut goes on beyond the domain. It is more than a support
   radius, so that water never meets its end. */
static const double BEYOND = 16;

/* Sine of the bend up to which a surface is flat. */
static const double FLAT = 1e-4;

/* In spacings: how far behind an open edge the winding number is taken. It is 1 behind a closed surface, and at most
   about 3/4 beside an opening that is wider than this. */
static const double BEHIND = 0.1, CLOSED = 0.9;

/* Cosine of the bend above which water sees an edge: 45 degrees. */
static const double BENT = 0.7071;

typedef struct builder {
    const sb_scene *scene;
    const sb_model *model;
    const sb_model_space *space;
    double spacing;
    bool *plate;          /* by body: water may be on both sides of its surface */
    sb_outlines *of_body; /* by body; of the domain's sides, by side: of_side */
    sb_outlines of_side[SB_SIDES];
    const sb_outlines *outlines; /* of the present body */
    const bool *kept;            /* of them, those that are not hidden */
    sb_facets *out;
    size_t capacity, edge_capacity;
} builder;

/* Whether the body has a mesh of its own; the sides of the domain have none. */
static bool has_mesh(const builder *b, size_t body)
{
    return b->model->bodies[body].mesh.triangle_count > 0;
}

/* ---- sides of the domain ---- */

static bool is_wall(const builder *b, int side)
{
    return b->scene->domain.side[side] == SB_SIDE_WALL && !(b->model->dimensions == 2 && side / 2 == 1);
}

static sb_vec3 side_normal(int side)
{
    const double n = side % 2 ? -1 : 1;
    return sb_vec(side / 2 == 0 ? n : 0, side / 2 == 1 ? n : 0, side / 2 == 2 ? n : 0);
}

/* Distance of a point from a side, positive within the domain. */
static double from_side(const builder *b, int side, sb_vec3 at)
{
    return sb_dot(side_normal(side), sb_sub(at, side % 2 ? b->model->max : b->model->min));
}

static bool outside_walls(const builder *b, sb_vec3 at)
{
    for (int side = 0; side < SB_SIDES; side++)
        if (is_wall(b, side) && from_side(b, side, at) < 0) return true;
    return false;
}

/* Whether bodies cut the side: where they meet it at less than 45 degrees, they are one bent surface. */
static bool is_cut(const builder *b, int side)
{
    return b->of_side[side].count > 1;
}

/* ---- edges ---- */

/* Which triangles count: those whose normal is (LIKE), or is not (OTHER), that of a facet, or bends from it by less
   than 45 degrees (GENTLE). */
typedef struct normals {
    sb_vec3 normal;
    enum { LIKE, OTHER, GENTLE } which;
} normals;

static bool counts(const void *context, sb_vec3 nearest, sb_vec3 normal)
{
    (void)nearest;
    const normals *of = context;
    const double along = sb_dot(of->normal, normal);
    const bool like = along > 1 - 1e-9;
    return of->which == LIKE ? like : !like && (of->which == OTHER || along >= BENT);
}

static sb_bend bend_of(sb_vec3 normal, sb_vec3 inward, sb_vec3 other)
{
    const double towards = sb_dot(other, inward);
    if (sb_dot(normal, other) >= BENT) return towards > FLAT ? SB_BEND_HOLLOW : SB_BEND_SOFT;
    return towards > 0 ? SB_BEND_CONCAVE : SB_BEND_CONVEX;
}

/* Whether a body fills the corner between a facet and what stands at its edge. A plate fills nothing. */
static bool fills_corner(const builder *b, size_t body, const sb_facet *facet, const sb_facet_edge *edge, sb_vec3 at)
{
    const double away = 2 * TOUCHES * b->spacing;
    return b->plate[body] ||
           sb_solid_contains(b->space->solid[body], sb_madd(at, away, sb_sub(facet->normal, edge->inward)));
}

/* The bend towards one body's surface that touches the edge's middle. Returns false if none does. A side of another
   body that is hidden, because its top continues the facet, does not count. */
static bool bend_towards(const builder *b, size_t body, const sb_facet *facet, sb_facet_edge *edge, sb_vec3 at,
                         sb_bend *bend)
{
    const double near = TOUCHES * b->spacing;
    sb_vec3 normal, nearest;
    normals which = {facet->normal, GENTLE};
    /* A side of the domain ends where a surface cuts it, whatever else of the body touches it there. */
    if (!has_mesh(b, facet->body) &&
        sb_solid_distance_where(b->space->solid[body], at, near, counts, &which, &nearest, &normal) < near) {
        *bend = bend_of(facet->normal, edge->inward, normal);
        return true;
    }
    which.which = OTHER;
    if (sb_solid_distance_where(b->space->solid[body], at, near, counts, &which, &nearest, &normal) < near) {
        *bend = bend_of(facet->normal, edge->inward, normal);
        edge->wall = normal;
        if (*bend != SB_BEND_CONCAVE || body == facet->body || fills_corner(b, body, facet, edge, at)) return true;
    }
    which.which = LIKE;
    const sb_vec3 beyond = sb_madd(at, -2 * near, edge->inward);
    if (sb_solid_distance_where(b->space->solid[body], beyond, near, counts, &which, &nearest, &normal) < near) {
        *bend = SB_BEND_SOFT;
        return true;
    }
    return false;
}

/* Whether a point of an outline's plane lies in it or near its border. */
static bool near_outline(const sb_outline *o, sb_vec3 at, double near)
{
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 from = o->corner[k], along = sb_sub(o->corner[(k + 1) % o->count], from);
        const sb_vec3 inward = o->count == 2 ? along : sb_cross(o->normal, along);
        if (sb_dot(inward, sb_sub(at, from)) < -near * sb_norm(inward)) return false;
    }
    return true;
}

/* Whether another facet of the same body goes on at the edge of outline `self`, bent by less than 45 degrees. What
   stands on both covers a part of them, but they remain one surface. */
static bool goes_on(const builder *b, size_t self, sb_vec3 at)
{
    const double near = TOUCHES * b->spacing;
    const sb_vec3 normal = b->outlines->outline[self].normal;
    for (size_t k = 0; k < b->outlines->count; k++) {
        const sb_outline *o = &b->outlines->outline[k];
        if (k != self && b->kept[k] && sb_dot(o->normal, normal) >= BENT &&
            fabs(sb_dot(o->normal, sb_sub(at, o->corner[0]))) < near && near_outline(o, at, near))
            return true;
    }
    return false;
}

/* Whether an edge lies in a side, or beyond it, from end to end. */
static bool along_side(const builder *b, int side, const sb_facet_edge *edge)
{
    return is_wall(b, side) &&
           fmax(from_side(b, side, edge->from), from_side(b, side, edge->to)) < TOUCHES * b->spacing;
}

/* Whether another body than the facet's own contains a point. */
static bool buried(const builder *b, size_t own, sb_vec3 at)
{
    for (size_t body = 0; body < b->model->body_count; body++)
        if (body != own && has_mesh(b, body) && b->space->solid[body] && sb_solid_contains(b->space->solid[body], at))
            return true;
    return false;
}

/* The middle of the part of an edge that is within the walls; of the whole edge if none is. If another body contains
   it, as the bed contains the foot of a wall, the nearest place on the edge that none contains, of some. */
static sb_vec3 middle_within(const builder *b, size_t own, const sb_facet_edge *edge)
{
    enum { PLACES = 32 };
    double low = 0, high = 1;
    for (int side = 0; side < SB_SIDES; side++) {
        if (!is_wall(b, side)) continue;
        const double from = from_side(b, side, edge->from), to = from_side(b, side, edge->to);
        if (from < 0 && to > 0) low = fmax(low, from / (from - to));
        if (from > 0 && to < 0) high = fmin(high, from / (from - to));
    }
    const double middle = low < high ? (low + high) / 2 : 0.5, half = low < high ? (high - low) / 2 : 0;
    const sb_vec3 along = sb_sub(edge->to, edge->from), at = sb_madd(edge->from, middle, along);
    if (!buried(b, own, at)) return at;
    for (int k = 1; k < PLACES; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const sb_vec3 place = sb_madd(edge->from, middle + sign * half * k / PLACES, along);
            if (!buried(b, own, place)) return place;
        }
    return at;
}

/* self: the facet's outline. Notes the wall at a concave edge. */
static sb_bend find_bend(const builder *b, size_t self, const sb_facet *facet, sb_facet_edge *edge)
{
    const sb_vec3 at = middle_within(b, facet->body, edge);
    sb_bend found = SB_BEND_CONVEX;
    for (int side = 0; side < SB_SIDES; side++)
        if (along_side(b, side, edge) && sb_dot(side_normal(side), edge->inward) > FLAT) {
            edge->wall = side_normal(side);
            return is_cut(b, side) ? bend_of(facet->normal, edge->inward, side_normal(side)) : SB_BEND_CONCAVE;
        }
    for (size_t body = 0; body < b->model->body_count; body++) {
        if (!has_mesh(b, body) || !b->space->solid[body]) continue;
        sb_bend bend;
        edge->wall = (sb_vec3){0};
        if (!bend_towards(b, body, facet, edge, at, &bend)) {
            if (body == facet->body || !sb_solid_contains(b->space->solid[body], at)) continue;
            bend = SB_BEND_CONCAVE;
        }
        if (bend == SB_BEND_CONCAVE) return body != facet->body && goes_on(b, self, at) ? SB_BEND_SOFT : bend;
        if (bend == SB_BEND_HOLLOW || (bend == SB_BEND_SOFT && found == SB_BEND_CONVEX)) found = bend;
    }
    return found;
}

/* ---- facets ---- */

/* Whether water cannot be at a point before a facet of a body. */
static bool covered(const builder *b, sb_vec3 at, size_t body)
{
    if (outside_walls(b, at)) return true;
    for (size_t other = 0; other < b->model->body_count; other++)
        if (other != body && has_mesh(b, other) && b->space->solid[other] && b->model->bodies[other].wavemaker < 0 &&
            sb_solid_contains(b->space->solid[other], at))
            return true;
    return false;
}

static double component(sb_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* The range of an outline's coordinates along an axis, within the domain; and a step through it. */
typedef struct range {
    double low, step;
    int count;
} range;

static range range_of(const builder *b, const sb_outline *o, int axis)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t k = 0; k < o->count; k++) {
        low = fmin(low, component(o->corner[k], axis));
        high = fmax(high, component(o->corner[k], axis));
    }
    low = fmax(low, component(b->model->min, axis));
    high = fmin(high, component(b->model->max, axis));
    const int count = high > low ? (int)fmin(ceil((high - low) / b->spacing), SAMPLES_MAX) : 0;
    return (range){low, count > 0 ? (high - low) / count : 0, count};
}

/* Whether water cannot meet the facet: its middle, its corners and points one spacing apart lie in other bodies, or
   outside of the domain. */
static bool hidden(const builder *b, const sb_outline *o, size_t body, sb_vec3 normal)
{
    const double before = BEFORE * b->spacing;
    sb_vec3 middle = {0};
    for (size_t k = 0; k < o->count; k++) middle = sb_madd(middle, 1.0 / (double)o->count, o->corner[k]);
    if (!covered(b, sb_madd(middle, before, normal), body)) return false;
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 at = sb_madd(middle, 0.98, sb_sub(o->corner[k], middle));
        if (!covered(b, sb_madd(at, before, normal), body)) return false;
    }
    /* Points of a lattice in the two other coordinates, in 2D in one. */
    const double size[3] = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
    const int up = size[2] >= size[0] && size[2] >= size[1] ? 2 : size[0] >= size[1] ? 0 : 1;
    const bool flat = b->model->dimensions == 2;
    const int one = up == 0 ? (flat ? 2 : 1) : 0, other = up == 2 ? 1 : 2;
    const range u = range_of(b, o, one), v = flat ? (range){0, 0, 1} : range_of(b, o, other);
    for (int i = 0; i < u.count; i++)
        for (int j = 0; j < v.count; j++) {
            double x[3] = {0};
            x[one] = u.low + (i + 0.5) * u.step;
            if (!flat) x[other] = v.low + (j + 0.5) * v.step;
            const sb_vec3 foot = sb_vec(x[0], x[1], x[2]);
            x[up] = (sb_dot(normal, o->corner[0]) - sb_dot(normal, foot)) / component(normal, up);
            const sb_vec3 at = sb_vec(x[0], x[1], x[2]);
            if (near_outline(o, at, 0) && !covered(b, sb_madd(at, before, normal), body)) return false;
        }
    return true;
}

/* Whether an edge continues another one on the same line, with the same bend. */
static bool continues(const sb_facet_edge *last, const sb_facet_edge *next)
{
    return last->bend == next->bend && sb_norm(sb_cross(last->wall, next->wall)) < STRAIGHT &&
           sb_norm(sb_cross(last->inward, next->inward)) < STRAIGHT && sb_dot(last->inward, next->inward) > 0;
}

/* Joins the edges of a facet that continue each other. Returns how many are left. */
static uint32_t join_edges(sb_facet_edge *edge, uint32_t count)
{
    uint32_t left = 0;
    for (uint32_t k = 0; k < count; k++)
        if (left > 0 && continues(&edge[left - 1], &edge[k]))
            edge[left - 1].to = edge[k].to;
        else
            edge[left++] = edge[k];
    if (left > 1 && continues(&edge[left - 1], &edge[0])) edge[0].from = edge[--left].from;
    return left;
}

static int add(builder *b, size_t outline, size_t body)
{
    sb_facets *out = b->out;
    const sb_outline *o = &b->outlines->outline[outline];
    if (sb_grow((void **)&out->facets, &b->capacity, out->count + 1, sizeof *out->facets) != 0 ||
        sb_grow((void **)&out->edges, &b->edge_capacity, out->edge_count + o->count, sizeof *out->edges) != 0)
        return -1;
    const bool flat = b->model->dimensions == 2;
    sb_facet *f = &out->facets[out->count++];
    *f = (sb_facet){o->normal,          sb_dot(o->normal, o->corner[0]),
                    (uint32_t)body,     (uint32_t)out->edge_count,
                    (uint32_t)o->count, b->plate[body]};
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 from = o->corner[k], to = flat ? from : o->corner[(k + 1) % o->count];
        const sb_vec3 along = flat ? sb_sub(o->corner[1 - k], from) : sb_cross(o->normal, sb_sub(to, from));
        sb_facet_edge *edge = &out->edges[out->edge_count++];
        *edge = (sb_facet_edge){from, to, sb_normalize(along), SB_BEND_SOFT, {0, 0, 0}};
        edge->bend = find_bend(b, outline, f, edge);
        if (edge->bend != SB_BEND_CONCAVE) edge->wall = (sb_vec3){0};
    }
    if (!flat) f->edges = join_edges(out->edges + f->edge, f->edges);
    out->edge_count = f->edge + f->edges;
    return 0;
}

/* Whether the winding number behind some open edge of a body's mesh is not that of a closed surface. It is where edges
   of the mesh coincide without sharing their corners: nothing is open there. Returns -1 without memory. */
static int is_open(const builder *b, size_t body)
{
    const sb_mesh *mesh = &b->model->bodies[body].mesh;
    const double away = BEHIND * b->spacing;
    sb_mesh_edges edges;
    if (b->model->dimensions == 2 || !b->space->solid[body]) return true;
    if (sb_mesh_find_edges(mesh, &edges) != 0) return -1;
    bool open = false;
    for (size_t k = 0, end = 0; k < edges.count && !open; k = end) {
        const sb_mesh_edge *e = &edges.edges[k];
        end = sb_mesh_edge_run(&edges, k);
        if (end - k != 1) continue;
        const uint32_t *v = mesh->triangles[e->triangle];
        const sb_vec3 from = mesh->vertices[e->forward ? e->low : e->high],
                      to = mesh->vertices[e->forward ? e->high : e->low];
        const sb_vec3 normal = sb_normalize(sb_cross(sb_sub(mesh->vertices[v[1]], mesh->vertices[v[0]]),
                                                     sb_sub(mesh->vertices[v[2]], mesh->vertices[v[0]])));
        const sb_vec3 inward = sb_normalize(sb_cross(normal, sb_sub(to, from)));
        const sb_vec3 behind = sb_madd(sb_scale(sb_add(from, to), 0.5), away, sb_sub(inward, normal));
        open = fabs(sb_solid_winding(b->space->solid[body], behind)) < CLOSED;
    }
    sb_mesh_edges_free(&edges);
    return open;
}

/* Water may be on both sides of the surface of a body that is open. Returns 0, or -1 without memory. */
static int find_plates(builder *b)
{
    b->plate = sb_alloc(b->model->body_count, sizeof *b->plate);
    if (!b->plate) return -1;
    for (size_t k = 0; k < b->model->body_count; k++) {
        const sb_model_body *of = &b->model->bodies[k];
        sb_mesh_report report;
        sb_error error = {0};
        if (!has_mesh(b, k) || of->role == SB_ROLE_TERRAIN || of->mesh.open_surface) continue;
        if (sb_mesh_diagnose(&of->mesh, &report, &error) != SB_OK) return -1;
        const int open = report.watertight ? 0 : is_open(b, k);
        if (open < 0) return -1;
        b->plate[k] = open;
    }
    return 0;
}

/* Whether a body's surface cuts those of others: closed bodies and terrains that do not move. */
static bool cuts(const builder *b, size_t body)
{
    return has_mesh(b, body) && !b->plate[body] && b->model->bodies[body].wavemaker < 0;
}

/* Finds the outlines of all bodies. Where surfaces of two bodies meet at less than 45 degrees, they are one bent
   surface: its facets end at the line in which they meet. */
static int find_outlines(builder *b)
{
    const size_t bodies = b->model->body_count;
    b->of_body = sb_alloc(bodies, sizeof *b->of_body);
    int status = b->of_body ? 0 : -1;
    for (size_t k = 0; k < bodies && status == 0; k++)
        if (has_mesh(b, k))
            status = b->model->dimensions == 2 ? sb_outlines_of_section(b->space->mesh[k], b->spacing, &b->of_body[k])
                                               : sb_outlines_of_mesh(b->space->mesh[k], &b->of_body[k]);
    for (size_t k = 0; k < bodies && status == 0; k++)
        for (size_t by = 0; by < bodies && status == 0; by++)
            if (by != k && cuts(b, k) && cuts(b, by))
                status = sb_outlines_cut(&b->of_body[k], &b->of_body[by], BENT, CUT * b->spacing, 0);
    return status;
}

/* Adds the facets of a body that water can meet. */
static int add_outlines(builder *b, const sb_outlines *outlines, size_t body)
{
    bool *kept = sb_alloc(outlines->count, sizeof *kept);
    int status = kept ? 0 : -1;
    for (size_t k = 0; k < outlines->count && status == 0; k++) {
        const sb_outline *o = &outlines->outline[k];
        kept[k] = !hidden(b, o, body, o->normal) || (b->plate[body] && !hidden(b, o, body, sb_scale(o->normal, -1)));
    }
    b->outlines = outlines;
    b->kept = kept;
    for (size_t k = 0; k < outlines->count && status == 0; k++)
        if (kept[k]) status = add(b, k, body);
    sb_free(kept);
    return status;
}

/* The outline of a side, which goes on beyond the domain: in 2D a segment. Returns 0, or -1 without memory. */
static int outline_side(const builder *b, int side, sb_outlines *out)
{
    const bool flat = b->model->dimensions == 2;
    const double beyond = BEYOND * b->spacing;
    const sb_vec3 n = side_normal(side), reach = sb_vec(beyond, beyond, beyond);
    const sb_vec3 on = side % 2 ? b->model->max : b->model->min;
    const sb_vec3 low = sb_sub(b->model->min, reach), high = sb_add(b->model->max, reach);
    const size_t corners = flat ? 2 : 4;
    out->outline = sb_alloc(1, sizeof *out->outline);
    if (!out->outline) return -1;
    out->capacity = 1;
    out->outline[0] = (sb_outline){.normal = n, .corner = sb_alloc(corners, sizeof(sb_vec3))};
    if (!out->outline[0].corner) return -1;
    out->count = 1;
    out->outline[0].count = corners;
    const int axis = side / 2, u = flat ? 2 - axis : (axis + 1) % 3, v = (axis + 2) % 3;
    for (size_t k = 0; k < corners; k++) {
        double at[3] = {0};
        at[axis] = component(on, axis);
        at[u] = component(k == 0 || k == 3 ? low : high, u);
        if (!flat) at[v] = component(k < 2 ? low : high, v);
        /* counter-clockwise seen along -n: the order turns with the side */
        out->outline[0].corner[side % 2 && !flat ? 3 - k : k] = sb_vec(at[0], at[1], at[2]);
    }
    return 0;
}

/* Whether the domain repeats along a side, whose outline would then meet its own images. */
static bool repeats_along(const builder *b, int side)
{
    for (int other = 0; other < SB_SIDES; other++)
        if (other / 2 != side / 2 && b->scene->domain.side[other] == SB_SIDE_PERIODIC &&
            !(b->model->dimensions == 2 && other / 2 == 1))
            return true;
    return false;
}

/* Cuts the sides by the surfaces of bodies that meet them at less than 45 degrees, and these by the sides. A side that
   no body cuts stays whole. */
static int cut_sides(builder *b)
{
    const double near = CUT * b->spacing;
    int status = 0;
    for (int side = 0; side < SB_SIDES && status == 0; side++) {
        if (!is_wall(b, side) || repeats_along(b, side)) continue;
        sb_outlines *outlines = &b->of_side[side], whole = {0};
        status = outline_side(b, side, outlines);
        if (status == 0) status = outline_side(b, side, &whole);
        for (size_t k = 0; k < b->model->body_count && status == 0; k++)
            if (cuts(b, k)) status = sb_outlines_cut(outlines, &b->of_body[k], BENT, near, near);
        for (size_t k = 0; k < b->model->body_count && status == 0 && is_cut(b, side); k++)
            if (cuts(b, k)) status = sb_outlines_cut(&b->of_body[k], &whole, BENT, near, near);
        sb_outlines_free(&whole);
    }
    return status;
}

static int add_sides(builder *b, size_t body)
{
    for (int side = 0; side < SB_SIDES; side++) {
        if (!is_wall(b, side)) continue;
        if (is_cut(b, side)) {
            if (add_outlines(b, &b->of_side[side], body) != 0) return -1;
            continue;
        }
        if (sb_grow((void **)&b->out->facets, &b->capacity, b->out->count + 1, sizeof *b->out->facets) != 0) return -1;
        const sb_vec3 n = side_normal(side);
        b->out->facets[b->out->count++] = (sb_facet){
            .normal = n, .distance = sb_dot(n, side % 2 ? b->model->max : b->model->min), .body = (uint32_t)body};
    }
    return 0;
}

sb_status sb_model_facets(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    builder b = {.scene = scene, .model = model, .space = space, .spacing = model->spacing, .out = &model->facets};
    int status = find_plates(&b);
    if (status == 0) status = find_outlines(&b);
    if (status == 0) status = cut_sides(&b);
    for (size_t k = 0; k < model->body_count && status == 0; k++)
        status = has_mesh(&b, k) ? add_outlines(&b, &b.of_body[k], k) : add_sides(&b, k);
    for (size_t k = 0; k < model->body_count && b.of_body; k++) sb_outlines_free(&b.of_body[k]);
    for (int side = 0; side < SB_SIDES; side++) sb_outlines_free(&b.of_side[side]);
    sb_free(b.of_body);
    sb_free(b.plate);
    return status == 0 ? SB_OK : sb_fail_memory(error, "facets of walls");
}

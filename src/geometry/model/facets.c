/* Facets of a model: those of bodies and of the domain's sides that water can meet. */
#include "base/memory.h"
#include "geometry/model/facet_parts.h"
#include "geometry/solid/solid.h"
#include "physics/wavemakers/paddle_way.h"

#include <math.h>

/* In spacings: distance before a facet at which it is tested whether the facet is hidden. */
static const double BEFORE = 0.02;

/* Sine of the angle up to which edges are on one line. */
static const double STRAIGHT = 1e-6;

/* Most points along one axis at which it is tested whether a facet is hidden. */
enum { SAMPLES_MAX = 64 };

static bool outside_walls(const sb_facet_builder *b, sb_vec3 at)
{
    at = sb_facets_place(b, SIZE_MAX, at);
    for (int side = 0; side < SB_SIDES; side++)
        if (sb_facets_is_wall(b, side) && sb_facets_from_side(b, side, at) < 0) return true;
    return false;
}

/* Whether water cannot be at a point before a facet of a body. */
static bool covered(const sb_facet_builder *b, sb_vec3 at, size_t body)
{
    if (outside_walls(b, at)) return true;
    for (size_t other = 0; other < b->model->body_count; other++)
        if (other != body && sb_facets_has_mesh(b, other) && b->space->solid[other] &&
            b->model->bodies[other].wavemaker < 0 &&
            sb_solid_contains(b->space->solid[other], sb_facets_place(b, other, at)))
            return true;
    return false;
}

/* The range of an outline's coordinates along an axis, within the domain; and a step through it. */
typedef struct range {
    double low, step;
    int count;
} range;

static range range_of(const sb_facet_builder *b, const sb_outline *o, int axis)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t k = 0; k < o->count; k++) {
        low = fmin(low, sb_component(o->corner[k], axis));
        high = fmax(high, sb_component(o->corner[k], axis));
    }
    low = fmax(low, sb_component(b->model->min, axis));
    high = fmin(high, sb_component(b->model->max, axis));
    const int count = high > low ? (int)fmin(ceil((high - low) / b->spacing), SAMPLES_MAX) : 0;
    return (range){low, count > 0 ? (high - low) / count : 0, count};
}

/* Whether water cannot meet the facet: its middle, its corners and points one spacing apart lie in other bodies, or
   outside of the domain. */
static bool hidden(const sb_facet_builder *b, const sb_outline *o, size_t body, sb_vec3 normal)
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
            x[up] = (sb_dot(normal, o->corner[0]) - sb_dot(normal, foot)) / sb_component(normal, up);
            const sb_vec3 at = sb_vec(x[0], x[1], x[2]);
            if (sb_facets_near_outline(o, at, 0) && !covered(b, sb_madd(at, before, normal), body)) return false;
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

/* Adds a facet that water meets where the body is now. */
static int add(sb_facet_builder *b, size_t outline, size_t body, sb_facet_when when)
{
    sb_facets *out = b->out;
    const sb_outline *o = &b->outlines->outline[outline];
    if (sb_grow((void **)&out->facets, &b->capacity, out->count + 1, sizeof *out->facets) != 0 ||
        sb_grow((void **)&out->edges, &b->edge_capacity, out->edge_count + o->count, sizeof *out->edges) != 0)
        return -1;
    const bool flat = b->model->dimensions == 2;
    sb_facet *f = &out->facets[out->count++];
    *f = (sb_facet){o->normal,
                    sb_dot(o->normal, o->corner[0]),
                    (uint32_t)body,
                    (uint32_t)out->edge_count,
                    (uint32_t)o->count,
                    b->plate[body],
                    when};
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 from = o->corner[k], to = flat ? from : o->corner[(k + 1) % o->count];
        const sb_vec3 along = flat ? sb_sub(o->corner[1 - k], from) : sb_cross(o->normal, sb_sub(to, from));
        sb_facet_edge *edge = &out->edges[out->edge_count++];
        *edge = (sb_facet_edge){from, to, sb_normalize(along), SB_BEND_SOFT, {0, 0, 0}};
        edge->bend = sb_facets_bend(b, outline, f, edge);
        if (edge->bend != SB_BEND_CONCAVE) edge->wall = (sb_vec3){0};
    }
    if (!flat) f->edges = join_edges(out->edges + f->edge, f->edges);
    out->edge_count = f->edge + f->edges;
    return 0;
}

static void find_kept(const sb_facet_builder *b, const sb_outlines *outlines, bool *kept)
{
    for (size_t k = 0; k < outlines->count; k++) {
        const sb_outline *o = &outlines->outline[k];
        kept[k] =
            !hidden(b, o, b->body, o->normal) || (b->plate[b->body] && !hidden(b, o, b->body, sb_scale(o->normal, -1)));
    }
}

static bool same_edges(const sb_facets *facets, const sb_facet *one, const sb_facet *other)
{
    bool same = one->edges == other->edges;
    for (uint32_t k = 0; k < one->edges && same; k++) {
        const sb_facet_edge *a = &facets->edges[one->edge + k], *c = &facets->edges[other->edge + k];
        same = a->bend == c->bend && sb_norm(sb_sub(a->wall, c->wall)) < STRAIGHT &&
               sb_norm(sb_sub(a->from, c->from)) == 0 && sb_norm(sb_sub(a->to, c->to)) == 0;
    }
    return same;
}

/* Adds the facet of an outline at rest and away, as one if nothing differs. One that water meets at rest may be hidden
   away, where a body has run into another one, and is not on the way there: it stays. */
static int add_both(sb_facet_builder *b, size_t outline, size_t body, const bool *kept[2], const sb_vec3 shift[2])
{
    sb_facets *out = b->out;
    for (int away = 0; away < 2; away++) {
        b->shift = shift[away];
        b->kept = kept[away];
        if ((kept[0][outline] || kept[away][outline]) &&
            add(b, outline, body, away ? SB_FACET_AWAY : SB_FACET_AT_REST) != 0)
            return -1;
    }
    if (!kept[0][outline]) return 0;
    sb_facet *rest = &out->facets[out->count - 2], *last = &out->facets[out->count - 1];
    if (!same_edges(out, rest, last)) return 0;
    rest->when = SB_FACET_ALWAYS;
    out->edge_count = last->edge;
    out->count--;
    return 0;
}

/* Adds the facets of a body that water can meet, at rest or when a wave maker has moved it by `away`. */
static int add_outlines(sb_facet_builder *b, const sb_outlines *outlines, size_t body, sb_vec3 away)
{
    const bool moves = sb_norm(away) > 0;
    const sb_vec3 shift[2] = {{0, 0, 0}, away};
    bool *kept[2] = {sb_alloc(outlines->count, sizeof(bool)), sb_alloc(outlines->count, sizeof(bool))};
    int status = kept[0] && kept[1] ? 0 : -1;
    b->body = body;
    b->outlines = outlines;
    for (int k = 0; k < 1 + moves && status == 0; k++) {
        b->shift = shift[k];
        find_kept(b, outlines, kept[k]);
    }
    b->shift = shift[0];
    b->kept = kept[0];
    for (size_t k = 0; k < outlines->count && status == 0; k++)
        if (moves)
            status = add_both(b, k, body, (const bool *[2]){kept[0], kept[1]}, shift);
        else if (kept[0][k])
            status = add(b, k, body, SB_FACET_ALWAYS);
    b->shift = (sb_vec3){0};
    sb_free(kept[0]);
    sb_free(kept[1]);
    return status;
}

/* Finds the largest displacement of a wave maker's law, m. */
static sb_status find_farthest(const sb_scene *scene, const sb_wavemaker_use *use, double *farthest, sb_error *error)
{
    sb_paddle paddle;
    const sb_status status = sb_paddle_create(&use->law, &paddle, error);
    if (status != SB_OK) return status;
    const sb_paddle_way way = sb_paddle_way_of(&paddle, scene->duration);
    sb_paddle_destroy(&paddle);
    *farthest = way.most > -way.least ? way.most : way.least;
    return SB_OK;
}

static int add_sides(sb_facet_builder *b, size_t body)
{
    for (int side = 0; side < SB_SIDES; side++) {
        if (!sb_facets_is_wall(b, side)) continue;
        if (sb_facets_is_cut(b, side)) {
            if (add_outlines(b, &b->of_side[side], body, (sb_vec3){0}) != 0) return -1;
            continue;
        }
        if (sb_grow((void **)&b->out->facets, &b->capacity, b->out->count + 1, sizeof *b->out->facets) != 0) return -1;
        const sb_vec3 n = sb_facets_side_normal(side);
        b->out->facets[b->out->count++] = (sb_facet){
            .normal = n, .distance = sb_dot(n, side % 2 ? b->model->max : b->model->min), .body = (uint32_t)body};
    }
    return 0;
}

/* Adds the facets of all bodies and sides. The bodies of one wave maker follow each other. */
static sb_status add_all(sb_facet_builder *b, sb_error *error)
{
    const sb_model *model = b->model;
    int maker = -1;
    double farthest = 0;
    for (size_t k = 0; k < model->body_count; k++) {
        const sb_model_body *body = &model->bodies[k];
        const sb_wavemaker_use *use = body->wavemaker < 0 ? NULL : &b->scene->wavemakers[body->wavemaker];
        if (use && body->wavemaker != maker) {
            const sb_status status = find_farthest(b->scene, use, &farthest, error);
            if (status != SB_OK) return status;
            maker = body->wavemaker;
        }
        const sb_vec3 away = use ? sb_scale(use->direction, (1 - body->held) * farthest) : (sb_vec3){0};
        if ((sb_facets_has_mesh(b, k) ? add_outlines(b, &b->of_body[k], k, away) : add_sides(b, k)) != 0)
            return sb_fail_memory(error, "facets of walls");
    }
    return SB_OK;
}

sb_status sb_model_facets(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_facet_builder b = {
        .scene = scene, .model = model, .space = space, .spacing = model->spacing, .out = &model->facets};
    int status = sb_facets_find_plates(&b);
    if (status == 0) status = sb_facets_find_outlines(&b);
    if (status == 0) status = sb_facets_cut_sides(&b);
    const sb_status added = status == 0 ? add_all(&b, error) : sb_fail_memory(error, "facets of walls");
    for (size_t k = 0; k < model->body_count && b.of_body; k++) sb_outlines_free(&b.of_body[k]);
    for (int side = 0; side < SB_SIDES; side++) sb_outlines_free(&b.of_side[side]);
    sb_free(b.of_body);
    sb_free(b.plate);
    return added;
}

/* Edges of facets: what stands behind them, and how the surface bends there. */
#include "geometry/model/facet_parts.h"
#include "geometry/solid/solid.h"

#include <math.h>

/* In spacings: surfaces as near as this touch. */
static const double TOUCHES = 1e-3;

/* Sine of the bend up to which a surface is flat. */
static const double FLAT = 1e-4;

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
    return of->which == LIKE ? like : !like && (of->which == OTHER || along >= SB_FACETS_BENT);
}

static sb_bend bend_of(sb_vec3 normal, sb_vec3 inward, sb_vec3 other)
{
    const double towards = sb_dot(other, inward);
    if (sb_dot(normal, other) >= SB_FACETS_BENT) return towards > FLAT ? SB_BEND_HOLLOW : SB_BEND_SOFT;
    return towards > 0 ? SB_BEND_CONCAVE : SB_BEND_CONVEX;
}

/* Whether a body fills the corner between a facet and what stands at its edge. A plate fills nothing. */
static bool fills_corner(const sb_facet_builder *b, size_t body, const sb_facet *facet, const sb_facet_edge *edge,
                         sb_vec3 at)
{
    const double away = 2 * TOUCHES * b->spacing;
    return b->plate[body] ||
           sb_solid_contains(b->space->solid[body], sb_madd(at, away, sb_sub(facet->normal, edge->inward)));
}

/* The bend towards one body's surface that touches the edge's middle. Returns false if none does. A side of another
   body that is hidden, because its top continues the facet, does not count. */
static bool bend_towards(const sb_facet_builder *b, size_t body, const sb_facet *facet, sb_facet_edge *edge, sb_vec3 at,
                         sb_bend *bend)
{
    const double near = TOUCHES * b->spacing;
    sb_vec3 normal, nearest;
    normals which = {facet->normal, GENTLE};
    /* A side of the domain ends where a surface cuts it, whatever else of the body touches it there. */
    if (!sb_facets_has_mesh(b, facet->body) &&
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

/* Whether another facet of the same body goes on at the edge of outline `self`, bent by less than 45 degrees. What
   stands on both covers a part of them, but they remain one surface. */
static bool goes_on(const sb_facet_builder *b, size_t self, sb_vec3 at)
{
    const double near = TOUCHES * b->spacing;
    const sb_vec3 normal = b->outlines->outline[self].normal;
    for (size_t k = 0; k < b->outlines->count; k++) {
        const sb_outline *o = &b->outlines->outline[k];
        if (k != self && b->kept[k] && sb_dot(o->normal, normal) >= SB_FACETS_BENT &&
            fabs(sb_dot(o->normal, sb_sub(at, o->corner[0]))) < near && sb_facets_near_outline(o, at, near))
            return true;
    }
    return false;
}

/* Whether an edge lies in a side, or beyond it, from end to end. */
static bool along_side(const sb_facet_builder *b, int side, const sb_facet_edge *edge)
{
    const sb_vec3 from = sb_facets_place(b, SIZE_MAX, edge->from), to = sb_facets_place(b, SIZE_MAX, edge->to);
    return sb_facets_is_wall(b, side) &&
           fmax(sb_facets_from_side(b, side, from), sb_facets_from_side(b, side, to)) < TOUCHES * b->spacing;
}

/* Whether another body than the facet's own contains a point. */
static bool buried(const sb_facet_builder *b, size_t own, sb_vec3 at)
{
    for (size_t body = 0; body < b->model->body_count; body++)
        if (body != own && sb_facets_has_mesh(b, body) && b->space->solid[body] &&
            sb_solid_contains(b->space->solid[body], sb_facets_place(b, body, at)))
            return true;
    return false;
}

/* The middle of the part of an edge that is within the walls; of the whole edge if none is. If another body contains
   it, as the bed contains the foot of a wall, the nearest place on the edge that none contains, of some. */
static sb_vec3 middle_within(const sb_facet_builder *b, size_t own, const sb_facet_edge *edge)
{
    enum { PLACES = 32 };
    double low = 0, high = 1;
    for (int side = 0; side < SB_SIDES; side++) {
        if (!sb_facets_is_wall(b, side)) continue;
        const double from = sb_facets_from_side(b, side, sb_facets_place(b, SIZE_MAX, edge->from)),
                     to = sb_facets_from_side(b, side, sb_facets_place(b, SIZE_MAX, edge->to));
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

sb_bend sb_facets_bend(const sb_facet_builder *b, size_t self, const sb_facet *facet, sb_facet_edge *edge)
{
    const sb_vec3 at = middle_within(b, facet->body, edge);
    sb_bend found = SB_BEND_CONVEX;
    for (int side = 0; side < SB_SIDES; side++)
        if (along_side(b, side, edge) && sb_dot(sb_facets_side_normal(side), edge->inward) > FLAT) {
            edge->wall = sb_facets_side_normal(side);
            return sb_facets_is_cut(b, side) ? bend_of(facet->normal, edge->inward, sb_facets_side_normal(side))
                                             : SB_BEND_CONCAVE;
        }
    for (size_t body = 0; body < b->model->body_count; body++) {
        if (!sb_facets_has_mesh(b, body) || !b->space->solid[body]) continue;
        sb_bend bend;
        const sb_vec3 place = sb_facets_place(b, body, at);
        edge->wall = (sb_vec3){0};
        if (!bend_towards(b, body, facet, edge, place, &bend)) {
            if (body == facet->body || !sb_solid_contains(b->space->solid[body], place)) continue;
            bend = SB_BEND_CONCAVE;
        }
        if (bend == SB_BEND_CONCAVE) return body != facet->body && goes_on(b, self, at) ? SB_BEND_SOFT : bend;
        if (bend == SB_BEND_HOLLOW || (bend == SB_BEND_SOFT && found == SB_BEND_CONVEX)) found = bend;
    }
    return found;
}

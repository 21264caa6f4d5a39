/* Outlines of the facets of bodies and of the domain's sides, cut where surfaces meet at a small angle. */
#include "base/memory.h"
#include "geometry/facets/cuts.h"
#include "geometry/model/facet_parts.h"

#include <math.h>

/* In spacings: shorter lines in which facets of two bodies cross do not count. */
static const double CUT = 0.02;

/* In spacings: how far a side of the domain that bodies cut goes on beyond the domain. It is more than a support
   radius, so that water never meets its end. */
static const double BEYOND = 16;

bool sb_facets_near_outline(const sb_outline *o, sb_vec3 at, double near)
{
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 from = o->corner[k], along = sb_sub(o->corner[(k + 1) % o->count], from);
        const sb_vec3 inward = o->count == 2 ? along : sb_cross(o->normal, along);
        if (sb_dot(inward, sb_sub(at, from)) < -near * sb_norm(inward)) return false;
    }
    return true;
}

/* ---- bodies ---- */

/* Whether a body's surface cuts those of others: closed bodies and terrains that do not move. */
static bool cuts(const sb_facet_builder *b, size_t body)
{
    return sb_facets_has_mesh(b, body) && !b->plate[body] && b->model->bodies[body].wavemaker < 0;
}

int sb_facets_find_outlines(sb_facet_builder *b)
{
    const size_t bodies = b->model->body_count;
    b->of_body = sb_alloc(bodies, sizeof *b->of_body);
    int status = b->of_body ? 0 : -1;
    for (size_t k = 0; k < bodies && status == 0; k++)
        if (sb_facets_has_mesh(b, k))
            status = b->model->dimensions == 2 ? sb_outlines_of_section(b->space->mesh[k], b->spacing, &b->of_body[k])
                                               : sb_outlines_of_mesh(b->space->mesh[k], &b->of_body[k]);
    for (size_t k = 0; k < bodies && status == 0; k++)
        for (size_t by = 0; by < bodies && status == 0; by++)
            if (by != k && cuts(b, k) && cuts(b, by))
                status = sb_outlines_cut(&b->of_body[k], &b->of_body[by], SB_FACETS_BENT, CUT * b->spacing, 0);
    return status;
}

/* ---- sides of the domain ---- */

bool sb_facets_is_wall(const sb_facet_builder *b, int side)
{
    return b->scene->domain.side[side] == SB_SIDE_WALL && !(b->model->dimensions == 2 && side / 2 == 1);
}

sb_vec3 sb_facets_side_normal(int side)
{
    const double n = side % 2 ? -1 : 1;
    return sb_vec(side / 2 == 0 ? n : 0, side / 2 == 1 ? n : 0, side / 2 == 2 ? n : 0);
}

double sb_facets_from_side(const sb_facet_builder *b, int side, sb_vec3 at)
{
    return sb_dot(sb_facets_side_normal(side), sb_sub(at, side % 2 ? b->model->max : b->model->min));
}

bool sb_facets_is_cut(const sb_facet_builder *b, int side)
{
    return b->of_side[side].count > 1;
}

/* The outline of a side, which goes on beyond the domain: in 2D a segment. Returns 0, or -1 without memory. */
static int outline_side(const sb_facet_builder *b, int side, sb_outlines *out)
{
    const bool flat = b->model->dimensions == 2;
    const double beyond = BEYOND * b->spacing;
    const sb_vec3 n = sb_facets_side_normal(side), reach = sb_vec(beyond, beyond, beyond);
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
        at[axis] = sb_component(on, axis);
        at[u] = sb_component(k == 0 || k == 3 ? low : high, u);
        if (!flat) at[v] = sb_component(k < 2 ? low : high, v);
        /* counter-clockwise seen along -n: the order turns with the side */
        out->outline[0].corner[side % 2 && !flat ? 3 - k : k] = sb_vec(at[0], at[1], at[2]);
    }
    return 0;
}

/* Whether the domain repeats along a side, whose outline would then meet its own images. */
static bool repeats_along(const sb_facet_builder *b, int side)
{
    for (int other = 0; other < SB_SIDES; other++)
        if (other / 2 != side / 2 && b->scene->domain.side[other] == SB_SIDE_PERIODIC &&
            !(b->model->dimensions == 2 && other / 2 == 1))
            return true;
    return false;
}

int sb_facets_cut_sides(sb_facet_builder *b)
{
    const double near = CUT * b->spacing;
    int status = 0;
    for (int side = 0; side < SB_SIDES && status == 0; side++) {
        if (!sb_facets_is_wall(b, side) || repeats_along(b, side)) continue;
        sb_outlines *outlines = &b->of_side[side], whole = {0};
        status = outline_side(b, side, outlines);
        if (status == 0) status = outline_side(b, side, &whole);
        for (size_t k = 0; k < b->model->body_count && status == 0; k++)
            if (cuts(b, k)) status = sb_outlines_cut(outlines, &b->of_body[k], SB_FACETS_BENT, near, near);
        for (size_t k = 0; k < b->model->body_count && status == 0 && sb_facets_is_cut(b, side); k++)
            if (cuts(b, k)) status = sb_outlines_cut(&b->of_body[k], &whole, SB_FACETS_BENT, near, near);
        sb_outlines_free(&whole);
    }
    return status;
}

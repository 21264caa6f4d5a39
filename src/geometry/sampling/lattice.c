/* Places regular points first: lattices on planes, and rows along concave edges. Candidates are placed in parallel
   and accepted in their order. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

#include <string.h>

/* Cosine between two normals: below it the mitre point is too far away and is not used. */
static const double mitre_cosine = -0.7;

int sb_candidate_flush(sb_sampler *sampler, sb_candidate_batch *batch)
{
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t i = 0; i < batch->count; ++i) {
        sb_candidate *c = batch->candidate + i;
        double margin;
        sb_vec3 placed;
        batch->good[i] = false;
        if (sb_stop_signal()) continue;
        if (c->placed) {
            batch->good[i] = sb_sample_fits(sampler, c->surface, c->at, c->inward, c->offset);
            continue;
        }
        /* Points that another solid covers are left to the filling of voids. Otherwise a slope that continues just
           below a deck would take the deck's places. */
        batch->good[i] = sb_sample_exposed(sampler, c->surface, c->at, sb_scale(c->inward, -1)) &&
                         sb_sample_place(sampler, c->surface, c->at, c->inward, &placed, &margin) == SB_PLACED;
        if (batch->good[i]) c->at = placed;
    }
    double least = SB_SAMPLE_LATTICE * sampler->settings.spacing;
    int failed = sb_stop_signal();
    for (size_t i = 0; i < batch->count && !failed; ++i) {
        const sb_candidate *c = batch->candidate + i;
        if (batch->good[i] && !sb_sample_set_any(&sampler->set, c->at, least))
            failed = sb_sample_set_add(&sampler->set,
                                       &(sb_sample){c->at, sb_scale(c->inward, -1), c->surface, sampler->slab});
    }
    batch->count = 0;
    return failed;
}

int sb_candidate_push(sb_sampler *sampler, sb_candidate_batch *batch, sb_candidate candidate)
{
    if (!sb_slab_owns(sampler, candidate.at)) return 0;
    batch->candidate[batch->count++] = candidate;
    return batch->count == SB_SAMPLE_BATCH ? sb_candidate_flush(sampler, batch) : 0;
}

/* Converts the triangle's corners to lattice steps. */
static void to_lattice(const sb_lattice *l, const sb_vec3 corner[3], double u[3], double v[3])
{
    for (int i = 0; i < 3; ++i) {
        sb_vec3 arm = sb_sub(corner[i], l->origin);
        u[i] = sb_dot(arm, l->u) / l->step_u;
        v[i] = sb_dot(arm, l->v) / l->step_v;
    }
}

/* In lattice steps: tolerance that keeps points on an edge despite rounding. */
static const double slack = 1e-9;

/* Computes the middle and half the extent of the current slab's sampled region along a direction. Particles farther
   outside of the domain than a support radius are dropped, so they need not be generated. */
static void region_along(const sb_sampler *sampler, sb_vec3 along, double *middle, double *half)
{
    const sb_sample_settings *settings = &sampler->settings;
    const double margin = settings->support + settings->offset + 4 * settings->spacing;
    double low[3] = {settings->min.x, settings->min.y, settings->min.z};
    double high[3] = {settings->max.x, settings->max.y, settings->max.z};
    low[sampler->slabs.axis] = fmax(low[sampler->slabs.axis], sampler->low);
    high[sampler->slabs.axis] = fmin(high[sampler->slabs.axis], sampler->high);
    const sb_vec3 min = sb_vec(low[0], low[1], low[2]), max = sb_vec(high[0], high[1], high[2]);
    sb_vec3 size = sb_scale(sb_sub(max, min), 0.5);
    if (settings->dimensions == 2) size.y = 1e3 * settings->spacing;
    *middle = sb_dot(sb_scale(sb_add(max, min), 0.5), along);
    *half = fabs(along.x) * (size.x + margin) + fabs(along.y) * (size.y + margin) + fabs(along.z) * (size.z + margin);
}

/* Reduces [low, high], in steps along a direction from a point, to the slab's sampled region. */
static void cut_to_region(const sb_sampler *sampler, sb_vec3 from, sb_vec3 along, double step, double *low,
                          double *high)
{
    double middle, half;
    region_along(sampler, along, &middle, &half);
    middle -= sb_dot(from, along);
    *low = fmax(*low, (middle - half) / step);
    *high = fmin(*high, (middle + half) / step);
}

/* Computes the range of u that a row shares with the triangle. The row meets at least one edge. */
static void span_row(const double u[3], const double v[3], double row, double *first, double *last)
{
    *first = HUGE_VAL;
    *last = -HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3;
        if (fmin(v[i], v[j]) > row + slack || fmax(v[i], v[j]) < row - slack) continue;
        double t = v[i] != v[j] ? (row - v[i]) / (v[j] - v[i]) : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        double at = u[i] + t * (u[j] - u[i]);
        *first = fmin(*first, v[i] != v[j] ? at : fmin(u[i], u[j]));
        *last = fmax(*last, v[i] != v[j] ? at : fmax(u[i], u[j]));
    }
}

/* Adds the lattice points within one triangle, row by row. */
static int scan_triangle(sb_sampler *sampler, sb_candidate_batch *batch, const sb_lattice *l, const sb_vec3 corner[3],
                         sb_candidate candidate)
{
    double u[3], v[3];
    to_lattice(l, corner, u, v);
    double low = fmin(v[0], fmin(v[1], v[2])), high = fmax(v[0], fmax(v[1], v[2]));
    double area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
    if (!(fabs(area) > 1e-12)) return 0;
    double region_first = -HUGE_VAL, region_last = HUGE_VAL;
    cut_to_region(sampler, l->origin, l->v, l->step_v, &low, &high);
    cut_to_region(sampler, l->origin, l->u, l->step_u, &region_first, &region_last);
    if (!(low <= high)) return 0;
    int64_t end = (int64_t)floor(high - 0.5 + slack);
    for (int64_t n = (int64_t)ceil(low - 0.5 - slack); n <= end; ++n) {
        double row = (double)n + 0.5;
        double first, last;
        if (sb_stop_signal()) return -1;
        span_row(u, v, row, &first, &last);
        first = fmax(first, region_first);
        last = fmin(last, region_last);
        if (!(first <= last)) continue;
        int64_t stop = (int64_t)floor(last - 0.5 + slack);
        for (int64_t m = (int64_t)ceil(first - 0.5 - slack); m <= stop; ++m) {
            double at = (double)m + 0.5;
            double b = ((at - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (row - v[0])) / area;
            double c = ((u[1] - u[0]) * (row - v[0]) - (at - u[0]) * (v[1] - v[0])) / area;
            candidate.at =
                sb_madd(sb_madd(corner[0], b, sb_sub(corner[1], corner[0])), c, sb_sub(corner[2], corner[0]));
            if (sb_candidate_push(sampler, batch, candidate)) return -1;
        }
    }
    return 0;
}

static void corners_of(const sb_mesh *mesh, size_t t, sb_vec3 corner[3])
{
    for (int i = 0; i < 3; ++i) corner[i] = mesh->vertices[mesh->triangles[t][i]];
}

/* Whether a part of a triangle lies in the current slab. */
static bool meets(const sb_sampler *sampler, const sb_vec3 corner[3])
{
    const int axis = sampler->slabs.axis;
    const double a = sb_sample_along(corner[0], axis), b = sb_sample_along(corner[1], axis);
    const double c = sb_sample_along(corner[2], axis);
    return sb_slab_meets(sampler, fmin(a, fmin(b, c)), fmax(a, fmax(b, c)), slack * sampler->settings.spacing);
}

/* Chooses the lattices of a surface's planes, once for all slabs. */
static int choose_lattices(const sb_sampler *sampler, uint32_t index, sb_surface *surface)
{
    if (surface->lattices) return 0;
    surface->lattices = sb_alloc_untouched(sb_surface_mesh(surface)->triangle_count, sizeof *surface->lattices);
    return surface->lattices ? sb_sample_planes(sampler, index, surface->lattices) : -1;
}

static int scan_faces(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index)
{
    sb_surface *surface = sampler->surfaces + index;
    const sb_mesh *mesh = sb_surface_mesh(surface);
    int failed = choose_lattices(sampler, index, surface);
    for (size_t t = 0; t < mesh->triangle_count && !failed; ++t) {
        const sb_lattice *l = surface->lattices + surface->region[t];
        if (!l->suits) continue;
        sb_vec3 corner[3];
        corners_of(mesh, t, corner);
        if (!meets(sampler, corner)) continue;
        failed = scan_triangle(sampler, batch, l, corner,
                               (sb_candidate){.inward = sb_scale(surface->normal[t], -1), .surface = index});
    }
    return failed;
}

/* Adds points evenly along a straight edge, on the global lattice if the edge is parallel to an axis. */
static int scan_line(sb_sampler *sampler, sb_candidate_batch *batch, sb_vec3 a, sb_vec3 b, sb_candidate candidate)
{
    double spacing = sampler->settings.spacing, length = sb_norm(sb_sub(b, a));
    sb_vec3 along = sb_normalize(sb_sub(b, a));
    double step = sb_sample_fitted_step(length, spacing), begin = 0.5 * step;
    if (sb_sample_is_axis(along)) {
        double from = sb_dot(sb_sub(a, sampler->settings.min), along);
        step = sb_sample_axis_step(&sampler->settings, sb_sample_dominant(along));
        begin = step * (ceil(from / step - 0.5 - slack) + 0.5) - from;
    }
    double low = 0, high = floor((length - begin) / step + 1e-9);
    cut_to_region(sampler, sb_madd(a, begin, along), along, step, &low, &high);
    if (!(low <= high)) return 0;
    const int64_t end = (int64_t)floor(high);
    for (int64_t n = (int64_t)ceil(low); n <= end; ++n) {
        sb_candidate next = candidate;
        next.at = sb_add(sb_madd(a, begin + (double)n * step, along), candidate.at);
        if (sb_candidate_push(sampler, batch, next)) return -1;
    }
    return 0;
}

/* Adds a row of points where the boundary surfaces of the two faces at a concave edge meet (at the mitre). */
static int scan_crease(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index, const sb_crease *crease)
{
    double cosine = sb_dot(crease->normal[0], crease->normal[1]);
    if (cosine < mitre_cosine || cosine > 0.9) return 0;
    double offset = sampler->settings.offset;
    sb_vec3 sum = sb_add(crease->normal[0], crease->normal[1]);
    sb_candidate candidate = {.at = sb_scale(sum, -offset / (1 + cosine)),
                              .inward = sb_scale(sb_normalize(sum), -1),
                              .surface = index,
                              .placed = true,
                              .offset = offset};
    if (sampler->settings.dimensions == 2) {
        sb_vec3 at = sb_scale(sb_add(crease->a, crease->b), 0.5);
        candidate.at = sb_add(candidate.at, sb_vec(at.x, 0, at.z));
        return sb_candidate_push(sampler, batch, candidate);
    }
    return scan_line(sampler, batch, crease->a, crease->b, candidate);
}

/* Adds the point where the boundary surfaces of three faces meet: at the offset behind all three planes. */
static int scan_cap(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index, const sb_cap *cap)
{
    const sb_vec3 *n = cap->normal;
    double volume = sb_dot(n[0], sb_cross(n[1], n[2])), offset = sampler->settings.offset;
    if (sampler->settings.dimensions == 2 || fabs(volume) < 0.3) return 0;
    sb_vec3 sum = sb_add(sb_cross(n[0], n[1]), sb_add(sb_cross(n[1], n[2]), sb_cross(n[2], n[0])));
    return sb_candidate_push(sampler, batch,
                             (sb_candidate){.at = sb_madd(cap->at, -offset / volume, sum),
                                            .inward = sb_scale(sb_normalize(sum), volume > 0 ? -1 : 1),
                                            .surface = index,
                                            .placed = true,
                                            .offset = offset});
}

/* Samples the curve in y = 0. Each strip of a section is two triangles, and its piece of the curve lies at half the
   strip's width. */
static int scan_strips(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index)
{
    const sb_surface *surface = sampler->surfaces + index;
    const sb_mesh *mesh = sb_surface_mesh(surface);
    for (size_t t = 0; t + 1 < mesh->triangle_count; t += 2) {
        sb_vec3 a = mesh->vertices[mesh->triangles[t][0]], b = mesh->vertices[mesh->triangles[t][1]];
        a.y = b.y = 0;
        sb_vec3 n = surface->normal[t];
        if (sb_dot(n, n) == 0 || (sb_norm(sb_sub(b, a)) < sampler->settings.spacing && !sb_sample_is_axis(n))) continue;
        sb_candidate candidate = {.inward = sb_scale(n, -1), .surface = index};
        if (scan_line(sampler, batch, a, b, candidate)) return -1;
    }
    return 0;
}

static int scan_surface(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index)
{
    return sampler->settings.dimensions == 2 ? scan_strips(sampler, batch, index) : scan_faces(sampler, batch, index);
}

static int scan_corners(sb_sampler *sampler, sb_candidate_batch *batch, uint32_t index)
{
    const sb_surface *surface = sampler->surfaces + index;
    int failed = 0;
    for (size_t i = 0; i < surface->crease_count && !failed; ++i)
        failed = scan_crease(sampler, batch, index, surface->creases + i);
    for (size_t i = 0; i < surface->cap_count && !failed; ++i)
        failed = scan_cap(sampler, batch, index, surface->caps + i);
    return failed;
}

int sb_sample_lattices(sb_sampler *sampler)
{
    sb_candidate_batch batch = {.candidate = sb_alloc_untouched(SB_SAMPLE_BATCH, sizeof *batch.candidate),
                                .good = sb_alloc_untouched(SB_SAMPLE_BATCH, sizeof *batch.good)};
    int failed = !batch.candidate || !batch.good;
    for (int stage = 0; stage < 2 && !failed; ++stage) {
        for (uint32_t i = sampler->first; i < sampler->last && !failed; ++i)
            if (sb_sampler_takes(sampler, i))
                failed = stage == 0 ? scan_surface(sampler, &batch, i) : scan_corners(sampler, &batch, i);
        failed = failed || sb_candidate_flush(sampler, &batch);
    }
    sb_free(batch.candidate);
    sb_free(batch.good);
    return failed;
}

#include "sim/passes/cpu/searcher.h"
#include "sim/walls/walls.h"

#include "base/memory.h"
#include "sim/passes/cpu/body_forces.h"
#include "sim/passes/cpu/images.h"
#include "sim/passes/cpu/kernel_batch.h"
#include "sim/passes/cpu/vicinity.h"
#include "sim/walls/entry.h"

#include <math.h>

_Static_assert((int)SB_WALLS_AROUND_MAX <= (int)SB_CANDIDATES_MAX, "capacity of the search for hits");

/* Boundary particles around one cell as offsets from the cell's corner, in quanta. */
typedef struct surroundings {
    size_t count;
    float x[SB_WALLS_AROUND_MAX + SB_HIT_SPARE], y[SB_WALLS_AROUND_MAX + SB_HIT_SPARE],
        z[SB_WALLS_AROUND_MAX + SB_HIT_SPARE];
    sb_f4 place[SB_WALLS_AROUND_MAX];
    float weight[SB_WALLS_AROUND_MAX];
    uint32_t index[SB_WALLS_AROUND_MAX];
} surroundings;

typedef struct searcher {
    sb_vicinity vicinity;
    surroundings wall;
    sb_hits hits, reflected;
    sb_images_around images;
    float force_x[SB_HITS_MAX + SB_HIT_SPARE], force_y[SB_HITS_MAX + SB_HIT_SPARE], force_z[SB_HITS_MAX + SB_HIT_SPARE];
    size_t edges, edge_own, edge_of[SB_HITS_MAX + SB_HIT_SPARE]; /* pairs at edges of the present particle: the first,
                                                                    and those with itself and with each hit */
    uint32_t hit_of[SB_AROUND_MAX]; /* candidate -> its hit; valid where that hit is this candidate */
    const sb_kernel *kernel;
    sb_kernel_batch *batch;
    sb_find_hits *find_hits;
    float q_scale;     /* (quantum / h)^2 */
    float value_scale; /* alpha / h^d */
    float slope_scale; /* alpha quantum / h^(d+2): W'/r per quantum */
    float to_units;    /* a slope of the kernel in stored units */
    unsigned full;     /* limits that this group exceeded */
} searcher;

/* ---- walls around a cell ---- */

SB_INLINE void gather_cell(surroundings *s, const sb_record *record, uint32_t begin, uint32_t end, sb_record corner,
                           uint32_t base)
{
    if (s->count + (end - begin) > SB_WALLS_AROUND_MAX) {
        s->count = SB_WALLS_AROUND_MAX + 1;
        return;
    }
    for (uint32_t k = begin; k < end; k++) {
        sb_f4 d = sb_offset(record[k], corner);
        s->x[s->count] = d[0];
        s->y[s->count] = d[1];
        s->z[s->count] = d[2];
        s->place[s->count] = d;
        s->weight[s->count] = sb_carried_value(record[k]);
        s->index[s->count++] = base + k;
    }
}

/* Gathers the boundary particles in the 27 (2D: 9) cells around that of particle i, in a fixed order. */
static void gather_walls(const sb_sim *sim, searcher *w, size_t i, sb_record corner)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const uint64_t code = sb_cell_code(sim->state.position[i], sim->space.shift);
    w->wall.count = 0;
    for (uint32_t s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls.set[s];
        if (!sb_walls_near(set, &sim->space, sim->state.position[i])) continue;
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -layers; dy <= layers; dy++)
                for (int dx = -1; dx <= 1; dx++) {
                    int64_t cell = sb_cells_find(&set->cells, code + sb_cell_step(dx, dy, dz));
                    if (cell >= 0 && w->wall.count <= SB_WALLS_AROUND_MAX)
                        gather_cell(&w->wall, set->record, set->cells.begin[cell], set->cells.begin[cell + 1], corner,
                                    sb_wall_entry(s, 0));
                }
    }
    if (w->wall.count > SB_WALLS_AROUND_MAX) {
        w->full |= SB_FULL_WALLS;
        w->wall.count = 0;
    }
}

/* ---- one particle ---- */

/* pad: the candidate that fills the last places. */
SB_INLINE void find_hits(searcher *w, sb_hits *h, const sb_candidates *of, const sb_candidate_range *range,
                         size_t ranges, sb_f4 self, uint32_t skip, uint32_t pad)
{
    size_t n = w->find_hits(of, range, ranges, h, self, w->q_scale, skip);
    if (n >= SB_HITS_MAX) w->full |= SB_FULL_LIST;
    h->count = n < SB_HITS_MAX ? n : SB_HITS_MAX;
    h->padded = (h->count + SB_HIT_LANES - 1) / SB_HIT_LANES * SB_HIT_LANES;
    for (size_t k = h->count; k < h->padded; k++) {
        h->x[k] = h->y[k] = h->z[k] = 0;
        h->q2[k] = 1;
        h->candidate[k] = pad;
    }
}

/* Rounds slopes of the kernel to storable roots, and replaces them by the squares of these roots, so that all uses of a
   pair have the same number. */
SB_MULTIVERSION
static void round_slopes(float *restrict slope, float *restrict root, size_t count, float to_units)
{
    const float most = (float)SB_ROOT_MAX;
#pragma omp simd
    for (size_t k = 0; k < count; k++) {
        const float rounded = (float)(int)(sqrtf(slope[k] * to_units) + 0.5f);
        root[k] = rounded < most ? rounded : most;
        slope[k] = root[k] * root[k];
    }
}

/* Sums over the fluid neighbours of one particle: part of the density, S_i, and sum |m grad W|^2. */
SB_INLINE void fluid_sums(searcher *w, float mass, float unit, float *density, sb_f4 *sum, float *squares)
{
    sb_hits *h = &w->hits;
    sb_f8 value = {0}, x = {0}, y = {0}, z = {0}, square = {0};
    for (size_t k = 0; k < h->padded; k += SB_HIT_LANES) value += *(const sb_f8 *)(h->value + k);
    round_slopes(h->slope, h->root, h->padded, w->to_units);
    for (size_t k = 0; k < h->padded; k += SB_HIT_LANES) {
        const sb_f8 slope = *(const sb_f8 *)(h->slope + k) * unit;
        x += slope * *(const sb_f8 *)(h->x + k);
        y += slope * *(const sb_f8 *)(h->y + k);
        z += slope * *(const sb_f8 *)(h->z + k);
        square += slope * slope * *(const sb_f8 *)(h->q2 + k);
    }
    *density += mass * w->value_scale * sb_sum8(&value);
    *sum += (sb_f4){sb_sum8(&x), sb_sum8(&y), sb_sum8(&z), 0};
    *squares = sb_sum8(&square) / w->q_scale;
}

/* ---- images ---- */

/* A particle's own image at less than one spacing repels it by REPULSION/2 W(0) (1 - r/spacing)^2 besides the kernel,
   whose slope vanishes at r = 0. Else a particle may pair with its own image (docs/method.md). */
static const float REPULSION = 2;

/* Pairs at edges below this part of m W(0)/spacing are left out. */
static const float NEGLIGIBLE = 1e-3f;

/* What images add to the sums of particle i. */
typedef struct reflections {
    float density;           /* kg/m^3 */
    sb_f4 gradient, doubled; /* sum m grad W, and its part that has q_i twice */
    sb_f4 repulsion;         /* the part of the gradient by which own images repel */
    float flux;              /* by moving walls */
    sb_f4 push;              /* m/s^2, by the hydrostatic part of the pressure of images */
    float squares;           /* sum of |force on a neighbour by the pressure of i|^2 */
} reflections;

/* The entry of a candidate in the arrays that neighbours are read from. */
static uint32_t entry_of(const sb_vicinity *v, uint32_t candidate)
{
    uint32_t before = 0, run = 0;
    while (candidate >= before + v->run[run].count) before += v->run[run++].count;
    return v->run[run].begin + candidate - before;
}

/* Whether a candidate is a hit of the present particle. */
static bool is_hit(const searcher *w, uint32_t candidate)
{
    const uint32_t hit = w->hit_of[candidate];
    return hit < w->hits.count && w->hits.candidate[hit] == candidate;
}

/* Removes the weight of images whose originals are not within the support radius: paths round an edge, with one end
   behind the facet, can be shorter than the straight line. */
static void require_originals(searcher *w, uint32_t self)
{
    sb_hits *h = &w->reflected;
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t source = w->images.source[h->candidate[k] - w->vicinity.count];
        if (source != self && !is_hit(w, source)) h->root[k] = 0;
    }
}

/* Adds a pair at an edge: vectors in kg/m^4. Pairs with the same particle by facets of the same body are one: where
   facets bend little they nearly cancel. */
static void add_edge(const sb_sim *sim, searcher *w, sb_list_builder *lists, uint32_t self, uint32_t source,
                     uint32_t facet, sb_f4 own, sb_f4 other, reflections *r)
{
    const sb_near_facet *f = &w->images.near.facet[facet];
    r->flux += sb_sum3((own + other) * f->velocity);
    size_t *slot = source == self ? &w->edge_own : &w->edge_of[w->hit_of[source]];
    if (*slot >= w->edges && *slot < lists->edges && lists->edge[*slot].entry == source &&
        sb_mirror_body(sim, lists->edge[*slot].mirror) == sb_mirror_body(sim, f->mirror)) {
        lists->edge[*slot].own += own;
        lists->edge[*slot].other += other;
        return;
    }
    if (sb_grow((void **)&lists->edge, &lists->capacity_edge, lists->edges + 1, sizeof *lists->edge) != 0) {
        lists->out_of_memory = true;
        return;
    }
    *slot = lists->edges;
    lists->edge[lists->edges++] = (sb_edge_pair){own, other, source, f->mirror};
}

/* Completes the pairs at edges of a particle, and sums them. */
static void close_edges(const sb_sim *sim, searcher *w, sb_list_builder *lists, uint32_t self, reflections *r)
{
    const float least = NEGLIGIBLE * sim->constant.mass * w->value_scale / sim->constant.spacing;
    size_t kept = w->edges;
    for (size_t k = w->edges; k < lists->edges; k++) {
        sb_edge_pair e = lists->edge[k];
        if (sb_sum3(e.own * e.own) + sb_sum3(e.other * e.other) < least * least) continue;
        r->gradient += e.own;
        const uint32_t hit = w->hit_of[e.entry];
        if (e.entry == self)
            r->doubled += e.other;
        else {
            w->force_x[hit] += e.other[0];
            w->force_y[hit] += e.other[1];
            w->force_z[hit] += e.other[2];
        }
        e.entry = entry_of(&w->vicinity, e.entry);
        lists->edge[kept++] = e;
    }
    lists->edges = kept;
}

/* Adds the pairs at edges of those weights [from, to) that belong to these hits. */
static void add_edges(const sb_sim *sim, searcher *w, sb_list_builder *lists, uint32_t self, size_t from,
                      const sb_hits *h, reflections *r)
{
    const float scale = sim->constant.mass * w->value_scale / (float)sim->space.quantum;
    if (w->images.slopes > SB_WEIGHT_SLOPES_MAX) {
        w->full |= SB_FULL_LIST;
        return;
    }
    for (size_t k = from; k < w->images.slopes; k++) {
        const sb_weight_slope *s = &w->images.slope[k];
        if (h->root[s->hit] == 0) continue;
        const uint32_t candidate = h->candidate[s->hit];
        const uint32_t source = s->direct ? candidate : w->images.source[candidate - w->vicinity.count];
        const sb_f4 whole = sb_splat(scale * h->value[s->hit]);
        add_edge(sim, w, lists, self, source, s->facet, s->own * whole, s->other * whole, r);
    }
}

/* Adds what repels particle i from its own images, to the values of their hits and as pairs at edges. */
static void repel(const sb_sim *sim, searcher *w, sb_list_builder *lists, uint32_t self, reflections *r)
{
    sb_hits *h = &w->reflected;
    const float end = sim->constant.spacing / sim->constant.support;
    const float top = REPULSION * (float)w->kernel->shape(0);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t image = h->candidate[k] - (uint32_t)w->vicinity.count, path = w->images.path[image];
        if (w->images.source[image] != self || h->q2[k] >= end * end || path > SB_REFLECTION_MASK || h->root[k] == 0)
            continue;
        const float q = sqrtf(h->q2[k]) + 1e-6f, left = 1 - q / end;
        const float slope = -top * left / (end * q) * sim->constant.mass * w->slope_scale * h->root[k];
        const sb_f4 push = (sb_f4){h->x[k], h->y[k], h->z[k], 0} * sb_splat(slope);
        h->value[k] += 0.5f * top * left * left;
        r->repulsion += push;
        add_edge(sim, w, lists, self, self, path - 1, push, push, r);
    }
}

/* Velocity of an image by the motion of walls, m/s. */
static sb_f4 image_velocity(const sb_near *near, uint32_t path)
{
    sb_f4 v = {0};
    for (; path; path >>= SB_REFLECTION_BITS) {
        const sb_near_facet *f = &near->facet[(path & SB_REFLECTION_MASK) - 1];
        const float twice = 2 * sb_sum3(f->plane * f->velocity);
        v = sb_reflect_vector(f->plane, v) + f->plane * (sb_f4){twice, twice, twice, 0};
    }
    return v;
}

/* The parts of a vector along the normals of a path's planes; see sb_reactions_normal. */
static sb_f4 normal_part(const sb_near *near, uint32_t path, sb_f4 a)
{
    sb_f4 all = {0};
    for (; path; path >>= SB_REFLECTION_BITS) {
        const sb_f4 plane = near->facet[(path & SB_REFLECTION_MASK) - 1].plane;
        const float along = sb_sum3(plane * a);
        const sb_f4 part = plane * (sb_f4){along, along, along, 0};
        a -= part;
        all += part;
    }
    return all;
}

/* Removes the hits whose paths have no weight. */
static void drop_weightless(sb_hits *h, uint32_t pad)
{
    size_t kept = 0;
    for (size_t k = 0; k < h->count; k++) {
        h->x[kept] = h->x[k], h->y[kept] = h->y[k], h->z[kept] = h->z[k];
        h->value[kept] = h->value[k], h->slope[kept] = h->slope[k], h->root[kept] = h->root[k];
        h->candidate[kept] = h->candidate[k];
        kept += h->root[k] != 0;
    }
    h->count = kept;
    h->padded = (kept + SB_HIT_LANES - 1) / SB_HIT_LANES * SB_HIT_LANES;
    for (size_t k = kept; k < h->padded; k++) {
        h->candidate[k] = pad;
        h->slope[k] = h->root[k] = 0;
    }
}

/* Adds the hits of images. The forces on neighbours by the pressure of i are summed by neighbour. */
static void reflected_sums(const sb_sim *sim, searcher *w, sb_f4 self_place, uint32_t self, reflections *r)
{
    sb_hits *h = &w->reflected;
    const sb_near *near = &w->images.near;
    float value = 0;
    for (size_t k = 0; k < h->count; k++) {
        value += h->value[k] * h->root[k];
        h->slope[k] *= h->root[k];
    }
    r->density = sim->constant.mass * w->value_scale * value;
    round_slopes(h->slope, h->root, h->padded, w->to_units);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t image = h->candidate[k] - (uint32_t)w->vicinity.count, source = w->images.source[image];
        const sb_f4 gradient = (sb_f4){h->x[k], h->y[k], h->z[k], 0} * sb_splat(h->slope[k] * sim->work.pairs.unit);
        r->gradient += gradient;
        if (source == self) r->doubled += gradient;
        sb_f4 back = -gradient; /* reflected back, from the image to the neighbour */
        for (uint32_t path = w->images.path[image], n = SB_REFLECTIONS_MAX; n-- > 0;) {
            const uint32_t plane = path >> (SB_REFLECTION_BITS * n) & SB_REFLECTION_MASK;
            if (plane) back = sb_reflect_vector(near->facet[plane - 1].plane, back);
        }
        const uint32_t hit = w->hit_of[source];
        if (source != self) {
            w->force_x[hit] += back[0];
            w->force_y[hit] += back[1];
            w->force_z[hit] += back[2];
        }
        const float head = w->vicinity.place[source][2] - (self_place[2] - h->z[k]);
        if (head != 0)
            r->push -= normal_part(near, w->images.path[image], gradient * sb_splat(sb_hydrostatic(sim) * head));
        if (near->moves) r->flux += sb_sum3(gradient * image_velocity(near, w->images.path[image]));
    }
}

/* Finds the images around particle i, completes its lists and returns what images add to its sums. w->hits: its hits of
   particles, with their weights as roots and slopes unrounded. */
static reflections reflect(sb_sim *sim, searcher *w, sb_list_builder *lists, sb_f4 self, uint32_t candidate)
{
    const sb_vicinity *v = &w->vicinity;
    sb_candidate_range range[SB_VICINITY_ROWS];
    const size_t ranges = sb_vicinity_candidates(sim, v, SB_VICINITY_IMAGES, SB_VICINITY_IMAGES + 1, self, range);
    sb_hits *h = &w->hits, *r = &w->reflected;
    reflections sums = {0};
    const float unit = sim->constant.mass * w->slope_scale;
    w->edges = lists->edges;
    w->edge_own = SIZE_MAX;
    for (size_t k = 0; k < h->count; k++) {
        const float slope = -unit * h->slope[k] * h->root[k];
        w->hit_of[h->candidate[k]] = (uint32_t)k;
        w->edge_of[k] = SIZE_MAX;
        w->force_x[k] = slope * h->x[k];
        w->force_y[k] = slope * h->y[k];
        w->force_z[k] = slope * h->z[k];
    }
    add_edges(sim, w, lists, candidate, 0, h, &sums);
    const size_t direct = w->images.slopes;
    find_hits(w, r, &(sb_candidates){v->x, v->y, v->z, v->place}, range, ranges, self, UINT32_MAX, candidate);
    w->batch(w->kernel, r->q2, r->padded, r->value, r->slope);
    sb_images_weigh(sim, v, &w->images, self, r);
    require_originals(w, candidate);
    repel(sim, w, lists, candidate, &sums);
    add_edges(sim, w, lists, candidate, direct, r, &sums);
    close_edges(sim, w, lists, candidate, &sums);
    drop_weightless(r, candidate);
    if (r->count >= SB_LIST_MAX) w->full |= SB_FULL_LIST;
    reflected_sums(sim, w, self, candidate, &sums);
    for (size_t k = 0; k < h->count; k++) {
        sums.squares += w->force_x[k] * w->force_x[k] + w->force_y[k] * w->force_y[k] + w->force_z[k] * w->force_z[k];
        h->value[k] *= h->root[k];
        h->slope[k] *= h->root[k];
    }
    return sums;
}

/* Sums over the boundary particles around one particle: part of the density, and B_i = sum_b psi_b grad W_ib with the
   flux sum_b psi_b v_b . grad W_ib of moving walls in the last lane. */
SB_INLINE void wall_sums(const sb_sim *sim, searcher *w, float *density, sb_f4 *wall)
{
    sb_hits *h = &w->hits;
    float value = 0;
    sb_f4 sum = {0};
    w->batch(w->kernel, h->q2, h->count, h->value, h->slope);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t index = w->wall.index[h->candidate[k]];
        const float weight = w->wall.weight[h->candidate[k]];
        const float slope = h->slope[k] * weight * w->slope_scale;
        sb_f4 gradient = {slope * h->x[k], slope * h->y[k], slope * h->z[k], 0};
        h->slope[k] = slope;
        h->candidate[k] = index;
        value += weight * h->value[k];
        if (sb_wall_moves(index)) gradient[3] = sb_sum3(sb_wall_velocity(sim, index) * gradient);
        sum += gradient;
    }
    *density += w->value_scale * value;
    *wall = sum;
}

/* Boundary particles around particle i: their part of the density, and B_i; with images only their lists. */
SB_INLINE void add_walls(sb_sim *sim, searcher *w, sb_list_builder *lists, size_t i, sb_record cell, float *density,
                         sb_f4 *wall)
{
    sim->work.wall_pairs.count[i] = 0;
    if (w->wall.count == 0) return;
    const sb_candidate_range all = {0, (uint32_t)w->wall.count};
    find_hits(w, &w->hits, &(sb_candidates){w->wall.x, w->wall.y, w->wall.z, w->wall.place}, &all, 1,
              sb_offset(sim->state.position[i], cell), UINT32_MAX, UINT32_MAX);
    if (w->hits.count >= SB_LIST_MAX) w->full |= SB_FULL_LIST;
    if (w->hits.count == 0) return;
    const float without = *density;
    const sb_f4 by_images = *wall;
    wall_sums(sim, w, density, wall);
    sb_list_walls(lists, &w->hits, sim, i);
    if (!sim->needs.images) return;
    *density = without;
    *wall = by_images;
}

/* Searches the neighbours of particle i and fills in its fields. candidate: its index in the vicinity; cell: the corner
   of its cell. */
SB_INLINE void one_particle(sb_sim *sim, searcher *w, sb_list_builder *lists, const sb_group *group, size_t i,
                            uint32_t candidate, sb_record cell)
{
    const sb_constants *c = &sim->constant;
    const sb_vicinity *v = &w->vicinity;
    float density = c->mass * w->value_scale * (float)sim->scene->numerics.kernel->shape(0);
    float squares = 0;
    sb_f4 sum = {0}, doubled = {0}, wall = {0}, self = sb_offset(sim->state.position[i], group->corner);
    sb_candidate_range range[SB_VICINITY_ROWS];
    const size_t ranges = sb_vicinity_candidates(sim, v, 0, v->parts, self, range);
    const size_t edges = lists->edges;
    sb_hits *h = &w->hits;
    reflections by_images = {0};
    find_hits(w, h, &(sb_candidates){v->x, v->y, v->z, v->place}, range, ranges, self, candidate, candidate);
    if (h->count >= SB_LIST_MAX) w->full |= SB_FULL_LIST;
    w->batch(w->kernel, h->q2, h->padded, h->value, h->slope);
    if (v->images > 0) {
        sb_images_weigh_direct(sim, &w->images, self, h);
        by_images = reflect(sim, w, lists, self, candidate);
    }
    fluid_sums(w, c->mass, sim->work.pairs.unit, &density, &sum, &squares);
    sb_list_water(lists, h, sim, i);
    if (sim->needs.images) {
        sim->work.image_push[i] = by_images.push;
        sim->work.edge_pairs.first[i] = (uint32_t)edges;
        sim->work.edge_pairs.count[i] = (uint16_t)(lists->edges - edges);
    }
    if (v->images > 0) {
        if (w->reflected.count > 0) sb_list_reflected(lists, &w->reflected, sim, i);
        density += by_images.density;
        sum += by_images.gradient;
        doubled = by_images.doubled;
        wall[3] = by_images.flux;
        squares = by_images.squares;
    }
    const float fluid_density = density;
    /* It shows the surface. The repulsion from a wall is no surface: a film on a floor would count as full water. */
    const sb_f4 slope = sum - by_images.repulsion;
    if (sim->work.water_squared) sim->work.water_squared[i] = sb_sum3(slope * slope);
    add_walls(sim, w, lists, i, cell, &density, &wall);
    float diagonal = squares;
    const sb_f4 all = sum + doubled + wall;
    for (int axis = 0; axis < 3; axis++) diagonal += all[axis] * all[axis];
    sim->work.density[i] = density;
    if (sim->work.wall_density) sim->work.wall_density[i] = density - fluid_density;
    sim->work.wall[i] = wall;
    sim->work.diagonal[i] = diagonal > 1e-6f * c->full_diagonal ? diagonal : 0;
}

SB_MULTIVERSION
static void search_group(sb_sim *sim, searcher *w, sb_list_builder *lists, sb_group *group)
{
    const int shift = sim->space.shift;
    uint64_t last = UINT64_MAX;
    uint32_t candidate = 0;
    sb_record cell = {0};
    for (size_t i = group->first; i < group->end; i++) {
        const uint64_t code = sb_cell_code(sim->state.position[i], shift);
        if (code != last) {
            const sb_record here = sim->state.position[i];
            cell = (sb_record){here[0] >> shift << shift, here[1] >> shift << shift, here[2] >> shift << shift, 0};
            candidate = sb_vicinity_cell(sim, &w->vicinity, i);
            gather_walls(sim, w, i, cell);
        }
        last = code;
        one_particle(sim, w, lists, group, i, candidate++, cell);
    }
}

unsigned sb_search_group(sb_sim *sim, void *of, sb_list_builder *lists, sb_group *group)
{
    searcher *w = of;
    w->full = 0;
    sb_vicinity_gather(sim, group, &w->vicinity);
    if (w->vicinity.count > SB_AROUND_MAX) return SB_FULL_AROUND;
    if (sim->needs.images && !sb_images_gather(sim, group, &w->vicinity, &w->images)) return SB_FULL_AROUND;
    sb_list_runs(lists, &w->vicinity, group);
    const size_t fours = lists->fours;
    search_group(sim, w, lists, group);
    sb_list_images(lists, &w->vicinity, &w->images, fours, group);
    return w->full;
}

static float slope_scale(const sb_sim *sim)
{
    const int d = sim->constant.dimension;
    return (float)(sim->scene->numerics.kernel->alpha[d] * sim->space.quantum /
                   pow((double)sim->constant.support, d + 2));
}

float sb_lists_unit(const sb_sim *sim)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const float coincident = 0;
    float value, steepest;
    sb_kernel_batch_for(kernel)(kernel, &coincident, 1, &value, &steepest);
    return sim->constant.mass * slope_scale(sim) * steepest / ((float)SB_ROOT_MAX * (float)SB_ROOT_MAX);
}

void *sb_searcher_create(const sb_sim *sim)
{
    searcher *w = sb_alloc_untouched(1, sizeof *w);
    if (!w) return NULL;
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const int d = sim->constant.dimension;
    const double h = (double)sim->constant.support, quantum = sim->space.quantum;
    w->kernel = kernel;
    w->batch = sb_kernel_batch_for(kernel);
    w->find_hits = sb_find_hits_choose();
    w->q_scale = (float)(quantum / h * (quantum / h));
    w->value_scale = (float)(kernel->alpha[d] / pow(h, d));
    w->slope_scale = slope_scale(sim);
    w->to_units = sim->constant.mass * w->slope_scale / sim->work.pairs.unit;
    return w;
}

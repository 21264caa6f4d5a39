#include "sim/passes/cpu/wall_finder.h"

#include "sim/walls/entry.h"
#include "sim/walls/walls.h"

#include <math.h>

SB_INLINE void gather_cell(sb_surroundings *s, const sb_record *record, uint32_t begin, uint32_t end, sb_record corner,
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
static void gather(const sb_sim *sim, sb_wall_finder *f, size_t i)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1, shift = sim->space.shift;
    const sb_record here = sim->state.position[i];
    sb_surroundings *around = &f->around;
    f->corner = (sb_record){here[0] >> shift << shift, here[1] >> shift << shift, here[2] >> shift << shift, 0};
    around->count = 0;
    for (uint32_t s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls.set[s];
        if (!sb_walls_near(set, &sim->space, here)) continue;
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -layers; dy <= layers; dy++)
                for (int dx = -1; dx <= 1; dx++) {
                    int64_t cell = sb_cells_find(&set->cells, f->code + sb_cell_step(dx, dy, dz));
                    if (cell >= 0 && around->count <= SB_WALLS_AROUND_MAX)
                        gather_cell(around, set->record, set->cells.begin[cell], set->cells.begin[cell + 1], f->corner,
                                    sb_wall_entry(s, 0));
                }
    }
    if (around->count > SB_WALLS_AROUND_MAX) {
        f->full |= SB_FULL_WALLS;
        around->count = 0;
    }
}

const sb_hits *sb_wall_finder_find(const sb_sim *sim, sb_wall_finder *f, size_t i)
{
    const sb_wall_search *search = f->search;
    const sb_surroundings *around = &f->around;
    const uint64_t code = sb_cell_code(sim->state.position[i], sim->space.shift);
    sb_hits *h = &f->hits;
    if (code != f->code) {
        f->code = code;
        gather(sim, f, i);
    }
    h->count = h->padded = 0;
    if (around->count == 0) return h;
    const sb_candidate_range all = {0, (uint32_t)around->count};
    h->count = search->find_hits(&(sb_candidates){around->x, around->y, around->z, around->place}, &all, 1, h,
                                 sb_offset(sim->state.position[i], f->corner), search->q_scale, UINT32_MAX);
    if (h->count >= SB_LIST_MAX) f->full |= SB_FULL_LIST;
    search->batch(search->kernel, h->q2, h->count, h->value, h->slope);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t from = h->candidate[k];
        h->root[k] = around->weight[from];
        h->slope[k] = h->slope[k] * around->weight[from] * search->slope_scale;
        h->candidate[k] = around->index[from];
    }
    h->padded = (h->count + 3) / 4 * 4;
    for (size_t k = h->count; k < h->padded; k++) {
        h->candidate[k] = h->candidate[0];
        h->slope[k] = 0;
    }
    return h;
}

static bool is_image(const sb_space *space, sb_record record)
{
    const sb_record original = sb_space_wrap(space, record);
    return original[0] != record[0] || original[1] != record[1] || original[2] != record[2];
}

uint32_t sb_wall_list_body(const sb_sim *sim, sb_wall_list walls)
{
    if (walls.count == 0) return SB_WALL_NONE;
    const uint32_t first = sb_wall_body(sim, walls.index[0]);
    for (size_t k = 0; k < walls.count; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, walls.index[k]);
        const uint32_t at = sb_wall_particle(walls.index[k]);
        if (set->body[at] != first || (sim->space.repeats && is_image(&sim->space, set->record[at])))
            return SB_WALL_SEVERAL;
    }
    return first;
}

sb_wall_search sb_wall_search_of(const sb_sim *sim)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const int d = sim->constant.dimension;
    const double h = (double)sim->constant.support, quantum = sim->space.quantum;
    return (sb_wall_search){.kernel = kernel,
                            .batch = sb_kernel_batch_for(kernel),
                            .find_hits = sb_find_hits_choose(),
                            .q_scale = (float)(quantum / h * (quantum / h)),
                            .slope_scale = (float)(kernel->alpha[d] * quantum / pow(h, d + 2))};
}

sb_status sb_wall_finder_refuse(const sb_sim *sim, unsigned full, sb_error *error)
{
    if (full == 0) return SB_OK;
    const unsigned long long step = (unsigned long long)sim->state.step;
    if (full & SB_FULL_WALLS)
        return sb_fail(error, SB_FAILED,
                       "step %llu: more than %d boundary particles within one cell and its neighbour cells: walls are "
                       "too dense, or too many bodies meet there",
                       step, SB_WALLS_AROUND_MAX);
    return sb_fail(error, SB_FAILED,
                   "step %llu: more than %d boundary particles around one particle: walls are too dense", step,
                   SB_LIST_MAX);
}

#include "sim/terms/cell_mean.h"

#include "base/memory.h"

enum { SIDE = 3, AROUND = 27 }; /* a cell and its neighbours: along one axis, in all */

SB_INLINE sb_cell_sum plus(sb_cell_sum a, sb_cell_sum b)
{
    return (sb_cell_sum){a.rest + b.rest, a.more + b.more};
}

/* base: the entry of the first particle of these cells; first: the entry of the sums of the first cell. */
static void sum_cells(sb_sim *sim, const sb_cells *cells, const sb_f4 *rest, size_t base, size_t first)
{
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < cells->count; c++) {
        sb_cell_sum all = {{0}, {0}};
        for (size_t k = base + cells->begin[c]; k < base + cells->begin[c + 1]; k++)
            all = plus(all, (sb_cell_sum){rest[k], {sb_carried_value(sim->state.position[k]), 1, 0, 0}});
        sim->work.cell_sum[first + c] = all;
    }
}

/* The sums of the first cells: owned, of the halo, of images. */
SB_INLINE size_t halo_sums(const sb_sim *sim)
{
    return sim->cells.count;
}

SB_INLINE size_t image_sums(const sb_sim *sim)
{
    return sim->cells.count + sim->ghosts.halo_cells.count;
}

static sb_cell_sum sum_of(const sb_sim *sim, const sb_cells *cells, uint64_t code, size_t first)
{
    const int64_t cell = sb_cells_find(cells, code);
    if (cell < 0) return (sb_cell_sum){{0}, {0}};
    return sim->work.cell_sum[first + (size_t)cell];
}

/* The sums of a cell of water, which is whole in one domain. */
static sb_cell_sum sum_of_water(const sb_sim *sim, uint64_t code)
{
    const int64_t cell = sb_cells_find(&sim->cells, code);
    return cell < 0 ? sum_of(sim, &sim->ghosts.halo_cells, code, halo_sums(sim)) : sim->work.cell_sum[cell];
}

/* Layers of cells along y that a mean has: in a slice there is one. */
SB_INLINE int layers_of(const sb_sim *sim)
{
    return sim->constant.dimension == 2 ? 1 : SIDE;
}

/* The sums around cell c, x fastest, z slowest. Returns whether any tensor among them is not 0: beside walls and in
   shallow water all are. */
static bool gather(const sb_sim *sim, size_t c, sb_cell_sum around[AROUND])
{
    const int layers = layers_of(sim);
    sb_i4 bits = {0};
    for (int z = -1; z <= 1; z++)
        for (int y = -(layers / 2); y <= layers / 2; y++)
            for (int x = -1; x <= 1; x++, around++) {
                const uint64_t code = sim->cells.code[c] + sb_cell_step(x, y, z);
                *around = sum_of_water(sim, code);
                if (sim->ghosts.any) *around = plus(*around, sum_of(sim, &sim->ghosts.cells, code, image_sums(sim)));
                bits |= (sb_i4)around->rest | ((sb_i4)around->more & (sb_i4){-1, 0, 0, 0});
            }
    return (bits[0] | bits[1] | bits[2] | bits[3]) != 0;
}

/* Weights of the cells before, at and after a place, which is at u from 0 to 1 in its own. */
SB_INLINE void spline(float u, float weight[SIDE])
{
    weight[0] = 0.5f * (1 - u) * (1 - u);
    weight[2] = 0.5f * u * u;
    weight[1] = 1 - weight[0] - weight[2];
}

/* The mean at a place: a sum whose count is 1. Callers give `layers` as a constant, so that loops have no branches. */
SB_INLINE sb_cell_sum mean_at(const sb_cell_sum around[AROUND], sb_record place, uint32_t inside, int layers)
{
    const float per_edge = 1 / ((float)inside + 1);
    float weight[3][SIDE];
    for (int axis = 0; axis < 3; axis++) spline((float)(place[axis] & inside) * per_edge, weight[axis]);
    sb_cell_sum sum = {{0}, {0}};
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < layers; y++)
            for (int x = 0; x < SIDE; x++, around++) {
                const sb_f4 w = sb_splat(weight[0][x] * (layers == 1 ? 1 : weight[1][y]) * weight[2][z]);
                sum = plus(sum, (sb_cell_sum){around->rest * w, around->more * w});
            }
    const sb_f4 count = sb_splat(sum.more[1]);
    return (sb_cell_sum){sum.rest / count, sum.more / count};
}

SB_MULTIVERSION
static void mean_in_cell(sb_sim *sim, size_t c, float *xx, sb_f4 *rest)
{
    sb_cell_sum around[AROUND];
    const bool any = gather(sim, c, around), flat = layers_of(sim) == 1;
    const uint32_t inside = ((uint32_t)1 << sim->space.shift) - 1;
    for (uint32_t i = sim->cells.begin[c]; i < sim->cells.begin[c + 1]; i++) {
        sb_cell_sum mean = {{0}, {0}};
        if (any) {
            const sb_record place = sim->state.position[i];
            mean = flat ? mean_at(around, place, inside, 1) : mean_at(around, place, inside, SIDE);
        }
        rest[i] = mean.rest;
        xx[i] = mean.more[0];
    }
}

int sb_cell_mean(sb_sim *sim, float *xx, sb_f4 *rest)
{
    sb_work *w = &sim->work;
    const size_t all = image_sums(sim) + sim->ghosts.cells.count;
    const int grown = sb_grow((void **)&w->cell_sum, &w->cell_sum_capacity, all, sizeof *w->cell_sum);
    if (sb_ranks_any(sim->ranks, grown != 0)) return -1;
    sum_cells(sim, &sim->cells, rest, 0, 0);
    sum_cells(sim, &sim->ghosts.halo_cells, rest, sim->state.n, halo_sums(sim));
    sum_cells(sim, &sim->ghosts.cells, rest, sb_images_first(sim), image_sums(sim));
    const size_t cells = sim->cells.count;
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t c = 0; c < cells; c++) mean_in_cell(sim, c, xx, rest);
    return 0;
}

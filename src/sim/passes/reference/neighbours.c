/* The neighbour search by testing all records around a group, and all boundary particles around a cell. */
#include "base/memory.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"

#include <math.h>

/* Smallest r/h at which slopes are computed: coincident particles are separated by jitter, not by pressure. */
static const double NEAREST = 1e-4;

typedef struct searcher {
    sb_vicinity vicinity;
    sb_hits hits;
} searcher;

static void *create(const sb_sim *sim)
{
    (void)sim;
    return sb_alloc(1, sizeof(searcher));
}

/* W in 1/m^d, and W'/r times the quantum. */
typedef struct kernel_values {
    double value, slope;
} kernel_values;

static kernel_values kernel_at(const sb_sim *sim, sb_vec3 offset)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const double h = (double)sim->constant.support, r = sb_norm(offset) * sim->space.quantum,
                 near = fmax(r, NEAREST * h);
    return (kernel_values){sb_kernel_value(kernel, sim->constant.dimension, h, r),
                           sb_kernel_slope(kernel, sim->constant.dimension, h, near) / near * sim->space.quantum};
}

static bool within(const sb_sim *sim, sb_vec3 offset)
{
    return sb_norm(offset) * sim->space.quantum < (double)sim->constant.support;
}

/* Sums of one particle. */
typedef struct sums {
    double density, wall_density, squares, flux;
    sb_vec3 water, wall; /* sum_j m grad W_ij, sum_b psi_b grad W_ib */
} sums;

/* Collects the hits among the records around the group. own: the particle's place among them. */
static void add_water(const sb_sim *sim, const sb_vicinity *v, sb_vec3 self, size_t own, sb_hits *hits, sums *s)
{
    const double mass = (double)sim->constant.mass, unit = (double)sim->work.pairs.unit;
    size_t n = 0;
    for (size_t k = 0; k < v->count; k++) {
        const sb_vec3 d = sb_sub(self, sb_vector_of(v->place[k]));
        if (k == own || !within(sim, d) || n == SB_LIST_MAX) continue;
        const kernel_values w = kernel_at(sim, d);
        const double root = fmin(floor(sqrt(mass * w.slope / unit) + 0.5), SB_ROOT_MAX), slope = unit * root * root;
        s->density += mass * w.value;
        s->water = sb_madd(s->water, slope, d);
        s->squares += slope * slope * sb_dot(d, d);
        hits->candidate[n] = (uint32_t)k;
        hits->root[n++] = (float)root;
    }
    hits->count = n;
    hits->padded = (n + SB_HIT_LANES - 1) / SB_HIT_LANES * SB_HIT_LANES;
    for (size_t k = n; k < hits->padded; k++) {
        hits->candidate[k] = (uint32_t)own;
        hits->root[k] = 0;
    }
}

static void add_wall_cell(const sb_sim *sim, uint32_t number, uint64_t code, size_t i, sb_hits *hits, sums *s)
{
    const sb_wall_set *set = &sim->walls.set[number];
    const int64_t cell = sb_cells_find(&set->cells, code);
    for (uint32_t b = cell < 0 ? 0 : set->cells.begin[cell]; cell >= 0 && b < set->cells.begin[cell + 1]; b++) {
        const sb_vec3 d = sb_offset_of(sim->state.position[i], set->record[b]);
        if (!within(sim, d) || hits->count == SB_LIST_MAX) continue;
        const kernel_values w = kernel_at(sim, d);
        const double psi = (double)sb_carried_value(set->record[b]), slope = psi * w.slope;
        const uint32_t entry = sb_wall_entry(number, b);
        s->wall_density += psi * w.value;
        s->wall = sb_madd(s->wall, slope, d);
        s->flux += slope * sb_dot(d, sb_vector_of(sb_wall_velocity(sim, entry)));
        hits->candidate[hits->count] = entry;
        hits->slope[hits->count++] = (float)slope;
    }
}

static void add_walls(const sb_sim *sim, size_t i, sb_hits *hits, sums *s)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const uint64_t code = sb_cell_code(sim->state.position[i], sim->space.shift);
    hits->count = 0;
    for (uint32_t set = 0; set < SB_WALL_SETS; set++)
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -layers; dy <= layers; dy++)
                for (int dx = -1; dx <= 1; dx++) add_wall_cell(sim, set, code + sb_cell_step(dx, dy, dz), i, hits, s);
}

static void set_fields(sb_sim *sim, size_t i, const sums *s)
{
    const sb_vec3 all = sb_add(s->water, s->wall);
    const double diagonal = s->squares + sb_dot(all, all);
    sim->work.density[i] = (float)(s->density + s->wall_density);
    sim->work.wall[i] = (sb_f4){(float)s->wall.x, (float)s->wall.y, (float)s->wall.z, (float)s->flux};
    sim->work.diagonal[i] = diagonal > 1e-6 * (double)sim->constant.full_diagonal ? (float)diagonal : 0;
    if (sim->work.water_squared) sim->work.water_squared[i] = (float)sb_dot(s->water, s->water);
}

/* The place of particle i among the records around its group. */
static size_t own_place(const sb_vicinity *v, size_t i)
{
    size_t before = 0;
    for (size_t r = 0; r < v->runs; before += v->run[r++].count)
        if (i >= v->run[r].begin && i < v->run[r].begin + v->run[r].count) return before + i - v->run[r].begin;
    return SIZE_MAX;
}

static unsigned search(sb_sim *sim, void *of, sb_list_builder *lists, sb_group *group)
{
    searcher *w = of;
    unsigned full = 0;
    sb_vicinity_gather(sim, group, &w->vicinity);
    if (w->vicinity.count > SB_AROUND_MAX) return SB_FULL_AROUND;
    sb_list_runs(lists, &w->vicinity, group);
    group->images = group->planes = 0;
    for (size_t i = group->first; i < group->end; i++) {
        sums s = {.density = (double)sim->constant.mass * kernel_at(sim, (sb_vec3){0}).value};
        add_water(sim, &w->vicinity, sb_offset_of(sim->state.position[i], group->corner), own_place(&w->vicinity, i),
                  &w->hits, &s);
        full |= w->hits.count == SB_LIST_MAX ? SB_FULL_LIST : 0;
        sb_list_water(lists, &w->hits, sim, i);
        add_walls(sim, i, &w->hits, &s);
        sim->work.wall_pairs.count[i] = 0;
        if (w->hits.count > 0) sb_list_walls(lists, &w->hits, sim, i);
        set_fields(sim, i, &s);
    }
    return full;
}

sb_status sb_plain_neighbours(sb_sim *sim, sb_error *error)
{
    if (sim->needs.images) return sb_fail(error, SB_FAILED, "the reference passes have no images of walls");
    static const sb_search_form form = {create, search};
    return sb_search_all(sim, &form, error);
}

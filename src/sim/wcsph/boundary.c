/* Rates and pressures of dynamic boundary particles: a loop over the water around each of them. */
#include "sim/wcsph/boundary.h"

#include "base/hash.h"
#include "base/memory.h"
#include "physics/kernels/tait.h"
#include "sim/exchange/domains.h"
#include "sim/passes/cpu/kernel_batch.h"
#include "sim/search/around.h"
#include "sim/walls/entry.h"
#include "sim/wcsph/wcsph.h"

#include <math.h>

int sb_boundary_create(sb_sim *sim)
{
    sb_boundary *b = &sim->walls.boundary;
    b->excess = sb_alloc(b->count, sizeof *b->excess);
    b->begin = sb_alloc(b->count, sizeof *b->begin);
    b->rate = sb_alloc(b->count, sizeof *b->rate);
    b->load = sb_alloc(b->count, sizeof *b->load);
    for (size_t k = 0; b->excess && k < b->count; k++) b->excess[k] = NAN;
    return b->excess && b->begin && b->rate && b->load ? 0 : -1;
}

void sb_boundary_destroy(sb_sim *sim)
{
    sb_boundary *b = &sim->walls.boundary;
    sb_free(b->excess);
    sb_free(b->begin);
    sb_free(b->rate);
    sb_free(b->load);
    *b = (sb_boundary){0};
}

/* What the sums over the water need: constants of the run. */
typedef struct sums_of {
    const sb_kernel *kernel;
    sb_kernel_batch *batch;
    float to_q2, slope; /* (quantum/h)^2; m alpha quantum/h^(d+2), so that slope w'(q)/q d is m grad W, kg/m^4 */
    float weight;       /* Pa per quantum: rho_0 g quantum, hydrostatic */
} sums_of;

static sums_of constants_of(const sb_sim *sim)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const int d = sim->constant.dimension;
    const double h = (double)sim->constant.support, quantum = sim->space.quantum;
    return (sums_of){kernel, sb_kernel_batch_for(kernel), (float)(quantum * quantum / (h * h)),
                     (float)((double)sim->constant.mass * kernel->alpha[d] * quantum / pow(h, d + 2)),
                     (float)((double)sim->constant.rest_density * (double)sim->constant.gravity * quantum)};
}

enum { HITS = 64 }; /* water particles per call of the kernel */

/* Sums over the water around one boundary particle. */
typedef struct boundary_sums {
    float weight, pressure; /* sum W, and of W times the water's pressure at the boundary particle */
    float rate;             /* kg/m^3/s: sum m (v_b - v_j) . grad W_bj */
    size_t hits;
    float q2[HITS], value[HITS], slope[HITS], load[HITS], approach[HITS];
} boundary_sums;

/* Ends a batch of hits. */
static void add_hits(boundary_sums *s, const sums_of *of)
{
    if (s->hits == 0) return;
    of->batch(of->kernel, s->q2, s->hits, s->value, s->slope);
    for (size_t k = 0; k < s->hits; k++) {
        s->weight += s->value[k];
        s->pressure += s->value[k] * s->load[k];
        s->rate += s->slope[k] * s->approach[k];
    }
    s->hits = 0;
}

/* Consecutive particles, ghosts included. */
typedef struct range {
    size_t begin, end;
} range;

/* The water around one cell. */
typedef struct surroundings {
    range range[54];
    size_t count;
} surroundings;

static void add_range(const sb_cells *cells, uint64_t code, size_t base, surroundings *around)
{
    const int64_t cell = sb_cells_find(cells, code);
    if (cell >= 0) around->range[around->count++] = (range){base + cells->begin[cell], base + cells->begin[cell + 1]};
}

/* Finds the water in a cell and around it. */
static surroundings around_cell(const sb_sim *sim, uint64_t code)
{
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    surroundings around = {.count = 0};
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -layers; dy <= layers; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                const uint64_t there = code + sb_cell_step(dx, dy, dz);
                add_range(&sim->cells, there, 0, &around);
                if (sim->ghosts.halo > 0) add_range(&sim->ghosts.halo_cells, there, sim->state.n, &around);
                if (sim->ghosts.count > 0) add_range(&sim->ghosts.cells, there, sb_images_first(sim), &around);
            }
    return around;
}

/* Adds the water of a range to the sums of a boundary particle at `at`. */
static void add_water(const sb_sim *sim, const sums_of *of, range water, sb_record at, sb_f4 velocity, boundary_sums *s)
{
    const float relative = 1 / sim->constant.rest_density;
    for (size_t j = water.begin; j < water.end; j++) {
        const sb_f4 d = sb_offset(at, sim->state.position[j]);
        const float q2 = sb_sum3(d * d) * of->to_q2;
        if (!(q2 < 1)) continue;
        const float excess = sim->state.excess[sb_entry_owner(sim, (uint32_t)j)];
        s->q2[s->hits] = q2;
        s->load[s->hits] = sb_tait_pressure(sim->constant.stiffness, excess * relative) - of->weight * d[2];
        s->approach[s->hits++] = sb_sum3(d * (velocity - sim->state.velocity[j]));
        if (s->hits == HITS) add_hits(s, of);
    }
}

/* Excess at a pressure in Pa. */
static float excess_at(const sb_sim *sim, float pressure)
{
    const double relative = sb_tait_excess((double)sim->constant.stiffness, (double)pressure);
    return (float)((double)sim->constant.rest_density * relative);
}

/* Rate and load of particle k of a set. One that water reaches starts with the density of the water's pressure. */
static void find_state(sb_sim *sim, const sums_of *of, const surroundings *around, uint32_t set_index, size_t k)
{
    const sb_wall_set *set = &sim->walls.set[set_index];
    sb_boundary *b = &sim->walls.boundary;
    const uint32_t number = sb_boundary_number(set, k);
    const sb_record at = set->record[k];
    const sb_f4 velocity = sb_wall_velocity(sim, sb_wall_entry(set_index, (uint32_t)k));
    boundary_sums s;
    s.weight = s.pressure = s.rate = 0;
    s.hits = 0;
    for (size_t r = 0; r < around->count; r++) add_water(sim, of, around->range[r], at, velocity, &s);
    add_hits(&s, of);
    b->rate[number] = b->load[number] = 0;
    if (!(s.weight > 0)) {
        b->excess[number] = b->begin[number] = NAN; /* dry */
        return;
    }
    const float rest = sim->constant.rest_density, near = s.pressure / s.weight;
    if (isnan(b->excess[number])) b->excess[number] = near > 0 ? excess_at(sim, near) : 0;
    const float density = rest + b->excess[number];
    const float beta = (float)sim->scene->numerics.wall_beta;
    const float own = sb_tait_pressure(sim->constant.stiffness, b->excess[number] / rest);
    const float pressure = beta * near + (1 - beta) * own;
    b->rate[number] = of->slope * s.rate;
    b->load[number] = pressure > 0 ? pressure / (density * density) : 0;
}

/* Whether this domain computes the boundary particles of a cell: it has all water around each of its own cells. */
static bool is_own(const sb_sim *sim, const sb_wall_set *set, size_t cell)
{
    return !sim->domains ||
           sb_domains_owns(sim->domains, sb_space_key(&sim->space, set->record[set->cells.begin[cell]]));
}

/* The state of a boundary particle that a domain has computed. */
typedef struct computed {
    uint32_t number;
    float excess, begin, rate, load;
} computed;

/* Writes those of this domain to `to`, if it is not NULL. Returns their number. */
static size_t list_computed(const sb_sim *sim, computed *to)
{
    const sb_boundary *b = &sim->walls.boundary;
    size_t count = 0;
    for (uint32_t s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls.set[s];
        for (size_t c = 0; set->count > 0 && c < set->cells.count; c++)
            for (size_t k = set->cells.begin[c]; is_own(sim, set, c) && k < set->cells.begin[c + 1]; k++) {
                const uint32_t n = set->number[k];
                if (n & SB_BOUNDARY_IMAGE) continue;
                if (to) to[count] = (computed){n, b->excess[n], b->begin[n], b->rate[n], b->load[n]};
                count++;
            }
    }
    return count;
}

/* Gives all domains what each has computed. Returns 0, or -1 without memory in any domain. */
static int share(sb_sim *sim)
{
    sb_ranks *ranks = sim->ranks;
    sb_boundary *b = &sim->walls.boundary;
    if (!sb_ranks_several(ranks)) return 0;
    size_t sizes[SB_RANKS_MAX], all = 0;
    const size_t own = list_computed(sim, NULL) * sizeof(computed);
    sb_ranks_gather(ranks, &own, sizeof own, sizes);
    for (int r = 0; r < ranks->count; r++) all += sizes[r];
    computed *mine = sb_alloc_untouched(own, 1), *theirs = sb_alloc_untouched(all, 1);
    const bool failed = sb_ranks_any(ranks, !mine || !theirs);
    if (!failed) {
        list_computed(sim, mine);
        sb_ranks_spread(ranks, mine, theirs, sizes);
        for (size_t k = 0; k < all / sizeof *theirs; k++) {
            const computed *one = &theirs[k];
            b->excess[one->number] = one->excess, b->begin[one->number] = one->begin;
            b->rate[one->number] = one->rate, b->load[one->number] = one->load;
        }
    }
    sb_free(mine);
    sb_free(theirs);
    return failed ? -1 : 0;
}

sb_status sb_stage_boundary(sb_sim *sim, sb_error *error)
{
    sb_refresh_owners_values(sim, sim->state.excess);
    const sums_of of = constants_of(sim);
    sb_boundary *all = &sim->walls.boundary;
    for (size_t k = 0; k < all->count; k++) all->rate[k] = all->load[k] = 0; /* those beyond the domain have none */
    for (uint32_t s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls.set[s];
        const size_t cells = set->count > 0 ? set->cells.count : 0;
#pragma omp parallel for schedule(dynamic, 16)
        for (size_t c = 0; c < cells; c++) {
            if (!is_own(sim, set, c)) continue;
            const surroundings around = around_cell(sim, set->cells.code[c]);
            for (size_t k = set->cells.begin[c]; k < set->cells.begin[c + 1]; k++)
                if (!(set->number[k] & SB_BOUNDARY_IMAGE)) find_state(sim, &of, &around, s, k);
        }
    }
    return share(sim) == 0 ? SB_OK : sb_fail_memory(error, "boundary particles");
}

void sb_boundary_predict(sb_sim *sim, float dt)
{
    sb_boundary *b = &sim->walls.boundary;
    for (size_t k = 0; k < b->count; k++) {
        b->begin[k] = b->excess[k];
        b->excess[k] += 0.5f * dt * b->rate[k]; /* NAN: dry */
    }
}

void sb_boundary_correct(sb_sim *sim, float dt)
{
    sb_boundary *b = &sim->walls.boundary;
    const float rest = sim->constant.rest_density;
    for (size_t k = 0; k < b->count; k++) {
        b->excess[k] = sb_wcsph_density_after(rest, b->begin[k], b->excess[k], dt * b->rate[k]);
        if (b->excess[k] < 0) b->excess[k] = 0; /* a wall does not hold water by tension */
    }
}

uint64_t sb_boundary_hash(const sb_sim *sim, uint64_t hash)
{
    const sb_boundary *b = &sim->walls.boundary;
    return b->count > 0 ? sb_hash(hash, b->excess, b->count * sizeof *b->excess) : hash;
}

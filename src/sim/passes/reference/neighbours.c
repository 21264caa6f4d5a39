/* The neighbour search by testing all records around a group, and all boundary particles around a cell. */
#include "base/memory.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"

#include <math.h>

typedef struct searcher {
    sb_vicinity vicinity;
    sb_hits hits;
} searcher;

static void *create(const sb_sim *sim)
{
    (void)sim;
    return sb_alloc(1, sizeof(searcher));
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
        if (k == own || !sb_plain_within(sim, d) || n == SB_LIST_MAX) continue;
        const sb_plain_kernel w = sb_plain_kernel_at(sim, d);
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

static void add_walls(const sb_sim *sim, size_t i, sb_hits *hits, sums *s)
{
    sb_one_wall wall[SB_PLAIN_WALLS_MAX];
    hits->count = sb_plain_walls(sim, i, wall);
    for (size_t k = 0; k < hits->count; k++) {
        s->wall_density += wall[k].value;
        s->wall = sb_madd(s->wall, wall[k].slope, wall[k].offset);
        s->flux += wall[k].slope * sb_dot(wall[k].offset, sb_vector_of(sb_wall_velocity(sim, wall[k].entry)));
        hits->candidate[k] = wall[k].entry;
        hits->slope[k] = (float)wall[k].slope;
    }
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
        sums s = {.density = (double)sim->constant.mass * sb_plain_kernel_at(sim, (sb_vec3){0}).value};
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

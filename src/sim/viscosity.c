/* v* = v + dt (g + Monaghan viscosity [S16, eq. 14] + physical and eddy viscosity + friction and shear of walls). */
#include "sim/around.h"
#include "sim/friction.h"
#include "sim/pressure.h"
#include "sim/sleep.h"

enum { GROUPS = 8 }; /* per unit of work */

/* Factors of one step. */
typedef struct factors {
    float artificial; /* 2 alpha h c_s; over (rho_i + rho_j) it is the nu of eq. 14 */
    float physical;   /* 4 (d + 2) nu; over (rho_i + rho_j), the unswitched part */
    float eddy;       /* 2 (d + 2); times nu_t,i + nu_t,j the same of the eddies */
    float epsilon;    /* 0.01 h^2 in quanta^2 */
    float inverse_quantum;
} factors;

static factors make_factors(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    const sb_constants *c = &sim->constant;
    double h_quanta = (double)c->support / sim->space.quantum;
    return (factors){
        .artificial = 2.0f * (float)n->artificial_viscosity * c->support * c->sound_speed,
        .physical = 4.0f * (float)(c->dimension + 2) * c->viscosity,
        .eddy = 2.0f * (float)(c->dimension + 2),
        .epsilon = (float)(0.01 * h_quanta * h_quanta),
        .inverse_quantum = (float)(1.0 / sim->space.quantum),
    };
}

/* -sum_j m Pi_ij grad W_ij, four neighbours at a time; around: sb_around_with velocities, the records carrying the
   densities. x . v and r^2 are in quanta, their quotient brought back by 1/quantum. eddies: sim->eddy stands in the
   velocities' last lane. first: neighbours before that place are left out. */
SB_INLINE sb_f4 fluid_part(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i, const factors *f,
                           bool eddies, uint32_t first)
{
    const sb_f4 self = sb_in_group(sim, group, i), v = sim->velocity[i];
    const sb_f4 own_density = sb_splat(self[3]), epsilon = sb_splat(f->epsilon);
    const sb_four_pairs *four = sim->pairs.four + sim->pairs.first[i], *end = four + sim->pairs.count[i];
    sb_f4 x = {0}, y = {0}, z = {0};
    for (; four < end; four++) {
        const sb_f4 *a = sb_at_with(around, four->place[0]), *b = sb_at_with(around, four->place[1]);
        const sb_f4 *c = sb_at_with(around, four->place[2]), *e = sb_at_with(around, four->place[3]);
        const sb_four d = sb_turn(self - a[0], self - b[0], self - c[0], self - e[0]);
        const sb_four u = sb_turn(v - a[1], v - b[1], v - c[1], v - e[1]);
        const sb_f4 density = {a[0][3], b[0][3], c[0][3], e[0][3]};
        sb_f4 weight = sb_slopes(four);
        if (first > 0)
            weight = sb_select((sb_i4){four->place[0], four->place[1], four->place[2], four->place[3]} >= (int)first,
                               weight, (sb_f4){0});
        sb_f4 approach = u.x * d.x + u.y * d.y + u.z * d.z;
        sb_f4 r2 = d.x * d.x + d.y * d.y + d.z * d.z;
        sb_f4 physical = sb_splat(f->physical);
        if (eddies)
            physical += (sb_splat(sim->eddy[i]) + (sb_f4){a[1][3], b[1][3], c[1][3], e[1][3]}) * sb_splat(f->eddy);
        sb_f4 factor = sb_select(approach < (sb_f4){0}, physical + sb_splat(f->artificial), physical);
        sb_f4 pi = factor * approach * weight / ((r2 + epsilon) * (own_density + density));
        x += d.x * pi;
        y += d.y * pi;
        z += d.z * pi;
    }
    const sb_four sum = sb_turn(x, y, z, (sb_f4){0});
    return (sum.x + sum.y + sum.z + sum.w) * sb_splat(sim->pairs.unit * f->inverse_quantum);
}

SB_INLINE sb_f4 wall_part(const sb_sim *sim, size_t i, const sb_rub *rub)
{
    const uint32_t *index = sim->wall_pairs.index + sim->wall_pairs.first[i];
    const float *slope = sim->wall_pairs.slope + sim->wall_pairs.first[i];
    sb_f4 sum = {0}, part[4];
    for (size_t k = 0; k < sim->wall_pairs.count[i]; k += 4) {
        sb_rubbed(sim, i, sim->velocity[i], index + k, slope + k, rub, part);
        for (int pair = 0; pair < 4; pair++) sum += part[pair];
    }
    return sum;
}

SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const factors *f, bool viscous, const sb_rub *rub)
{
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const float dt = (float)sim->report.time_step;
    sb_f4 *next = sim->scratch;
    if (viscous) sb_around_with(sim, group, sim->velocity, around);
    if (sim->eddy) sb_around_last(sim, group, sim->eddy, around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_f4 a = {sim->settling ? sb_settle_pull(sim, sim->position[i]) : 0, 0, -sim->constant.gravity, 0};
        if (sim->eddy)
            a += fluid_part(sim, group, around, i, f, true, 0);
        else if (viscous)
            a += fluid_part(sim, group, around, i, f, false, 0);
        if (rub->on && sim->wall_pairs.count[i] > 0) a += sim->rubbed[i] = wall_part(sim, i, rub);
        a[3] = 0;
        next[i] = sim->velocity[i] + a * sb_splat(dt);
    }
}

static sb_f4 share_of_sleepers(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i,
                               const void *with)
{
    return fluid_part(sim, group, around, i, with, sim->eddy != NULL, group->sleepers * SB_PLACE_STEP);
}

sb_status sb_stage_forces(sb_sim *sim, sb_error *error)
{
    (void)error;
    const factors f = make_factors(sim);
    const sb_rub rub = sb_rub_make(sim);
    const bool viscous = f.artificial > 0 || f.physical > 0 || sim->eddy;
    const size_t groups = sim->groups.count;
    if (viscous) sb_pressure_load(sim, sim->density);
#pragma omp parallel for schedule(dynamic, GROUPS)
    for (size_t g = 0; g < groups; g++) do_group(sim, &sim->groups.group[g], &f, viscous, &rub);
    if (sb_fringe_count(sim) > 0) sim->sleep->rub = viscous ? sb_sleep_sum(sim, share_of_sleepers, &f) : (sb_vec3){0};
    sb_f4 *old = sim->velocity;
    sim->velocity = sim->scratch;
    sim->scratch = old;
    sb_ghosts_refresh(sim, sim->velocity);
    return SB_OK;
}

/* The symplectic update [S16, eqs. 17, 18]. */
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/step/ledger.h"
#include "sim/step/motion.h"
#include "sim/step/stages.h"

#include <float.h>
#include <math.h>

/* Largest squared speed of the block (NaN if any speed is NaN), and its particle. */
typedef struct fastest {
    float square;
    size_t particle;
} fastest;

/* Fraction of the velocity that remains in this step. The damping is critical for the slowest oscillation: more would
   hold back the water's levels. */
static float kept(const sb_sim *sim)
{
    return sim->policy->damps ? expf(-2 * sim->constant.slowest * (float)sim->state.time_step) : 1;
}

SB_MULTIVERSION
static fastest accelerate(sb_sim *sim, size_t block)
{
    const sb_f4 dt = sb_splat((float)sim->state.time_step);
    const sb_f4 damping = sb_splat(kept(sim));
    const bool flat = sim->constant.dimension == 2;
    fastest top = {0, block * SB_BLOCK};
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        sb_f4 v = (sim->work.predicted[i] + sim->work.acceleration[i] * dt) * damping;
        v[3] = sim->work.unknown[i] * sim->work.density[i] * sim->work.density[i];
        if (flat) v[1] = 0;
        float square = sb_sum3(v * v);
        if (!(square <= top.square)) top = (fastest){square, i};
        if (isnan(square)) return top;
        sim->work.end_velocity[i] = v;
    }
    return top;
}

/* The velocity with which a particle moves. A particle under pressure moves with the velocity at the step's end, which
   the solve has made divergence-free. A particle without neighbours moves with the mean of the velocities before and
   after the step, and so follows its ballistic parabola. In the second half of an explicit step all particles move with
   the velocity at the step's end; in the first half they moved with that at its start. */
SB_INLINE sb_f4 moving_velocity(const sb_sim *sim, size_t i, sb_f4 start, sb_f4 end)
{
    return sim->work.diagonal[i] > 0 || sim->needs.wcsph ? end : (start + end) * sb_splat(0.5f);
}

/* Moves the particles of a group. Returns their largest squared speed, after contact resolution. book: whether to
   compute the group's terms of the ledger. */
SB_INLINE float move_group(sb_sim *sim, const sb_group *group, bool book, double terms[SB_TALLY_TERMS])
{
    const sb_f4 *start = sim->state.velocity;
    sb_ledger_tally tally = {0};
    const float part = sim->needs.wcsph ? 0.5f : 1;
    const float step = sim->policy->moves ? part * (float)(sim->state.time_step / sim->space.quantum) : 0;
    const float after = sim->policy->keep_after;
    const sb_f4 keep = {after, after, after, 1};
    float top = 0;
    for (size_t i = group->first; i < group->end; i++) {
        sb_f4 v = sim->work.end_velocity[i];
        const sb_f4 way = book ? moving_velocity(sim, i, start[i], v) : v;
        const uint32_t height = sim->state.position[i][2];
        sim->state.position[i] = (sb_record){sb_moved(sim->state.position[i][0], way[0] * step),
                                             sb_moved(sim->state.position[i][1], way[1] * step),
                                             sb_moved(sim->state.position[i][2], way[2] * step), 0};
        if (book)
            sb_ledger_add(&tally, start[i], sim->work.predicted[i], v, (int64_t)sim->state.position[i][2] - height);
        sim->state.velocity[i] = book ? v : v * keep;
        float square = sb_sum3(v * v);
        top = square > top ? square : top;
    }
    if (book) sb_ledger_terms(&tally, terms);
    return top;
}

SB_MULTIVERSION
static double move(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    return (double)(sim->policy->runs ? move_group(sim, group, true, terms) : move_group(sim, group, false, terms));
}

sb_status sb_sim_diverged(const sb_sim *sim, size_t particle, sb_f4 velocity, sb_error *error)
{
    const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[particle]);
    return sb_fail(error, SB_FAILED,
                   "step %llu, t = %g s: diverged: particle %u at (%.4g, %.4g, %.4g) m would move at %g m/s, "
                   "expected below %g (density error %.3g after %d iterations)",
                   (unsigned long long)sim->state.step + 1, sim->state.time, sim->state.id[particle], at.x, at.y, at.z,
                   (double)sqrtf(sb_sum3(velocity * velocity)), (double)sim->constant.speed_limit,
                   sim->report.error_mean, sim->work.solve.iterations);
}

/* The faster of two. NaN counts as the fastest, and of equal speeds the first particle's, so that the result does not
   depend on the threads. */
static fastest faster(fastest a, fastest b)
{
    if (isnan(a.square) || isnan(b.square))
        return isnan(a.square) && (!isnan(b.square) || a.particle < b.particle) ? a : b;
    if (a.square == b.square) return a.particle < b.particle ? a : b;
    return a.square > b.square ? a : b;
}

/* A number by which domains compare the squares of their fastest: in the order of `faster`, and never NaN. */
static double order_of(float square)
{
    return isnan(square) ? (double)INFINITY : fmin((double)square, DBL_MAX);
}

/* Of domains whose fastest particles are equally fast, the first has the failure's message, as its particles come first
   without domains. */
sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error)
{
    const size_t blocks = sb_blocks(sim);
    fastest top = {0, SIZE_MAX};
#pragma omp parallel
    {
        fastest own = {0, SIZE_MAX};
#pragma omp for schedule(static) nowait
        for (size_t b = 0; b < blocks; b++) own = faster(own, accelerate(sim, b));
#pragma omp critical(sb_fastest)
        top = faster(top, own);
    }
    const double own = order_of(top.square), fastest_of_all = sim->exchange->largest(sim, own);
    if (top.square <= sim->constant.speed_limit * sim->constant.speed_limit) return SB_OK;
    if (own < fastest_of_all) return sb_fail(error, SB_FAILED, "%s", ""); /* another domain has the message */
    return sb_sim_diverged(sim, top.particle, (sb_f4){sqrtf(top.square)}, error);
}

sb_status sb_stage_move(sb_sim *sim, sb_error *error)
{
    (void)error;
    double sum[SB_TALLY_TERMS];
    const double top = sb_sum_groups(sim, SB_TALLY_TERMS, move, sum);
    sb_ledger_sums *s = &sim->work.sums;
    double *const sums[SB_TALLY_TERMS] = {&s->forces,  &s->solve,   &s->fall,    &s->rise,
                                          &s->gain[0], &s->gain[1], &s->gain[2], &s->size};
    for (size_t k = 0; k < SB_TALLY_TERMS; k++) *sums[k] = sum[k];
    s->rise += sim->work.first_rise;
    if (sim->policy->runs) sb_ledger_close(sim);
    sim->state.max_speed = sqrt(fmax(top, 0));
    sim->state.time += sim->policy->runs ? sim->state.time_step : 0;
    sim->state.step += sim->policy->runs;
    return SB_OK;
}

/* Holds the particles of the strips: they have the velocity and the pressure of the given water. In the pressure solve
   they are walls that move and whose pressure is known: the solve changes neither, and stays symmetric. */
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/sea/strip.h"
#include "sim/step/ledger.h"

#include <math.h>

/* Of the water inside of a strip, spacings whose density corrections the rows get at rest. */
static const double SAMPLED = 2;

static sb_given given_of(const sb_sim *sim, const sb_strip_side *s, sb_record at, double t)
{
    const double quantum = sim->space.quantum;
    sb_given given;
    sb_strip_given(sim, s, t, (double)sb_strip_inwards(s, at) * quantum, sb_strip_along(sim, s, at),
                   sim->space.origin.z + at[2] * quantum, &given);
    return given;
}

/* Row of a particle among those of its column at rest, as an index into the corrections; SIZE_MAX: it has none. */
static size_t still_row(const sb_sim *sim, const sb_strip_side *s, sb_record at)
{
    const size_t column = sb_strip_column(sim, s, sb_strip_along(sim, s, at));
    const sb_given given = given_of(sim, s, at, 0);
    const double z = sim->space.origin.z + at[2] * sim->space.quantum;
    const int rows = s->still_rows[column];
    return rows == 0 ? SIZE_MAX : column * s->rows + sb_strip_row(z, given.bed, given.surface, rows);
}

/* Sums in integer parts of the rest density, so that they do not depend on the order. */
static int learn_side(sb_sim *sim, sb_strip_side *s)
{
    const double parts = 0x1p30 / (double)sim->constant.rest_density;
    const int64_t end = s->width + (int64_t)(SAMPLED * sim->scene->resolution / sim->space.quantum);
    uint64_t *sum = sb_alloc(2 * s->columns * s->rows, sizeof *sum);
    if (sb_ranks_any(sim->ranks, !sum)) {
        sb_free(sum);
        return -1;
    }
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_record at = sim->state.position[i];
        const int64_t inwards = sb_strip_inwards(s, at);
        if (inwards < s->width || inwards >= end || sb_strip_side_of(sim->strip, at)) continue;
        const size_t row = still_row(sim, s, at);
        if (row == SIZE_MAX || isnan(sim->state.density_correction[i])) continue;
        sum[2 * row] += (uint64_t)(int64_t)nearbyint((double)sim->state.density_correction[i] * parts);
        sum[2 * row + 1]++;
    }
    sim->exchange->count(sim, sum, 2 * s->columns * s->rows);
    for (size_t k = 0; k < s->columns * s->rows; k++)
        if (sum[2 * k + 1] > 0)
            s->correction[k] = (float)((double)(int64_t)sum[2 * k] / parts / (double)sum[2 * k + 1]);
    sb_free(sum);
    return 0;
}

/* The density corrections of water at rest, and those of the particles that start in a strip. */
static sb_status learn(sb_sim *sim, sb_error *error)
{
    sb_strip *strip = sim->strip;
    for (size_t k = 0; k < strip->count; k++)
        if (learn_side(sim, &strip->side[k]) != 0) return sb_fail_memory(error, "density corrections of a strip");
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_strip_side *s = sb_strip_side_of(strip, sim->state.position[i]);
        if (!s) continue;
        const size_t row = still_row(sim, s, sim->state.position[i]);
        sim->state.density_correction[i] = row == SIZE_MAX ? NAN : s->correction[row];
    }
    strip->known = true;
    return SB_OK;
}

static sb_status list_held(sb_sim *sim, sb_error *error)
{
    sb_strip *strip = sim->strip;
    strip->held_count = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        if (!sb_strip_side_of(strip, sim->state.position[i])) continue;
        if (sb_grow((void **)&strip->held, &strip->held_capacity, strip->held_count + 1, sizeof *strip->held) != 0)
            return sb_fail_memory(error, "particles of a strip");
        strip->held[strip->held_count++] = (sb_held){.particle = (uint32_t)i};
    }
    return SB_OK;
}

/* The given water of held particles. Before the run it is at rest. Velocities belong to times half a step before the
   positions to which they lead. */
static void find_given(sb_sim *sim)
{
    sb_strip *strip = sim->strip;
    const bool runs = sim->policy->runs;
    const double t = runs ? sim->state.time + 0.5 * sim->state.time_step : 0;
    const size_t count = strip->held_count;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < count; k++) {
        sb_held *h = &strip->held[k];
        const sb_record at = sim->state.position[h->particle];
        const sb_given given = given_of(sim, sb_strip_side_of(strip, at), at, t);
        h->given = runs ? (sb_f4){(float)given.velocity[0], (float)given.velocity[1], (float)given.velocity[2], 0}
                        : (sb_f4){0};
        h->pressure = (float)given.pressure;
    }
}

sb_status sb_stage_held(sb_sim *sim, sb_error *error)
{
    sb_status status = sim->exchange->agree(sim, list_held(sim, error), error);
    if (status == SB_OK && sim->needs.density_correction && !sim->strip->known) status = learn(sim, error);
    if (status != SB_OK) return status;
    find_given(sim);
    for (size_t k = 0; k < sim->strip->held_count; k++)
        sim->work.density[sim->strip->held[k].particle] = sim->constant.rest_density;
    return SB_OK;
}

sb_status sb_stage_hold(sb_sim *sim, sb_error *error)
{
    (void)error;
    for (size_t k = 0; k < sim->strip->held_count; k++) {
        sb_held *h = &sim->strip->held[k];
        h->predicted = sim->work.predicted[h->particle];
        sim->work.predicted[h->particle] = h->given;
        sim->work.diagonal[h->particle] = 0;
    }
    return SB_OK;
}

void sb_strip_set_unknown(sb_sim *sim)
{
    const float rest = sim->constant.rest_density;
    for (size_t k = 0; k < sim->strip->held_count; k++)
        sim->work.unknown[sim->strip->held[k].particle] = sim->strip->held[k].pressure / (rest * rest);
}

void sb_strip_hold_acceleration(sb_sim *sim)
{
    for (size_t k = 0; k < sim->strip->held_count; k++) {
        sb_held *h = &sim->strip->held[k];
        h->push = sim->work.acceleration[h->particle];
        sim->work.acceleration[h->particle] = (sb_f4){0};
    }
}

/* Works per unit of mass, in the manner of sb_ledger_sums: what the solve and what holding have done. */
sb_status sb_stage_book(sb_sim *sim, sb_error *error)
{
    (void)error;
    sb_exact solve = {0}, hold = {0}, momentum[3] = {0};
    const sb_f4 dt = {(float)sim->state.time_step, (float)sim->state.time_step, (float)sim->state.time_step, 0};
    if (!sim->policy->runs) return SB_OK;
    for (size_t k = 0; k < sim->strip->held_count; k++) {
        const sb_held *h = &sim->strip->held[k];
        const sb_f4 start = sim->state.velocity[h->particle], end = sim->work.end_velocity[h->particle];
        sim->work.diagonal[h->particle] = 1; /* it moves with its velocity at the step's end, as in the solve */
        const sb_f4 pushed = h->predicted + h->push * dt;
        sb_exact_add(&solve, sb_ledger_work(h->predicted, pushed, start, end));
        sb_exact_add(&hold, sb_ledger_work(pushed, h->given, start, end));
        for (int axis = 0; axis < 3; axis++)
            sb_exact_add(&momentum[axis], (double)h->given[axis] - (double)pushed[axis]);
    }
    sim->exchange->sum(sim, &solve, 1);
    sim->exchange->sum(sim, &hold, 1);
    sim->exchange->sum(sim, momentum, 3);
    const double mass = (double)sim->constant.mass;
    sb_strip *strip = sim->strip;
    strip->solve_work = sb_exact_value(&solve);
    strip->hold_work = sb_exact_value(&hold);
    strip->push = sb_scale(
        sb_vec(sb_exact_value(&momentum[0]), sb_exact_value(&momentum[1]), sb_exact_value(&momentum[2])), mass);
    return SB_OK;
}

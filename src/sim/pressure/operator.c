/* The pressure operator: products and residuals, by the two passes of a pressure iteration. */
#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/sea/strip.h"
#include "sim/simulation.h"

/* Puts the values into the records of the owned particles. */
static void load_owned(sb_sim *sim, const float *argument)
{
    const size_t n = sim->state.n;
    sb_record *position = sim->state.position;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sb_carry(&position[i], argument[i]);
}

void sb_pressure_load(sb_sim *sim, const float *argument)
{
    load_owned(sim, argument);
    sb_refresh_carried(sim, argument);
}

void sb_pressure_load_begin(sb_sim *sim, const float *argument)
{
    load_owned(sim, argument);
    sb_refresh_carried_begin(sim, argument);
}

void sb_pressure_diverge(sb_sim *sim, float *out)
{
    const float dt = (float)sim->state.time_step;
    sim->passes->diverge(sim, sim->work.acceleration, dt * dt, out);
}

void sb_pressure_accelerate(sb_sim *sim)
{
    sim->passes->accelerate(sim);
    if (sim->strip) sb_strip_hold_acceleration(sim);
}

void sb_pressure_product(sb_sim *sim, float *out)
{
    sb_pressure_accelerate(sim);
    sb_refresh_begin(sim, sim->work.acceleration);
    sb_pressure_diverge(sim, out);
}

static void swap_acceleration(sb_sim *sim)
{
    sb_f4 *const other = sim->work.acceleration_ahead;
    sim->work.acceleration_ahead = sim->work.acceleration;
    sim->work.acceleration = other;
}

void sb_pressure_ahead(sb_sim *sim)
{
    load_owned(sim, sim->work.unknown_ahead);
    swap_acceleration(sim);
    sim->work.groups_ahead = 0;
    if (sim->exchange->sum_under_way(sim)) sim->passes->accelerate(sim);
}

void sb_pressure_keep_ahead(sb_sim *sim)
{
    float *const other = sim->work.unknown;
    sim->work.unknown = sim->work.unknown_ahead;
    sim->work.unknown_ahead = other;
}

void sb_pressure_drop_ahead(sb_sim *sim)
{
    load_owned(sim, sim->work.unknown);
    swap_acceleration(sim);
    sim->work.groups_ahead = 0;
}

void sb_pressure_residual(sb_sim *sim)
{
    const size_t n = sim->state.n;
    sb_pressure_load_begin(sim, sim->work.unknown);
    sb_pressure_product(sim, sim->work.residual);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sim->work.residual[i] -= sim->work.source[i];
}

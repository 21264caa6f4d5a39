#include "sim/step/ledger.h"

#include "sim/exchange/exchange.h"
#include "sim/sea/strip.h"

#include <math.h>

/* Sum of the forces (N) on all bodies, and their power (W) on the moving bodies. */
typedef struct body_sums {
    sb_vec3 force;
    double pressure, friction; /* pressure includes contact */
} body_sums;

static body_sums sum_bodies(const sb_sim *sim)
{
    body_sums all = {0};
    for (size_t body = 0; body < sim->model->body_count; body++) {
        const double *s = sim->work.body_force + body * SB_FORCE_VALUES;
        const sb_vec3 pressure = sb_vec(s[0], s[1], s[2]), friction = sb_vec(s[3], s[4], s[5]);
        all.force = sb_add(all.force, sb_add(pressure, friction));
        if (sim->walls.moving_of_body[body] == UINT32_MAX) continue;
        const sb_vec3 velocity = sim->walls.moving[sim->walls.moving_of_body[body]].velocity;
        all.pressure += sb_dot(pressure, velocity);
        all.friction += sb_dot(friction, velocity);
    }
    return all;
}

/* Moves the works on held particles from the sums of a step to where they belong. Returns the momentum that holding
   them has added. */
static sb_vec3 book_held(sb_sim *sim, sb_ledger_sums *s)
{
    if (!sim->strip) return (sb_vec3){0};
    const double m = (double)sim->constant.mass, solve = sim->strip->solve_work, hold = sim->strip->hold_work;
    sb_crossing *c = &sim->state.crossing;
    s->forces -= solve + hold;
    s->solve += solve;
    sim->state.ledger.sea += m * hold;
    c->held += m * hold;
    c->push = sb_add(c->push, sim->strip->push);
    return sim->strip->push;
}

void sb_ledger_close(sb_sim *sim)
{
    sb_ledger_sums s = sim->work.sums;
    const sb_vec3 held = book_held(sim, &s);
    s.forces -= sim->work.sponge_work + sim->work.tension_work;
    const body_sums bodies = sum_bodies(sim);
    const double m = (double)sim->constant.mass, g = (double)sim->constant.gravity;
    const double dt = (double)(float)sim->state.time_step; /* in the precision that advanced the velocities */
    const double friction = m * s.friction * dt;
    const bool forces = sim->needs.viscosity || sim->needs.hyperviscosity || sim->needs.images;
    sb_ledger *ledger = &sim->state.ledger;
    ledger->bodies -= dt * (bodies.pressure + bodies.friction);
    /* Without viscosity and the hydrostatic push of images this value is only the rounding of v*. */
    *(forces ? &ledger->viscosity : &ledger->integration) += m * (s.forces + g * dt * s.fall) - friction;
    ledger->friction += friction + dt * bodies.friction;
    ledger->pressure += m * (s.solve - s.contact + s.contact_bodies) + dt * bodies.pressure;
    ledger->contact += m * (s.contact - s.contact_bodies);
    ledger->sponge += m * sim->work.sponge_work;
    ledger->tension += m * sim->work.tension_work;
    ledger->integration += m * g * (s.rise * sim->space.quantum - dt * s.fall);
    const double weight = m * g * (double)sim->work.everywhere;
    const sb_vec3 gain = sb_scale(sb_vec(s.gain[0], s.gain[1], s.gain[2]), m);
    sb_vec3 off = sb_madd(sb_add(gain, sim->work.stress_gain), dt, sb_add(bodies.force, sb_vec(0, 0, weight)));
    off = sb_sub(sb_sub(off, held), sim->work.sponge_gain);
    /* The accelerations of water at rest are rounding: its weight is the measure then. */
    const double measure = fmax(m * s.size, dt * weight);
    sim->report.momentum_imbalance = measure > 0 ? sb_norm(off) / measure : 0;
}

/* Energy of particles [first, end), J, over all domains. */
static double energy_of(const sb_sim *sim, size_t first, size_t end)
{
    const double m = (double)sim->constant.mass, g = (double)sim->constant.gravity;
    const double base = sim->model->min.z - sim->space.origin.z;
    sb_exact sum = {0};
    for (size_t i = first; i < end; i++) {
        const sb_f4 v = sim->state.velocity[i];
        const double square = sb_ledger_work((sb_f4){0}, v, v, v);
        sb_exact_add(&sum, m * (0.5 * square + g * (sim->state.position[i][2] * sim->space.quantum - base)));
    }
    sim->exchange->sum(sim, &sum, 1);
    return sb_exact_value(&sum);
}

void sb_ledger_leave(sb_sim *sim, size_t first, size_t end)
{
    sim->state.ledger.left -= energy_of(sim, first, end);
}

void sb_ledger_cross(sb_sim *sim, size_t first, size_t end)
{
    sb_crossing *c = &sim->state.crossing;
    const double energy = energy_of(sim, first, end), m = (double)sim->constant.mass;
    sb_exact sum[3] = {0};
    for (size_t i = first; i < end; i++)
        for (int axis = 0; axis < 3; axis++) sb_exact_add(&sum[axis], (double)sim->state.velocity[i][axis]);
    sim->exchange->sum(sim, sum, 3);
    sim->state.ledger.sea -= energy;
    c->energy -= energy;
    c->momentum =
        sb_madd(c->momentum, -m, sb_vec(sb_exact_value(&sum[0]), sb_exact_value(&sum[1]), sb_exact_value(&sum[2])));
}

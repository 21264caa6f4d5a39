/* The energy of the water, and the hash of the state. */
#include "base/hash.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/sea/strip.h"
#include "sim/walls/absorber.h"
#include "sim/wcsph/boundary.h"

#include <stddef.h>

/* Adds one particle at a time, so that the sums do not depend on the groups, which a state just loaded does not have.
 */
sb_energy sb_sim_energy(const sb_sim *sim)
{
    enum { SQUARE, X, Y, Z, SUMS };
    sb_exact sum[SUMS] = {0};
    uint64_t height = 0; /* quanta */
#pragma omp parallel reduction(+ : height)
    {
        sb_exact own[SUMS] = {0};
#pragma omp for schedule(static) nowait
        for (size_t i = 0; i < sim->state.n; i++) {
            const sb_f4 v = sim->state.velocity[i];
            const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
            sb_exact_add(&own[SQUARE], x * x + y * y + z * z);
            sb_exact_add(&own[X], x);
            sb_exact_add(&own[Y], y);
            sb_exact_add(&own[Z], z);
            height += sim->state.position[i][2];
        }
        sb_sums_merge(sum, own, SUMS);
    }
    uint64_t counts[] = {height, sim->state.n};
    sim->exchange->sum(sim, sum, SUMS);
    sim->exchange->count(sim, counts, 2);
    const double mass = (double)sim->constant.mass, count = (double)counts[1];
    const double base = sim->model->min.z - sim->space.origin.z;
    const sb_vec3 velocity = sb_vec(sb_exact_value(&sum[X]), sb_exact_value(&sum[Y]), sb_exact_value(&sum[Z]));
    return (sb_energy){
        .kinetic = 0.5 * mass * sb_exact_value(&sum[SQUARE]),
        .potential = mass * (double)sim->constant.gravity * ((double)counts[0] * sim->space.quantum - count * base),
        .momentum = sb_scale(velocity, mass),
        .mass = mass * count,
    };
}

/* Hash of one particle's state. The sum of all does not depend on their order. */
static uint64_t particle_hash(const sb_sim *sim, size_t i)
{
    const uint32_t place[4] = {sim->state.position[i][0], sim->state.position[i][1], sim->state.position[i][2],
                               sim->state.id[i]};
    uint64_t hash = sb_hash(0, place, sizeof place);
    hash = sb_hash(hash, &sim->state.velocity[i], sizeof sim->state.velocity[i]);
    if (sim->state.excess) hash = sb_hash(hash, &sim->state.excess[i], sizeof *sim->state.excess);
    if (sim->state.density_correction)
        hash = sb_hash(hash, &sim->state.density_correction[i], sizeof *sim->state.density_correction);
    if (sim->state.steady_stress) {
        hash = sb_hash(hash, &sim->state.steady_stress[i], sizeof *sim->state.steady_stress);
        hash = sb_hash(hash, &sim->state.steady_stress_xx[i], sizeof *sim->state.steady_stress_xx);
        hash = sb_hash(hash, &sim->state.steady_unknown[i], sizeof *sim->state.steady_unknown);
    }
    return hash;
}

uint64_t sb_sim_hash(const sb_sim *sim)
{
    uint64_t particles = 0;
#pragma omp parallel for schedule(static) reduction(+ : particles)
    for (size_t i = 0; i < sim->state.n; i++) particles += particle_hash(sim, i);
    uint64_t counts[] = {sim->state.n, particles};
    sim->exchange->count(sim, counts, 2);
    uint64_t hash = sb_hash(sb_hash(0, &counts[0], sizeof *counts), &counts[1], sizeof *counts);
    hash = sb_hash(hash, sim->state.impulse, sim->model->body_count * sizeof *sim->state.impulse);
    hash = sb_hash(hash, &sim->state.ledger, offsetof(sb_ledger, sea)); /* the rest: by need */
    hash = sb_strip_hash(sim, hash);
    if (sim->needs.sponge) hash = sb_hash(hash, &sim->state.ledger.sponge, sizeof sim->state.ledger.sponge);
    if (sim->needs.surface_tension) hash = sb_hash(hash, &sim->state.ledger.tension, sizeof sim->state.ledger.tension);
    hash = sb_absorbers_hash(sim, hash);
    hash = sb_boundary_hash(sim, hash);
    hash = sb_hash(hash, &sim->state.time, sizeof sim->state.time);
    return sb_hash(hash, &sim->state.step, sizeof sim->state.step);
}

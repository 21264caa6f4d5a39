/* A particle as frames and samples show it. */
#ifndef SB_SIM_PARTICLE_H
#define SB_SIM_PARTICLE_H

#include "sim/simulation.h"

typedef struct sb_particle {
    sb_record position;
    sb_f4 velocity;          /* last lane: the solver pressure */
    float pressure, density; /* pressure: the virial pressure if known, else the solver pressure */
    uint32_t id;
} sb_particle;

static inline sb_particle sb_particle_at(const sb_sim *sim, size_t i)
{
    const float pressure = sim->work.virial_known ? sim->work.virial[i] : sim->state.velocity[i][3];
    return (sb_particle){sim->state.position[i], sim->state.velocity[i], pressure, sim->work.density[i],
                         sim->state.id[i]};
}

#endif

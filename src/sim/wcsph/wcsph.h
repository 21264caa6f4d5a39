/* Explicit steps of weakly compressible water [W], for comparison with the implicit ones: the density follows the
   continuity equation, and the pressure the density by Tait's equation (docs/method.md, section 14). A step has two
   halves. Both compute the accelerations and the rates of the density; the first one moves the water to the middle of
   the step with them, the second one to its end. Walls, viscosity, turbulence, contact, forces on bodies and the ledger
   are those of implicit steps. */
#ifndef SB_SIM_WCSPH_H
#define SB_SIM_WCSPH_H

#include "sim/simulation.h"

/* Longest step, s, for water with a maximum speed in m/s: cfl (h/2)/(c_0 + speed). */
double sb_wcsph_longest_step(const sb_numerics *numerics, const sb_constants *constants, double speed);

/* The excess (kg/m^3) of a density at the end of a step: rho (2 - e)/(2 + e) with e = -change/middle, from its values
   at the start and in the middle; change: its rate in the middle times dt. rest: kg/m^3. */
SB_INLINE float sb_wcsph_density_after(float rest, float begin, float middle, float change)
{
    const float e = -change / (rest + middle);
    return begin - (rest + begin) * (2 * e / (2 + e));
}

/* Sets the densities of the initial pressures. */
void sb_wcsph_begin(sb_sim *sim);

/* Stages; those that cannot fail return SB_OK. After the neighbours: replaces the density sums by the densities. */
sb_status sb_stage_wcsph_densities(sb_sim *sim, sb_error *error);
/* unknown, acceleration and rate. */
sb_status sb_stage_wcsph_rates(sb_sim *sim, sb_error *error);
/* First half: positions, velocities and densities in the middle of the step, where the walls are put, too. */
sb_status sb_stage_wcsph_predict(sb_sim *sim, sb_error *error);
/* Second half: densities at t + dt; predicted becomes the velocity at t plus what all but the pressure adds to it. */
sb_status sb_stage_wcsph_correct(sb_sim *sim, sb_error *error);
/* Before the move: the velocities at t, and the pressures and densities at t + dt. */
sb_status sb_stage_wcsph_finish(sb_sim *sim, sb_error *error);

/* sim/wcsph/gradients.c: the rate of the density by corrected gradients, into sim->work.rate, and the accelerations
   times the correction [W, CSPM]. */
void sb_wcsph_correct_gradients(sb_sim *sim);
/* sim/wcsph/diffusion.c: adds the diffusion of density [Molteni & Colagrossi 2009] without its hydrostatic part
   [Fourtakas et al. 2019] to sim->work.rate. Records carry the excess. */
void sb_wcsph_diffuse(sb_sim *sim);

/* Saves and loads the densities; nothing where steps are implicit. */
void sb_wcsph_save(const sb_sim *sim, sb_archive_out *out);
void sb_wcsph_load(sb_sim *sim, sb_archive_in *in);

#endif

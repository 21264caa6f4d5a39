/* The deviatoric stress correction, applied before each solve (docs/method.md, section 6; docs/decisions/0015). In a
   sheared particle packing the pressure acts more strongly along one direction than along another. In water it does
   not.

   Under the pressure q_i the neighbourhood of a particle has the stress sigma_i = -rho^2 q_i M_i with
   M_i = -(1/rho_0) sum_j m x_ij (x) grad W_ij (docs/method.md, M15d). Its deviatoric part, -rho^2 q_i (M_i - t_i 1)
   with t_i the mean of the diagonal of M_i, is due to the particle packing alone. The stage removes it by the pair
   force of the pressure gradient, with a tensor in the place of q (M15e):

       dv_i/dt = -sum_j m (S_i + S_j) grad W_ij,   S_i = q_i <E>_i,   E_i = c (1 - M_i / t_i)

   The remaining part is of second order: M (1 + E) = t (1 - e^2) with e = M/t - 1. S_i is taken without its steady part
   (sim/terms/steady_stress.h). <> is a mean over neighbours and
   their images, and then that of sb_cell_mean, taken twice: the strain of waves extends over many spacings, and the
   force of what differs between adjacent particles would stir water at rest (docs/decisions/0044). E has no trace, so
   that five numbers represent it. */
#ifndef SB_SIM_STRESS_CORRECTION_H
#define SB_SIM_STRESS_CORRECTION_H

#include "sim/simulation.h"

/* Least t_i of a particle that is corrected. Below it the free surface is near, and M_i shows the surface instead of
   the packing. The correction acts beside walls, too, where a step from nothing to the whole stirs water at rest over
   slopes: it begins at LEAST and is whole from WHOLE on. */
static const float SB_STRESS_LEAST = 0.85f, SB_STRESS_WHOLE = 0.95f;

/* The c of a particle with t_i. */
static inline float sb_stress_share(float whole, float t)
{
    const float part = (t - SB_STRESS_LEAST) / (SB_STRESS_WHOLE - SB_STRESS_LEAST);
    return part >= 1 ? whole : part > 0 ? whole * part : 0;
}

/* The same for films. Drops on walls have less. */
static const float SB_STRESS_FILM_LEAST = 0.3f, SB_STRESS_FILM_WHOLE = 0.45f;

/* Sums over neighbours of the slope times the offset, the offset's square, and 1. */
typedef struct sb_stress_sums {
    float x, y, z, trace, weight;
} sb_stress_sums;

/* q_i = p_i / rho_i^2 of the last step, Pa m^6/kg^2. */
static inline float sb_stress_unknown(const sb_sim *sim, size_t i)
{
    const float density = sim->work.density[i];
    return sim->state.velocity[i][3] / (density * density);
}

static inline float sb_stress_between_0_and_1(float value)
{
    return value >= 1 ? 1 : value > 0 ? value : 0;
}

/* The c of a particle of a film (docs/method.md, M15f). all: over all neighbours; images: over those that
   are images. Beside a wall at right angles to the surface no more of the gradient is due to images than of the
   neighbours: `below` is 0. */
static inline float sb_stress_film_share(int dimension, float whole, float t, sb_stress_sums all, sb_stress_sums images)
{
    const float square = all.x * all.x + all.y * all.y + all.z * all.z, straight = 1 - images.weight / all.weight;
    if (!(t > SB_STRESS_FILM_LEAST && square > 0 && straight > 0)) return 0;
    const float gradient = (images.x * all.x + images.y * all.y + images.z * all.z) / square;
    const float below = sb_stress_between_0_and_1(2 * (1 - (1 - gradient) / straight));
    const float part = sb_stress_between_0_and_1((float)(dimension - 1) * images.trace / all.trace);
    const float drop = (t - SB_STRESS_FILM_LEAST) / (SB_STRESS_FILM_WHOLE - SB_STRESS_FILM_LEAST);
    return whole * part * below * below * sb_stress_between_0_and_1(drop);
}

/* Adds the correction to the velocities of one step, from the pressures of the last step and the present neighbour
   lists. Momentum is conserved. The work is entered in the ledger. Fails, without changing velocities, if a particle
   would be too fast. */
sb_status sb_stage_stress_correction(sb_sim *sim, sb_error *error);

#endif

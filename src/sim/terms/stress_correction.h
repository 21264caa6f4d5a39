/* The deviatoric stress correction, applied before each solve (docs/method.md, section 6; docs/decisions/0015, 0094).
   In a sheared particle packing the pressure acts more strongly along one direction than along another. In water it
   does not.

   The pressure forces of the pairs of a particle are the stress sigma_i = -rho_0^2 T_i with
   T_i = -(1/rho_0) sum_j m (q_i + q_j)/2 x_ij (x) grad W_ij (docs/method.md, M15d). Its deviatoric part is due to the
   particle packing alone. The stage removes it by the pair force of the pressure gradient, with a tensor in the place
   of q (M15e):

       dv_i/dt = -sum_j m (S_i + S_j) grad W_ij,   S_i = <D>_i,   D_i = c (tau_i 1 - T_i)/t_i

   with tau_i the mean of the diagonal of T_i, and t_i that of T_i under q = 1. At a free surface T_i has no deviatoric
   part either: the pairs that are missing there have no pressure. S_i is taken without its steady part
   (sim/terms/steady_stress.h). <> is a mean over neighbours and their images, and then that of sb_cell_mean, taken
   twice: the strain of waves extends over many spacings, and the force of what differs between adjacent particles would
   stir water at rest (docs/decisions/0044). D has no trace, so that five numbers represent it. */
#ifndef SB_SIM_STRESS_CORRECTION_H
#define SB_SIM_STRESS_CORRECTION_H

#include "sim/simulation.h"

/* c falls to 0 from t_i = `whole` to `least`: below, a drop or a film of less than a layer has too few pairs for a
   stress. With surface tension the pairs that are missing at a surface have pressure, and T_i shows the surface instead
   of the packing. */
typedef struct sb_stress_range {
    float least, whole;
} sb_stress_range;

static const sb_stress_range SB_STRESS_THIN = {0.4f, 0.6f}, SB_STRESS_TENSION = {0.85f, 0.95f};

/* c_i/t_i. */
static inline float sb_stress_factor(const sb_sim *sim, float t)
{
    const float c = (float)sim->scene->numerics.stress_correction;
    const sb_stress_range range = sim->needs.surface_tension ? SB_STRESS_TENSION : SB_STRESS_THIN;
    if (!(t > range.least)) return 0;
    return t >= range.whole ? c / t : c / t * (t - range.least) / (range.whole - range.least);
}

/* q_i = p_i / rho_i^2 of the last step, Pa m^6/kg^2. */
static inline float sb_stress_unknown(const sb_sim *sim, size_t i)
{
    const float density = sim->work.density[i];
    return sim->state.velocity[i][3] / (density * density);
}

/* The mean <> of the tensors in deviator_xx, which records carry, and deviator; in stress_xx, which records carry then,
   and stress, with ghosts. Returns 0, or -1 without memory. */
int sb_stress_mean(sb_sim *sim);

/* Adds the correction to the velocities of one step, from the pressures of the last step and the present neighbour
   lists. Momentum is conserved. The work is entered in the ledger. Fails, without changing velocities, if a particle
   would be too fast. */
sb_status sb_stage_stress_correction(sb_sim *sim, sb_error *error);

#endif

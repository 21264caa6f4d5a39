/* The passes in their plainest form, for tests: one pair at a time, in double precision, over the same lists
   of fluid particles. */
#ifndef SB_SIM_REFERENCE_H
#define SB_SIM_REFERENCE_H

#include "sim/passes/passes.h"

sb_status sb_plain_neighbours(sb_sim *sim, sb_error *error);
void sb_plain_deviator(sb_sim *sim);
void sb_plain_mean_deviator(sb_sim *sim);
int sb_plain_correct(sb_sim *sim);
void sb_plain_strain(sb_sim *sim);
void sb_plain_strained(sb_sim *sim);
sb_status sb_plain_strain_rate(sb_sim *sim, sb_error *error);
sb_status sb_plain_forces(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error);
void sb_plain_differences(sb_sim *sim, const sb_f4 *field, float factor, sb_f4 *out);
int sb_plain_bodies(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total);

#endif

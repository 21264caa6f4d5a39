/* The passes for processors. */
#ifndef SB_SIM_CPU_H
#define SB_SIM_CPU_H

#include "sim/passes/passes.h"

sb_status sb_cpu_neighbours(sb_sim *sim, sb_error *error);
void sb_cpu_deviator(sb_sim *sim);
void sb_cpu_mean_deviator(sb_sim *sim);
int sb_cpu_correct(sb_sim *sim);
void sb_cpu_strain(sb_sim *sim);
void sb_cpu_strained(sb_sim *sim);
sb_status sb_cpu_strain_rate(sb_sim *sim, sb_error *error);
sb_status sb_cpu_forces(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error);
void sb_cpu_differences(sb_sim *sim, const sb_f4 *field, float factor, sb_f4 *out);
void sb_cpu_accelerate(sb_sim *sim);
void sb_cpu_diverge(sb_sim *sim, const sb_f4 *field, float factor, float *out);
void sb_cpu_virial(sb_sim *sim);
int sb_cpu_bodies(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total);

/* The rows that all forms for processors share: all but those of a pressure iteration. */
#define SB_CPU_PASSES                                                                                                  \
    .neighbours = sb_cpu_neighbours, .deviator = sb_cpu_deviator, .mean_deviator = sb_cpu_mean_deviator,               \
    .correct = sb_cpu_correct, .strain_rate = sb_cpu_strain_rate, .forces = sb_cpu_forces, .virial = sb_cpu_virial,    \
    .bodies = sb_cpu_bodies, .differences = sb_cpu_differences, .strain = sb_cpu_strain, .strained = sb_cpu_strained

/* Arguments of a group's divergence. */
typedef struct sb_divergence {
    const sb_f4 *field;
    float factor;
    float *out;
} sb_divergence;

/* Whether vectors of 64 bytes are faster on this processor. */
bool sb_cpu_wide_pays(void);

#endif

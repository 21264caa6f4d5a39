/* The passes over pairs, which take most of a step's time: the rows of one table, in several forms. A stage calls a
   pass by the table, sim->passes. A form for other hardware is another column; it may implement some passes and take
   the others from an existing form. */
#ifndef SB_SIM_PASSES_H
#define SB_SIM_PASSES_H

#include "sim/simulation.h"
#include "sim/walls/drag.h"

/* Factors of the viscosity in one step. */
typedef struct sb_viscous {
    bool on;          /* whether pairs have viscosity at all */
    float artificial; /* 2 alpha h c_s; over (rho_i + rho_j) it is the nu of [S16, eq. 14] */
    float physical;   /* 4 (d + 2) nu, over (rho_i + rho_j): acts on all pairs */
    float eddy;       /* 2 (d + 2), times nu_t,i + nu_t,j: the same for the eddy viscosity */
    float epsilon;    /* 0.01 h^2 in quanta^2 */
    float inverse_quantum;
} sb_viscous;

/* What the water does to bodies in one step. */
typedef struct sb_body_sums {
    double *force;   /* per body SB_FORCE_VALUES values: N, N m */
    double friction; /* works per unit of mass: those of sb_ledger_sums with these names */
    double contact, contact_bodies;
} sb_body_sums;

/* Each pass reads and writes the owned particles; a stage refreshes ghosts. Records carry (sb_pressure_load) the
   argument that a pass names. */
typedef struct sb_passes {
    const char *name;
    /* Computes lists, groups' runs, density, wall vector and diagonal, and for the density correction water_squared;
       with images also their pairs at edges, image_push and the flux of moving walls. */
    sb_status (*neighbours)(sb_sim *sim, sb_error *error);
    /* deviator_xx and deviator: D_i of sim/terms/stress_correction.h. Records carry q of the last step. */
    void (*deviator)(sb_sim *sim);
    /* deviator_xx and deviator: the deviatoric part of the symmetric velocity gradient, exact for linear fields; 0
       where water is thin. */
    void (*strain)(sb_sim *sim);
    /* strained: sum_j m (L_i + L_j)/2 x_ij . grad W_ij, L the tensor stress. Records carry stress_xx. */
    void (*strained)(sb_sim *sim);
    /* stress_xx and stress: the mean of D over neighbours and images. Records carry deviator_xx. */
    void (*mean_deviator)(sb_sim *sim);
    /* corrected: the velocity after the correction, and stress_force. Records carry stress_xx. Returns 0,
       or -1 without memory. */
    int (*correct)(sb_sim *sim);
    /* eddy: nu_t = min(C_s dr, kappa d)^2 |S|. */
    sb_status (*strain_rate)(sb_sim *sim, sb_error *error);
    /* predicted, wall_drag and wall_body: v* = v + dt (g + viscosity + drag + image_push). Records carry the
       density if viscous->on. */
    sb_status (*forces)(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error);
    /* out += factor sum_j m (f_i - f_j) |W'_ij|/r_ij over particles, without images. */
    void (*differences)(sb_sim *sim, const sb_f4 *field, float factor, sb_f4 *out);
    /* acceleration = G argument: a_i = -[sum_j m (q_i + q_j) grad W_ij + q_i B_i]. Records carry the argument. */
    void (*accelerate)(sb_sim *sim);
    /* out = factor [sum_j m (f_i - f_j) . grad W_ij + f_i . B_i]. */
    void (*diverge)(sb_sim *sim, const sb_f4 *field, float factor, float *out);
    /* virial: P_i of sim/terms/virial_pressure.c. */
    void (*virial)(sb_sim *sim);
    /* Resolves contact in end_velocity; sums the forces on bodies. Returns 0, or -1 without memory. */
    int (*bodies)(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total);
} sb_passes;

/* For any processor: vectors of 16 and 32 bytes. */
extern const sb_passes sb_passes_cpu;
/* The pressure passes with vectors of 64 bytes; NULL if this processor or this build has no such vectors. */
const sb_passes *sb_passes_cpu_wide(void);
/* Plain loops in double precision over the same lists of fluid particles, for tests. */
extern const sb_passes sb_passes_reference;

/* The form for this processor. All forms but the reference give the same bits. */
const sb_passes *sb_passes_choose(void);

#endif

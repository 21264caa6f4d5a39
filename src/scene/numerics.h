/* The numerical parameters of a scene. */
#ifndef SB_SCENE_NUMERICS_H
#define SB_SCENE_NUMERICS_H

#include "physics/kernels/kernel.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum sb_preset { SB_PRESET_DEFAULT, SB_PRESET_PAPER, SB_PRESET_WEN } sb_preset;
typedef enum sb_solver {
    SB_SOLVER_JACOBI,
    SB_SOLVER_CHEBYSHEV,
    SB_SOLVER_CG,
    SB_SOLVER_WCSPH /* no solve: explicit steps of weakly compressible water [W] */
} sb_solver;
typedef enum sb_time_step_rule {
    SB_TIME_STEP_PAPER, /* dt_max = factor h / g      [S16 eq. 12] */
    SB_TIME_STEP_DEPTH  /* dt_max = factor h / sqrt(g D) */
} sb_time_step_rule;
typedef enum sb_tolerance_rule {
    SB_TOLERANCE_DENSITY, /* tolerance is a relative density error */
    SB_TOLERANCE_PRESSURE /* tolerance * (dt sqrt(gD)/spacing)^2 is the relative density error */
} sb_tolerance_rule;

typedef enum sb_density_form {
    SB_DENSITY_SUMMED,   /* the density sum alone [S16 eq. 3] */
    SB_DENSITY_COMPLETED /* the density sum plus the density correction (sim/terms/density_correction.h) */
} sb_density_form;

typedef enum sb_wall_form {
    SB_WALLS_PARTICLES, /* boundary particles act on the pressure [A12] */
    SB_WALLS_IMAGES,    /* images of the water, reflected at the walls' facets (sim/walls/mirrors.h) */
    SB_WALLS_DYNAMIC    /* two layers of boundary particles with a density of their own [W], for wcsph */
} sb_wall_form;

typedef enum sb_wall_shear {
    SB_SHEAR_NONE,
    SB_SHEAR_SMOOTH /* law of the wall for smooth walls, with the fluid's viscosity */
} sb_wall_shear;

typedef enum sb_turbulence {
    SB_TURBULENCE_NONE,
    SB_TURBULENCE_SPS /* sub-particle-scale eddy viscosity [W eq. 9] */
} sb_turbulence;

/* Of the gradients of wcsph. */
typedef enum sb_kernel_correction {
    SB_CORRECTION_NONE,
    SB_CORRECTION_CSPM /* by the second moments of the neighbours [W], exact for linear fields */
} sb_kernel_correction;

/* Numerical parameters. The preset gives the defaults, which the scene may override. */
typedef struct sb_numerics {
    sb_preset preset;
    const sb_kernel *kernel;
    double support; /* support radius over spacing */
    sb_kernel_correction kernel_correction;
    sb_density_form density;
    sb_solver solver;
    sb_tolerance_rule tolerance_rule;
    double tolerance; /* mean of max(0, predicted excess density)/rest density */
    int min_iterations, max_iterations;
    double relaxation;        /* omega of Jacobi */
    double warm_start;        /* fraction of the last pressure from which a solve starts */
    double source_relaxation; /* beta: fraction of the density error that one step corrects */
    double cfl;               /* lambda_CFL */
    sb_time_step_rule time_step_rule;
    double time_step_factor;     /* lambda_max (1/s) or C, by the rule */
    double time_step_max;        /* s; 0: no other limit */
    double stress_correction;    /* fraction of the deviatoric particle-packing stress that is removed; 0: off */
    double stress_memory;        /* time after which stress counts as steady, in sqrt(D/g); 0: never */
    double density_diffusion;    /* delta of wcsph; 0: term is off */
    double hyperviscosity;       /* kappa; 0: term is off */
    double artificial_viscosity; /* alpha of Monaghan's viscosity; 0: term is off */
    double wall_friction;        /* sigma; 0: term is off */
    sb_wall_form walls;
    double wall_beta; /* share of the water's pressure in that of dynamic boundary particles */
    sb_wall_shear wall_shear;
    sb_turbulence turbulence;
    double smagorinsky;  /* C_s of the eddy viscosity */
    double sound_speed;  /* m/s, in artificial viscosity and wall friction; 0: 10 sqrt(g D) */
    double wall_spacing; /* spacings between boundary particles */
    double wall_offset;  /* spacings from the physical wall back to its boundary particles */
    double jitter;       /* spacings, amplitude of the random displacement at the start */
    uint64_t seed;       /* of that displacement */
    int settle_steps;    /* largest number of settling steps before t = 0; 0: none */
} sb_numerics;

#endif

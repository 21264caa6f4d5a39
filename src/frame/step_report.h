/* The report of one time step: src/sim fills it, the log and the progress show it. */
#ifndef SB_FRAME_STEP_REPORT_H
#define SB_FRAME_STEP_REPORT_H

#include "frame/foam.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_step_report {
    uint64_t step;          /* steps done so far */
    double time, time_step; /* s: present time, and the last time step; 0 at the start */
    int iterations;
    bool capped;                         /* the solve stopped at max_iterations above its tolerance */
    double tolerance;                    /* relative density error at which the solve stops */
    double error_mean, error_max;        /* relative density error of the solve: mean of max(0, e), and largest */
    double error_residual;               /* natural residual of the solve, relative: mean of |min(D q, -e)| */
    double compression, compression_max; /* relative density above the rest density at the start of the step: mean, and
                                            largest */
    double max_speed;                    /* m/s */
    size_t fluid_count;
    uint64_t left_domain;       /* particles that left through open sides so far */
    uint64_t lost;              /* particles that passed a wall side of the domain so far */
    size_t foam[SB_FOAM_KINDS]; /* particles of each kind */
    double momentum_imbalance;  /* of this step: |sum m a + sum F on bodies - M g| / max(sum m |a|, M g) */
} sb_step_report;

#endif

/* The pressure problem of a dam break, for comparison with the double-precision reference. */
#ifndef SB_TESTS_PRESSURE_PROBLEM_H
#define SB_TESTS_PRESSURE_PROBLEM_H

#include "sim/tank.h"
#include "sim/twin.h"

typedef struct problem {
    tank tank;
    sb_sim *sim;
    twin twin; /* with the velocities v* */
    size_t n;
    sb_vec3 *acceleration;
    double *x, *y, *product; /* n each */
    double *source;          /* the simulation's, in double */
    double *solution;        /* the reference's solution for it */
    double *diagonal;        /* the simulation's over dt^2, which a solve multiplies by dt^2 */
} problem;

/* Makes a dam break some steps after its start, up to the source of the next solve. One particle is in free flight. */
void problem_begin(problem *p, int dimensions, sb_preset preset);
void problem_end(problem *p);

#endif

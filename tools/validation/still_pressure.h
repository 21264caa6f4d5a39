/* Pressures of water at rest against rho g (level - z). The tank, the scene's first body, stands on
 * the floor. */
#ifndef SB_VALIDATION_STILL_PRESSURE_H
#define SB_VALIDATION_STILL_PRESSURE_H

#include "case.h"

/* m, of the sea above the tank's floor. */
double sb_still_depth(const sb_scene *scene);
/* Figures from the probes and from layers of particles, over the second half of the run. */
sb_status sb_still_figures(const sb_case_run *run, sb_figures *figures, sb_error *error);
/* Adds the layers' errors over height to the plot. */
sb_status sb_still_plot(const sb_case_run *run, sb_plot *plot, sb_error *error);

#endif

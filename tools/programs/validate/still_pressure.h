/* Compares pressures of water at rest with rho g (level - z). The scene's first body is the tank. */
#ifndef SB_VALIDATE_STILL_PRESSURE_H
#define SB_VALIDATE_STILL_PRESSURE_H

#include "case.h"

/* Depth (m) of the sea above the floor of the tank. */
double sb_still_depth(const sb_scene *scene);
/* Adds the figures of probes and of layers of particles, over the second half of the run. */
void sb_still_figures(const sb_case_run *run, sb_figures *figures);
/* Adds the errors of the layers over height to the plot. */
void sb_still_plot(const sb_case_run *run, sb_plot *plot);

#endif

/* Plots of a run's tables and maps, drawn by gnuplot if it is installed. */
#ifndef SB_OUTPUT_PLOTS_H
#define SB_OUTPUT_PLOTS_H

#include "output/log/runlog.h"

/* Draws plots/forces.png, gauges.png, probes.png, energy.png, overtopping.png, runup.png from the CSV
   files in `directory`, and maps/<name>.png beside the grids. Tables without rows get no plot.
   Returns the number of plots drawn. A missing gnuplot and failures are lines in the log, not errors. */
int sb_plots_write(const char *directory, const sb_scene *scene, sb_runlog *log);

#endif

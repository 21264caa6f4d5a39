/* Pictures of a run's tables and maps, drawn by gnuplot where it is there. */
#ifndef SB_OUTPUT_PLOTS_H
#define SB_OUTPUT_PLOTS_H

#include "output/runlog.h"

/* plots/forces.png, gauges.png, probes.png, energy.png, overtopping.png, runup.png from the CSV
   files in `directory`, and maps/<name>.png beside the grids; those without rows are left out.
   Returns how many were drawn. Absence of gnuplot and failures are lines in the log, not errors. */
int sb_plots_write(const char *directory, const sb_scene *scene, sb_runlog *log);

#endif

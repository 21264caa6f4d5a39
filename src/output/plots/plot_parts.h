/* Functions common to plots of tables and of maps. Private to src/output. */
#ifndef SB_OUTPUT_PLOT_PARTS_H
#define SB_OUTPUT_PLOT_PARTS_H

#include "base/file.h"
#include "output/log/runlog.h"
#include "scene/scene.h"

/* The picture that gnuplot writes, within the run's directory. */
#define SB_PLOT_PART "plots/part.png"

/* Writes the text as a single-quoted gnuplot string, in which only the quote is special. */
void sb_plot_quote(FILE *stream, const char *text);

/* Opens plots/<name>.<ending> of the directory for writing and stores its path. NULL: the reason is in *error. */
FILE *sb_plot_open(const char *directory, const char *name, const char *ending, char path[SB_PATH_MAX],
                   sb_error *error);

/* Runs gnuplot (`program`) on plots/<name>.gp within the directory. The script draws SB_PLOT_PART, which is then
   renamed to <folder>/<name>.png and replaces a link of that name. */
sb_status sb_plot_draw(const char *program, const char *directory, const char *folder, const char *name,
                       sb_error *error);

/* In plot_series.c and plot_maps.c. They return the number of plots drawn. Failed plots are warnings in the log. */
int sb_plot_series(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log);
int sb_plot_maps(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log);

#endif

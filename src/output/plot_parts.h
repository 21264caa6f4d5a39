/* What plots of tables and of maps share. Inside src/output. */
#ifndef SB_OUTPUT_PLOT_PARTS_H
#define SB_OUTPUT_PLOT_PARTS_H

#include "base/file.h"
#include "output/runlog.h"
#include "scene/scene.h"

/* What gnuplot draws into, within the run's directory. */
#define SB_PLOT_PART "plots/part.png"

/* Text as a single-quoted gnuplot string: nothing is special in it but the quote. */
void sb_plot_quote(FILE *stream, const char *text);

/* Opens plots/<name>.<ending> of the directory to write, its path in `path`; NULL with the reason in *error. */
FILE *sb_plot_open(const char *directory, const char *name, const char *ending, char path[SB_PATH_MAX],
                   sb_error *error);

/* Runs gnuplot (`program`) on plots/<name>.gp within the directory, which draws SB_PLOT_PART; whole, it becomes
   <folder>/<name>.png, and takes the place of a link. */
sb_status sb_plot_draw(const char *program, const char *directory, const char *folder, const char *name,
                       sb_error *error);

/* plot_series.c, plot_maps.c: how many were drawn; those that could not be are warnings in the log. */
int sb_plot_series(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log);
int sb_plot_maps(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log);

#endif

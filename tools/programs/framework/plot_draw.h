/* Creates and draws plots. */
#ifndef SB_FRAMEWORK_PLOT_DRAW_H
#define SB_FRAMEWORK_PLOT_DRAW_H

#include "base/status.h"
#include "plot.h"

/* Makes an empty plot; NULL: out of memory. */
sb_plot *sb_plot_create(void);
void sb_plot_destroy(sb_plot *plot);

/* Writes folder/<name>.dat and .gp, which stay there, and draws the picture (absolute path, PNG) by gnuplot. SB_FAILED:
   gnuplot is not installed or fails. */
sb_status sb_plot_draw(const sb_plot *plot, const char *folder, const char *name, const char *picture, sb_error *error);

/* Draws folder/<name>.png by files in out/plots; makes that folder. */
sb_status sb_plot_picture(const sb_plot *plot, const char *out, const char *name, const char *folder, sb_error *error);

#endif

/* The framework's side of plots. */
#ifndef SB_COMMON_PLOT_DRAW_H
#define SB_COMMON_PLOT_DRAW_H

#include "plot.h"

/* An empty plot; NULL without memory. */
sb_plot *sb_plot_create(void);
void sb_plot_destroy(sb_plot *plot);

/* Writes folder/<name>.dat and .gp, which stay there, and has gnuplot draw the picture (absolute
   path, PNG). SB_FAILED without gnuplot. */
sb_status sb_plot_draw(const sb_plot *plot, const char *folder, const char *name, const char *picture, sb_error *error);

#endif

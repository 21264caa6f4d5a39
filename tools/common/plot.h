/* One picture per case: a column of panels, each with curves, clouds of points and bands, drawn by
 * gnuplot. */
#ifndef SB_COMMON_PLOT_H
#define SB_COMMON_PLOT_H

#include "curve.h"

typedef struct sb_plot sb_plot;

/* line: a simulation; judged: the one that counts, thick and over all others; seed: thin and pale, the same from other
   starts; aside: dashed, and the axes do not make room for it; reference: a black line of what was measured or is
   theory; points: a cloud of measured points, each cloud with a mark of its own; marks: large ones, of a shape and
   colour of their own; chain: such marks, joined by a faint line. */
typedef enum sb_plot_style {
    SB_PLOT_LINE,
    SB_PLOT_JUDGED,
    SB_PLOT_SEED,
    SB_PLOT_ASIDE,
    SB_PLOT_REFERENCE,
    SB_PLOT_POINTS,
    SB_PLOT_MARKS,
    SB_PLOT_CHAIN
} sb_plot_style;

/* Begins a panel; what is added next goes there. */
sb_status sb_plot_panel(sb_plot *plot, const char *title, const char *x_label, const char *y_label, sb_error *error);
/* Bounds of the panel's axes; NaN: as the data have it. */
void sb_plot_range(sb_plot *plot, double x_min, double x_max, double y_min, double y_max);
/* Both axes logarithmic; points that are not above 0 are left out. */
void sb_plot_logarithmic(sb_plot *plot);
/* The points are copied. Layers of a style get colours in the order they come, anew in each panel. */
sb_status sb_plot_curve(sb_plot *plot, sb_plot_style style, const char *label, const sb_curve *curve, sb_error *error);
/* Grey between two curves over the same x: a percentile band, an uncertainty. */
sb_status sb_plot_band(sb_plot *plot, const char *label, const sb_curve *low, const sb_curve *high, sb_error *error);

#endif

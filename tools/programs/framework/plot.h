/* A picture with a column of panels, each with curves, clouds of points and bands, drawn by gnuplot. If memory is
   exhausted, drawing it fails. */
#ifndef SB_FRAMEWORK_PLOT_H
#define SB_FRAMEWORK_PLOT_H

#include "base/status.h"
#include "curve.h"

typedef struct sb_plot sb_plot;

/* line: a simulation. judged: the judged simulation, thick and on top. seed: the same with another start seed, thin and
   pale. aside: dashed, ignored by the ranges of the axes. reference: a black line, measured or theory. points: a cloud
   of measured points; each cloud has its own mark. marks: large marks with their own shape and colour. chain: such
   marks joined by a faint line. */
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

/* Begins a panel, to which the following calls add. */
void sb_plot_panel(sb_plot *plot, const char *title, const char *x_label, const char *y_label);
/* Bounds of the panel's axes; NaN: from the data. */
void sb_plot_range(sb_plot *plot, double x_min, double x_max, double y_min, double y_max);
/* Makes both axes logarithmic; points not above 0 are omitted. */
void sb_plot_logarithmic(sb_plot *plot);
/* Copies the points. Layers of a style get colours in order, starting again in each panel. */
void sb_plot_curve(sb_plot *plot, sb_plot_style style, const char *label, const sb_curve *curve);
/* Fills the area between two curves over the same x: a percentile band or an uncertainty. */
void sb_plot_band(sb_plot *plot, const char *label, const sb_curve *low, const sb_curve *high);

/* Draws the picture folder/<name>.png of the plot that `draw` fills in, by gnuplot with files in out/plots, which stay
   there. SB_FAILED: gnuplot is not installed or fails. */
typedef sb_status sb_draw(sb_plot *plot, const void *what, sb_error *error);
sb_status sb_plot_picture(sb_draw *draw, const void *what, const char *out, const char *name, const char *folder,
                          sb_error *error);

#endif

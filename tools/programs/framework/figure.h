/* Figures: the values that a case computes from a finished run, each with its reference and its target. */
#ifndef SB_FRAMEWORK_FIGURE_H
#define SB_FRAMEWORK_FIGURE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_FIGURE_TEXT = 96, SB_FIGURE_NOTE = 240 };

typedef struct sb_figure {
    char quantity[SB_FIGURE_TEXT]; /* unique within the case, stable: "floor force, mean" */
    char unit[16];                 /* of reference and value; "": none */
    double reference;              /* NaN: none; the middle of a band */
    double low, high;              /* the band's edges; low = high: none */
    double value;                  /* NaN: could not be measured; a judged figure then misses its target */
    double error;                  /* in `error_unit`; NaN: none */
    char error_unit[16];           /* "%", or the unit of an absolute error */
    double limit;                  /* target: |error| <= limit, in error_unit; NaN: reported, not judged */
    bool one_sided;                /* only error <= limit is required */
    bool pass;
    char note[SB_FIGURE_NOTE]; /* window, filter, lag, definition */
} sb_figure;

/* A zero-initialised list is empty. error: memory was exhausted, and figures are missing. */
typedef struct sb_figures {
    size_t count, capacity;
    sb_figure *rows;
    sb_error error;
} sb_figures;

void sb_figures_free(sb_figures *figures);
/* The figure of that quantity, or NULL. */
const sb_figure *sb_figures_find(const sb_figures *figures, const char *quantity);

/* Adds a copy of a judged figure. */
void sb_figures_add(sb_figures *figures, const sb_figure *figure);

/* Each function adds one figure. `note` is a printf format. With a limit of NaN the figure is reported, not judged. */

/* error = 100 (value - reference)/scale %, within +-limit %. scale: usually |reference| or a wave height. */
void sb_figure_share(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                     double scale, double limit, const char *note, ...) __attribute__((format(printf, 8, 9)));
/* error = value - reference in `unit`, within +-limit. */
void sb_figure_difference(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                          double limit, const char *note, ...) __attribute__((format(printf, 7, 8)));
/* The value itself is an error in `unit`; value <= limit is within the target. Pass a magnitude if both signs count.
   There is no reference. */
void sb_figure_below(sb_figures *figures, const char *quantity, const char *unit, double value, double limit,
                     const char *note, ...) __attribute__((format(printf, 6, 7)));
/* error = distance from the band low..high in % of the nearer edge, 0 inside the band. The reference is the middle. */
void sb_figure_band(sb_figures *figures, const char *quantity, const char *unit, double low, double high, double value,
                    double limit, const char *note, ...) __attribute__((format(printf, 8, 9)));
/* Reported, not judged; reference may be NaN. */
void sb_figure_report(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                      const char *note, ...) __attribute__((format(printf, 6, 7)));

#endif

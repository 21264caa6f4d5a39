/* Figures: what one finished run of a case gives, each beside its reference and its reach. */
#ifndef SB_VALIDATION_FIGURE_H
#define SB_VALIDATION_FIGURE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_FIGURE_TEXT = 96, SB_FIGURE_NOTE = 240 };

typedef struct sb_figure {
    char quantity[SB_FIGURE_TEXT]; /* unlike all others of the case, stable: "floor force, mean" */
    char unit[16];                 /* of reference and value; "" for none */
    double reference;              /* NaN: there is none; of a band its middle */
    double low, high;              /* the band's edges; low = high: none */
    double value;                  /* NaN: could not be measured, which fails a judged figure */
    double error;                  /* as `error_unit` says; NaN: none */
    char error_unit[16];           /* "%", or the unit of an absolute error */
    double limit;                  /* reach: |error| <= limit, in error_unit; NaN: reported, not judged */
    bool one_sided;                /* error <= limit is enough, however negative */
    bool pass;
    char note[SB_FIGURE_NOTE]; /* window, filter, lag, how it is counted */
} sb_figure;

/* Zero-initialised is empty. */
typedef struct sb_figures {
    size_t count, capacity;
    sb_figure *rows;
} sb_figures;

void sb_figures_free(sb_figures *figures);
/* The figure of that quantity, or NULL. */
const sb_figure *sb_figures_find(const sb_figures *figures, const char *quantity);

/* Adds a copy of a figure that is judged already. Without memory: SB_FAILED. */
sb_status sb_figures_add(sb_figures *figures, const sb_figure *figure, sb_error *error);

/* Each adds one figure. `note` is made as printf does ("" for none). Without memory: SB_FAILED. */

/* error = 100 (value - reference)/scale %, within +-limit %. scale: often |reference|, or a wave
 * height. */
sb_status sb_figure_share(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                          double scale, double limit, sb_error *error, const char *note, ...)
    __attribute__((format(printf, 9, 10)));
/* error = value - reference in `unit`, within +-limit. */
sb_status sb_figure_difference(sb_figures *figures, const char *quantity, const char *unit, double reference,
                               double value, double limit, sb_error *error, const char *note, ...)
    __attribute__((format(printf, 8, 9)));
/* The value is itself an error in `unit` ("%" for percents); value <= limit passes, so give a
   magnitude where both signs count. There is no reference. */
sb_status sb_figure_below(sb_figures *figures, const char *quantity, const char *unit, double value, double limit,
                          sb_error *error, const char *note, ...) __attribute__((format(printf, 7, 8)));
/* Within low..high, or outside by at most limit % of the nearer edge: error is that distance, 0
   within. The reference is the middle. */
sb_status sb_figure_band(sb_figures *figures, const char *quantity, const char *unit, double low, double high,
                         double value, double limit, sb_error *error, const char *note, ...)
    __attribute__((format(printf, 9, 10)));
/* Reported, not judged; reference may be NaN. */
sb_status sb_figure_report(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                           sb_error *error, const char *note, ...) __attribute__((format(printf, 7, 8)));

#endif

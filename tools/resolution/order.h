/* Order of convergence and the value at spacing 0, from runs at several spacings: Richardson's
   extrapolation with the grid convergence index of Roache (1994), the order for unequal ratios as in
   Celik et al. (2008), ASME J. Fluids Eng. 130, 078001. Pure functions. */
#ifndef SB_STUDY_ORDER_H
#define SB_STUDY_ORDER_H

#include <stddef.h>

/* No order above this is looked for: it stands for itself and all larger ones. */
#define SB_ORDER_LARGEST 10.0

/* A quantity at one spacing. */
typedef struct sb_level {
    double spacing; /* m, > 0 */
    double value;   /* mean over the start seeds; NaN: could not be measured */
    double error;   /* standard error of that mean; NaN: one seed only, so unknown */
} sb_level;

typedef enum sb_order_kind {
    SB_ORDER_OBSERVED,    /* the differences shrink with the spacing */
    SB_ORDER_ASSUMED,     /* two spacings: first order is assumed */
    SB_ORDER_NOISE,       /* a difference is none, or no larger than what start seeds do */
    SB_ORDER_OSCILLATING, /* the differences change sign */
    SB_ORDER_SLOW,        /* an order below 0.5 */
    SB_ORDER_DIVERGING,   /* the differences do not shrink */
    SB_ORDER_MISSING      /* fewer than two values */
} sb_order_kind;

typedef struct sb_convergence {
    sb_order_kind kind;
    double order;        /* NaN unless observed or assumed; at most SB_ORDER_LARGEST */
    double extrapolated; /* at spacing 0; NaN unless observed */
    double uncertainty;  /* half width of the error bar of the finest value, in its unit; NaN: none */
} sb_convergence;

/* From the levels, coarse to fine; the three finest that have a value count.
   Observed: uncertainty 1.25 |finest - extrapolated|; above order 2, 1.25 times the error that the coarser difference
   leads to expect at order 2, for a fine one that is smaller is chance.
   Assumed: 3 times the first-order estimate. Noise: the range of the values and twice the standard
   error of the finest. Slow: 3 times the range, or the distance at order 0.5 if that is more. Oscillating, diverging: 3
   times the range. Where the standard error is known, it is added (root of the sum of squares), but for noise; a level
   whose own is not known has the largest of the others. */
sb_convergence sb_converge(const sb_level *levels, size_t count);

/* Which levels these are, coarse to fine; returns how many. */
size_t sb_finest_levels(const sb_level *levels, size_t count, size_t chosen[3]);

/* What single seeds give: the order of every combination of one value per spacing of the three
   finest. `values[l]` has seeds[l] values, NaN: none. low and high: the smallest and largest observed order,
   NaN when there is none; share: of the combinations of values in which an order is observed; NaN: there are none. */
typedef struct sb_order_range {
    double low, high, share;
} sb_order_range;
sb_order_range sb_order_over_seeds(const double spacing[3], const double *const values[3], const size_t seeds[3]);

/* Mean of the values that are no NaN, and its standard error (NaN below two of them). */
void sb_mean_of(const double *values, size_t count, double *mean, double *error);

/* "first order assumed" and so on; "" when observed. */
const char *sb_order_remark(sb_order_kind kind);

#endif

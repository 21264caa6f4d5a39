/* Order of convergence and the value at spacing 0, from runs at several spacings: Richardson's
   extrapolation with the grid convergence index of Roache (1994), the order for unequal ratios as in
   Celik et al. (2008), ASME J. Fluids Eng. 130, 078001. Pure functions. */
#ifndef SB_STUDY_ORDER_H
#define SB_STUDY_ORDER_H

#include <stddef.h>

/* Largest order that is determined; it stands for all larger ones. */
#define SB_ORDER_LARGEST 10.0

/* A quantity at one spacing. */
typedef struct sb_level {
    double spacing; /* m, > 0 */
    double value;   /* mean over the start seeds; NaN: could not be measured */
    double error;   /* standard error of that mean; NaN: unknown, as with one seed */
} sb_level;

typedef enum sb_order_kind {
    SB_ORDER_OBSERVED,    /* the differences shrink with the spacing */
    SB_ORDER_ASSUMED,     /* two spacings: first order is assumed */
    SB_ORDER_NOISE,       /* a difference is 0, or within the scatter of start seeds */
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

/* Convergence of the levels, coarse to fine, from the three finest that have a value. The uncertainty is
   - observed: 1.25 |finest - extrapolated|; above order 2, 1.25 times the error expected from the coarse difference at
     order 2, because a smaller fine difference is by chance,
   - assumed: 3 times the first-order estimate,
   - noise: the range of the values plus twice the standard error of the finest,
   - slow: 3 times the range, or 3 times the distance at order 0.5 if that is larger,
   - oscillating, diverging: 3 times the range.
   Except for noise, a known standard error is added (root of the sum of squares). A level without a known standard
   error gets the largest one of the others. */
sb_convergence sb_converge(const sb_level *levels, size_t count);

/* Indices of these levels, coarse to fine; returns their number. */
size_t sb_finest_levels(const sb_level *levels, size_t count, size_t chosen[3]);

/* Orders of single seeds: of every combination of one value for each of the three finest spacings. `values[l]` has
   seeds[l] values; NaN: none. low and high: smallest and largest observed order; NaN: none. share: fraction of the
   combinations with an observed order; NaN: no combinations. */
typedef struct sb_order_range {
    double low, high, share;
} sb_order_range;
sb_order_range sb_order_over_seeds(const double spacing[3], const double *const values[3], const size_t seeds[3]);

/* Mean of the values that are not NaN, and its standard error (NaN for fewer than two values). */
void sb_mean_of(const double *values, size_t count, double *mean, double *error);

/* Remark such as "first order assumed"; "": observed. */
const char *sb_order_remark(sb_order_kind kind);

#endif

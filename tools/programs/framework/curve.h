/* A measured or simulated series y(x), and operations to compare two series. A function that makes a curve returns
   memory to be freed with sb_curve_free; SB_FAILED: out of memory. x rises strictly unless a comment says otherwise.
   NaN in y means that nothing was measured; sums omit it. */
#ifndef SB_COMMON_CURVE_H
#define SB_COMMON_CURVE_H

#include "base/status.h"

#include <stddef.h>

/* A zero-initialised curve is empty. */
typedef struct sb_curve {
    size_t count, x_capacity, y_capacity;
    double *x, *y;
} sb_curve;

void sb_curve_free(sb_curve *curve);
sb_status sb_curve_add(sb_curve *curve, double x, double y, sb_error *error);
sb_status sb_curve_copy(const sb_curve *from, sb_curve *to, sb_error *error);
/* Stable sort by x. Equal x are allowed (a digitised cloud of points). */
void sb_curve_sort(sb_curve *curve);
/* x <- scale_x x + shift_x; y <- scale_y y + shift_y. */
void sb_curve_map(sb_curve *curve, double scale_x, double shift_x, double scale_y, double shift_y);

/* Linear interpolation; NaN outside the curve or next to a NaN. */
double sb_curve_at(const sb_curve *curve, double x);
/* Values at first, first + step, ... <= last. */
sb_status sb_curve_resample(const sb_curve *curve, double first, double last, double step, sb_curve *made,
                            sb_error *error);

/* Centred running mean and median over the points within window/2 of each point's x. Clouds are allowed. */
sb_status sb_curve_mean_filter(const sb_curve *curve, double window, sb_curve *made, sb_error *error);
sb_status sb_curve_median_filter(const sb_curve *curve, double window, sb_curve *made, sb_error *error);

/* Over first <= x <= last. Mean, standard deviation and root mean square weight all points equally. The integral is the
   trapezoid rule with interpolated ends. NaN: no points. */
double sb_curve_mean(const sb_curve *curve, double first, double last);
double sb_curve_deviation(const sb_curve *curve, double first, double last);
double sb_curve_rms(const sb_curve *curve, double first, double last);
double sb_curve_integral(const sb_curve *curve, double first, double last);
/* Root mean square of a - b at the points of b within first..last where both are known; number of these points. */
double sb_curve_rms_difference(const sb_curve *a, const sb_curve *b, double first, double last);
size_t sb_curve_shared(const sb_curve *a, const sb_curve *b, double first, double last);

/* Index of the largest or smallest point within first..last; (size_t)-1: none. */
size_t sb_curve_highest(const sb_curve *curve, double first, double last);
size_t sb_curve_lowest(const sb_curve *curve, double first, double last);

/* The peak near the highest point within first..last: the vertex of a least-squares parabola through the points within
   half_width of it (at least three), or the highest point if the parabola does not open downwards. NaN: no point. */
typedef struct sb_peak {
    double x, y;
} sb_peak;
sb_peak sb_curve_peak(const sb_curve *curve, double first, double last, double half_width);

/* x at which the curve first rises to `level` (linear between points) at or after `first`; NaN: never. A time lag
   between two series is the difference of their onsets. */
double sb_curve_onset(const sb_curve *curve, double level, double first);

/* Least-squares line y = a + b x over the points within first..last; 0: fewer than two points. */
int sb_curve_line(const sb_curve *curve, double first, double last, double *a, double *b);

#endif

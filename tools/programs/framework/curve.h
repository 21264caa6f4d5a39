/* A measured or simulated series y(x), and operations to compare two series. x rises strictly unless a comment says
   otherwise. NaN in y means that nothing was measured; sums omit it. */
#ifndef SB_FRAMEWORK_CURVE_H
#define SB_FRAMEWORK_CURVE_H

#include <stdbool.h>
#include <stddef.h>

/* A zero-initialised curve is empty. */
typedef struct sb_curve {
    size_t count, x_capacity, y_capacity;
    double *x, *y;
    bool incomplete; /* memory was exhausted: points are missing */
} sb_curve;

/* Curves that are freed together. A zero-initialised list is empty. */
typedef struct sb_curves {
    sb_curve **list, spare; /* spare: for all when memory is exhausted */
    size_t count, capacity;
} sb_curves;

/* Makes an empty curve in the list. Never NULL. */
sb_curve *sb_curve_new(sb_curves *list);
/* Frees all curves. False: memory was exhausted for one of them. */
bool sb_curves_free(sb_curves *list);

void sb_curve_free(sb_curve *curve);
void sb_curve_add(sb_curve *curve, double x, double y);
/* First and last value; NaN: none. */
double sb_curve_first(const sb_curve *curve);
double sb_curve_last(const sb_curve *curve);
/* The coordinates of the point of that index, for example as from sb_curve_highest; NaN: no such point. */
double sb_curve_x(const sb_curve *curve, size_t i);
double sb_curve_y(const sb_curve *curve, size_t i);
/* Adds the values of `other` to those of the same index; takes all of them if the curve is empty. */
void sb_curve_sum(sb_curve *curve, const sb_curve *other);
/* Stable sort by x. Equal x are allowed (a digitised cloud of points). */
void sb_curve_sort(sb_curve *curve);
/* x <- scale_x x + shift_x; y <- scale_y y + shift_y. */
void sb_curve_map(sb_curve *curve, double scale_x, double shift_x, double scale_y, double shift_y);

/* Linear interpolation; NaN outside the curve or next to a NaN. */
double sb_curve_at(const sb_curve *curve, double x);
/* The following make a curve in the list `made`. Values at first, first + step, ... <= last. */
sb_curve *sb_curve_resample(sb_curves *made, const sb_curve *curve, double first, double last, double step);
/* Centred running mean and median over the points within window/2 of each point's x. Clouds are allowed. */
sb_curve *sb_curve_mean_filter(sb_curves *made, const sb_curve *curve, double window);
sb_curve *sb_curve_median_filter(sb_curves *made, const sb_curve *curve, double window);

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

#include "curve.h"

#include "statistics.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sb_curve_free(sb_curve *curve)
{
    sb_free(curve->x);
    sb_free(curve->y);
    *curve = (sb_curve){0};
}

sb_curve *sb_curve_new(sb_curves *list)
{
    sb_curve *made = sb_alloc(1, sizeof *made);
    if (made && sb_grow((void **)&list->list, &list->capacity, list->count + 1, sizeof *list->list) == 0)
        return list->list[list->count++] = made;
    sb_free(made);
    list->spare.incomplete = true;
    return &list->spare;
}

bool sb_curves_free(sb_curves *list)
{
    bool complete = !list->spare.incomplete;
    for (size_t i = 0; i < list->count; i++) {
        complete &= !list->list[i]->incomplete;
        sb_curve_free(list->list[i]);
        sb_free(list->list[i]);
    }
    sb_curve_free(&list->spare);
    sb_free(list->list);
    *list = (sb_curves){0};
    return complete;
}

void sb_curve_add(sb_curve *curve, double x, double y)
{
    size_t needed = curve->count + 1;
    if (sb_grow((void **)&curve->x, &curve->x_capacity, needed, sizeof(double)) != 0 ||
        sb_grow((void **)&curve->y, &curve->y_capacity, needed, sizeof(double)) != 0) {
        curve->incomplete = true;
        return;
    }
    curve->x[curve->count] = x;
    curve->y[curve->count] = y;
    curve->count = needed;
}

double sb_curve_x(const sb_curve *curve, size_t i)
{
    return i < curve->count ? curve->x[i] : (double)NAN;
}

double sb_curve_y(const sb_curve *curve, size_t i)
{
    return i < curve->count ? curve->y[i] : (double)NAN;
}

double sb_curve_first(const sb_curve *curve)
{
    return sb_curve_y(curve, 0);
}

double sb_curve_last(const sb_curve *curve)
{
    return sb_curve_y(curve, curve->count - 1);
}

void sb_curve_sum(sb_curve *curve, const sb_curve *other)
{
    const size_t count = curve->count;
    for (size_t i = 0; i < other->count; i++)
        if (!count)
            sb_curve_add(curve, other->x[i], other->y[i]);
        else if (i < count)
            curve->y[i] += other->y[i];
}

/* Insertion sort: stable, and fast for nearly sorted series. */
void sb_curve_sort(sb_curve *curve)
{
    for (size_t i = 1; i < curve->count; i++) {
        double x = curve->x[i], y = curve->y[i];
        size_t k = i;
        for (; k > 0 && curve->x[k - 1] > x; k--) {
            curve->x[k] = curve->x[k - 1];
            curve->y[k] = curve->y[k - 1];
        }
        curve->x[k] = x;
        curve->y[k] = y;
    }
}

void sb_curve_map(sb_curve *curve, double scale_x, double shift_x, double scale_y, double shift_y)
{
    for (size_t i = 0; i < curve->count; i++) {
        curve->x[i] = scale_x * curve->x[i] + shift_x;
        curve->y[i] = scale_y * curve->y[i] + shift_y;
    }
}

/* Index of the last point at or left of x. The curve has points, and x is not left of the first. */
static size_t left_of(const sb_curve *curve, double x)
{
    size_t low = 0, high = curve->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (curve->x[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double sb_curve_at(const sb_curve *curve, double x)
{
    if (curve->count == 0 || !(x >= curve->x[0] && x <= curve->x[curve->count - 1])) return (double)NAN;
    size_t i = left_of(curve, x);
    if (x <= curve->x[i] || i + 1 == curve->count) return curve->y[i];
    double share = (x - curve->x[i]) / (curve->x[i + 1] - curve->x[i]);
    return (1 - share) * curve->y[i] + share * curve->y[i + 1];
}

sb_curve *sb_curve_resample(sb_curves *made, const sb_curve *curve, double first, double last, double step)
{
    sb_curve *out = sb_curve_new(made);
    size_t steps = last >= first ? (size_t)floor((last - first) / step * (1 + 1e-12) + 1e-9) : 0;
    for (size_t i = 0; last >= first && i <= steps; i++) {
        double x = first + (double)i * step;
        sb_curve_add(out, x, sb_curve_at(curve, x));
    }
    return out;
}

static double mean_of(double *values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += values[i];
    return sum / (double)count;
}

/* Replaces each value by `reduce` of the values within window/2 that are not NaN. The curve is sorted. */
static sb_curve *filter(sb_curves *made, const sb_curve *curve, double window,
                        double (*reduce)(double *values, size_t count))
{
    sb_curve *out = sb_curve_new(made);
    double *near = sb_alloc(curve->count, sizeof *near), half = 0.5 * window * (1 + 1e-9);
    size_t low = 0, high = 0;
    out->incomplete = !near;
    for (size_t i = 0; near && i < curve->count; i++) {
        size_t count = 0;
        while (curve->x[low] < curve->x[i] - half) low++;
        while (high < curve->count && curve->x[high] <= curve->x[i] + half) high++;
        for (size_t k = low; k < high; k++)
            if (!isnan(curve->y[k])) near[count++] = curve->y[k];
        sb_curve_add(out, curve->x[i], count && !isnan(curve->y[i]) ? reduce(near, count) : (double)NAN);
    }
    sb_free(near);
    return out;
}

sb_curve *sb_curve_mean_filter(sb_curves *made, const sb_curve *curve, double window)
{
    return filter(made, curve, window, mean_of);
}

sb_curve *sb_curve_median_filter(sb_curves *made, const sb_curve *curve, double window)
{
    return filter(made, curve, window, sb_median);
}

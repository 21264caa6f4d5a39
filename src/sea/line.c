#include "sea/line.h"

#include "base/memory.h"

#include <math.h>

static const double FASTEST = 1e9; /* change per second that computations allow */

static sb_line_point *point_at(sb_line *series, double x, double y)
{
    /* Tables list all points at each time, or all times of each point: look at the next point first. */
    for (size_t i = 0; i < series->count; i++) {
        const size_t at = (series->last + 1 + i) % series->count;
        sb_line_point *point = &series->points[at];
        if (point->x != x || point->y != y) continue;
        series->last = at;
        return point;
    }
    if (sb_grow((void **)&series->points, &series->capacity, series->count + 1, sizeof *series->points) != 0)
        return NULL;
    series->last = series->count++;
    series->points[series->last] = (sb_line_point){.x = x, .y = y};
    return &series->points[series->last];
}

sb_status sb_line_add(sb_line *series, double x, double y, double time, const double *values, const char *place,
                      sb_error *error)
{
    sb_line_point *point = point_at(series, x, y);
    if (!point) return sb_fail_memory(error, place);
    if (point->count > 0 && !(time > point->times[point->count - 1]))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: time %g s does not follow %g s, expected increasing times", place,
                       time, point->times[point->count - 1]);
    for (size_t c = 0; c < series->channels && point->count > 0; c++) {
        const double *last = &point->values[(point->count - 1) * series->channels];
        const double rate = (values[c] - last[c]) / (time - point->times[point->count - 1]);
        if (!(fabs(rate) <= FASTEST))
            return sb_fail(error, SB_BAD_INPUT, "%.500s: a change of %g per second, expected less than %g", place, rate,
                           FASTEST);
    }
    const size_t rows = point->count + 1;
    if (sb_grow((void **)&point->times, &point->time_capacity, rows, sizeof(double)) != 0 ||
        sb_grow((void **)&point->values, &point->value_capacity, rows * series->channels, sizeof(double)) != 0)
        return sb_fail_memory(error, place);
    point->times[point->count] = time;
    for (size_t c = 0; c < series->channels; c++) point->values[point->count * series->channels + c] = values[c];
    point->count = rows;
    return SB_OK;
}

/* Slope between two chords: their harmonic mean, weighted by the intervals; 0 at a turning point. */
static double inner_slope(double before, double after, double left, double right)
{
    if (!(left * right > 0)) return 0;
    const double a = 2 * after + before, b = after + 2 * before;
    return (a + b) / (a / left + b / right);
}

/* Slope at an end, of the parabola through three knots, limited so that the cubic is monotone. */
static double end_slope(double near, double next, double chord, double other)
{
    const double slope = ((2 * near + next) * chord - near * other) / (near + next);
    if (!(slope * chord > 0)) return 0;
    return !(chord * other > 0) && fabs(slope) > 3 * fabs(chord) ? 3 * chord : slope;
}

static void find_slopes(const sb_line_point *point, size_t channels, size_t channel)
{
    const double *t = point->times, *v = point->values + channel;
    const size_t n = point->count, last = n - 1;
    for (size_t i = 0; i < n; i++) {
        const size_t left = i == 0 ? 0 : i - 1, right = i == last ? i - 1 : i;
        const double before = t[left + 1] - t[left], after = t[right + 1] - t[right];
        const double low = (v[(left + 1) * channels] - v[left * channels]) / before;
        const double high = (v[(right + 1) * channels] - v[right * channels]) / after;
        double slope = low;
        if (n > 2 && i == 0)
            slope = end_slope(before, t[2] - t[1], low, (v[2 * channels] - v[channels]) / (t[2] - t[1]));
        else if (n > 2 && i == last)
            slope = end_slope(after, t[last - 1] - t[last - 2], high,
                              (v[(last - 1) * channels] - v[(last - 2) * channels]) / (t[last - 1] - t[last - 2]));
        else if (n > 2)
            slope = inner_slope(before, after, low, high);
        point->slopes[i * channels + channel] = slope;
    }
}

sb_status sb_line_finish(sb_line *series, sb_error *error)
{
    for (size_t p = 0; p < series->count; p++) {
        sb_line_point *point = &series->points[p];
        point->slopes = sb_alloc(point->count * series->channels, sizeof(double));
        if (!point->slopes) return sb_fail_memory(error, "the slopes of a table");
        for (size_t c = 0; c < series->channels; c++) find_slopes(point, series->channels, c);
    }
    return SB_OK;
}

/* The last row at or before t, at most the last but one. */
static size_t row_before(const sb_line_point *point, double t)
{
    size_t low = 0, high = point->count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (point->times[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Adds weight times the point's values and rates at time t. */
static void add_point(const sb_line_point *point, size_t channels, double t, double weight, double *values,
                      double *rates)
{
    const size_t row = row_before(point, t);
    const double start = point->times[row], span = point->times[row + 1] - start;
    const double s = fmin(fmax((t - start) / span, 0), 1), r = 1 - s;
    const double moving = t >= point->times[0] && t <= point->times[point->count - 1] ? weight / span : 0;
    for (size_t c = 0; c < channels; c++) {
        const size_t at = row * channels + c;
        const double a = point->values[at], b = point->values[at + channels];
        const double ma = span * point->slopes[at], mb = span * point->slopes[at + channels];
        values[c] += weight * (r * r * (a * (1 + 2 * s) + ma * s) + s * s * (b * (1 + 2 * r) - mb * r));
        rates[c] += moving * (6 * s * r * (b - a) + r * (1 - 3 * s) * ma + s * (3 * s - 2) * mb);
    }
}

/* Finds the segment of the line that is nearest to (x, y), and the fraction on it. */
static size_t nearest_segment(const sb_line *series, double x, double y, double *fraction)
{
    size_t best = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i + 1 < series->count; i++) {
        const sb_line_point *a = &series->points[i], *b = a + 1;
        const double dx = b->x - a->x, dy = b->y - a->y, square = dx * dx + dy * dy;
        const double part = fmin(fmax(((x - a->x) * dx + (y - a->y) * dy) / square, 0), 1);
        const double away = hypot(a->x + part * dx - x, a->y + part * dy - y);
        if (!(away < least)) continue;
        least = away;
        best = i;
        *fraction = part;
    }
    return best;
}

void sb_line_at(const sb_line *series, double t, double x, double y, double *values, double *rates)
{
    double fraction = 0;
    for (size_t c = 0; c < series->channels; c++) values[c] = rates[c] = 0;
    const size_t segment = nearest_segment(series, x, y, &fraction);
    add_point(&series->points[segment], series->channels, t, 1 - fraction, values, rates);
    if (fraction > 0) add_point(&series->points[segment + 1], series->channels, t, fraction, values, rates);
}

void sb_line_free(sb_line *series)
{
    for (size_t p = 0; p < series->count; p++) {
        sb_free(series->points[p].times);
        sb_free(series->points[p].values);
        sb_free(series->points[p].slopes);
    }
    sb_free(series->points);
    *series = (sb_line){0};
}

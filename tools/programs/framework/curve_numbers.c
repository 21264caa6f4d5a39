/* Numbers computed from a curve: sums, extremes, peaks, onsets, fitted lines. */
#include "curve.h"

#include <math.h>
#include <stdbool.h>

static bool within(const sb_curve *curve, size_t i, double first, double last)
{
    return curve->x[i] >= first && curve->x[i] <= last && !isnan(curve->y[i]);
}

/* Mean of (y - shift)^power for power 1 or 2. */
static double moment(const sb_curve *curve, double first, double last, double shift, int power)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < curve->count; i++) {
        if (!within(curve, i, first, last)) continue;
        double y = curve->y[i] - shift;
        sum += power == 1 ? y : y * y;
        count++;
    }
    return count ? sum / (double)count : (double)NAN;
}

double sb_curve_mean(const sb_curve *curve, double first, double last)
{
    return moment(curve, first, last, 0, 1);
}

double sb_curve_deviation(const sb_curve *curve, double first, double last)
{
    return sqrt(moment(curve, first, last, sb_curve_mean(curve, first, last), 2));
}

double sb_curve_rms(const sb_curve *curve, double first, double last)
{
    return sqrt(moment(curve, first, last, 0, 2));
}

double sb_curve_integral(const sb_curve *curve, double first, double last)
{
    double sum = 0, x0 = first, y0 = sb_curve_at(curve, first);
    double end = sb_curve_at(curve, last);
    if (isnan(y0) || isnan(end)) return (double)NAN;
    for (size_t i = 0; i < curve->count; i++) {
        if (!within(curve, i, first, last) || curve->x[i] <= x0) continue;
        sum += 0.5 * (y0 + curve->y[i]) * (curve->x[i] - x0);
        x0 = curve->x[i];
        y0 = curve->y[i];
    }
    return sum + 0.5 * (y0 + end) * (last - x0);
}

double sb_curve_rms_difference(const sb_curve *a, const sb_curve *b, double first, double last)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < b->count; i++) {
        if (!within(b, i, first, last)) continue;
        double difference = sb_curve_at(a, b->x[i]) - b->y[i];
        if (isnan(difference)) continue;
        sum += difference * difference;
        count++;
    }
    return count ? sqrt(sum / (double)count) : (double)NAN;
}

size_t sb_curve_shared(const sb_curve *a, const sb_curve *b, double first, double last)
{
    size_t count = 0;
    for (size_t i = 0; i < b->count; i++) count += within(b, i, first, last) && !isnan(sb_curve_at(a, b->x[i]));
    return count;
}

static size_t extreme(const sb_curve *curve, double first, double last, double sign)
{
    size_t best = (size_t)-1;
    for (size_t i = 0; i < curve->count; i++)
        if (within(curve, i, first, last) && (best == (size_t)-1 || sign * curve->y[i] > sign * curve->y[best]))
            best = i;
    return best;
}

size_t sb_curve_highest(const sb_curve *curve, double first, double last)
{
    return extreme(curve, first, last, 1);
}

size_t sb_curve_lowest(const sb_curve *curve, double first, double last)
{
    return extreme(curve, first, last, -1);
}

/* Solves the normal equations of y = c0 + c1 u + c2 u^2, given s[k] = sum u^k and t[k] = sum y u^k. */
static bool parabola(const double s[5], const double t[3], double c[3])
{
    double a = s[0], b = s[1], d = s[2], e = s[3], f = s[4];
    double determinant = a * (d * f - e * e) - b * (b * f - e * d) + d * (b * e - d * d);
    if (!(fabs(determinant) > 1e-12 * fabs(a * d * f))) return false;
    c[0] = (t[0] * (d * f - e * e) - b * (t[1] * f - e * t[2]) + d * (t[1] * e - d * t[2])) / determinant;
    c[1] = (a * (t[1] * f - e * t[2]) - t[0] * (b * f - e * d) + d * (b * t[2] - t[1] * d)) / determinant;
    c[2] = (a * (d * t[2] - t[1] * e) - b * (b * t[2] - t[1] * d) + t[0] * (b * e - d * d)) / determinant;
    return true;
}

sb_peak sb_curve_peak(const sb_curve *curve, double first, double last, double half_width)
{
    size_t top = sb_curve_highest(curve, first, last);
    if (top == (size_t)-1) return (sb_peak){(double)NAN, (double)NAN};
    sb_peak peak = {curve->x[top], curve->y[top]};
    double s[5] = {0}, t[3] = {0}, c[3];
    size_t count = 0;
    for (size_t i = 0; i < curve->count; i++) {
        double u = (curve->x[i] - peak.x) / half_width, power = 1;
        if (fabs(u) > 1 + 1e-9 || isnan(curve->y[i])) continue;
        for (int k = 0; k < 5; k++, power *= u) {
            s[k] += power;
            if (k < 3) t[k] += power * curve->y[i];
        }
        count++;
    }
    if (count < 3 || !parabola(s, t, c) || !(c[2] < 0)) return peak;
    double u = -c[1] / (2 * c[2]);
    if (fabs(u) > 1) return peak;
    return (sb_peak){peak.x + u * half_width, c[0] + 0.5 * c[1] * u};
}

double sb_curve_onset(const sb_curve *curve, double level, double first)
{
    for (size_t i = 0; i < curve->count; i++) {
        if (curve->x[i] < first || !(curve->y[i] >= level)) continue;
        if (i == 0 || isnan(curve->y[i - 1]) || curve->y[i - 1] >= level) return curve->x[i];
        double share = (level - curve->y[i - 1]) / (curve->y[i] - curve->y[i - 1]);
        double x = curve->x[i - 1] + share * (curve->x[i] - curve->x[i - 1]);
        return x > first ? x : first;
    }
    return (double)NAN;
}

int sb_curve_line(const sb_curve *curve, double first, double last, double *a, double *b)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < curve->count; i++) {
        if (!within(curve, i, first, last)) continue;
        double u = curve->x[i] - first;
        n += 1;
        x += u;
        y += curve->y[i];
        xx += u * u;
        xy += u * curve->y[i];
    }
    double spread = n * xx - x * x;
    if (n < 2 || !(spread > 0)) return 0;
    *b = (n * xy - x * y) / spread;
    *a = (y - *b * x) / n - *b * first;
    return 1;
}

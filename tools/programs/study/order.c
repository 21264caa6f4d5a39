#include "order.h"

#include <math.h>

static const double CREDIBLE = 2; /* order of the discretisation; a larger one is by chance */
static const double SLOWEST =
    0.5; /* below it there is no reliable value at spacing 0 [Oberkampf and Roy 2010, 8.8.3] */
static const double SAFETY = 1.25; /* three spacings; 3 with two (Roache 1994) */

/* Ratio of the coarse to the fine difference at order p. */
static double ratio_at(double p, double fine, double coarse)
{
    double share = p > 0 ? (pow(coarse, p) - 1) / (pow(fine, p) - 1) : log(coarse) / log(fine);
    return pow(fine, p) * share;
}

/* The order at which the differences have this ratio; ratio_at rises with p. NaN: no order above 0. */
static double order_of(double ratio, double fine, double coarse)
{
    double low = 0, high = SB_ORDER_LARGEST;
    if (!(ratio > ratio_at(0, fine, coarse))) return (double)NAN;
    if (ratio > ratio_at(high, fine, coarse)) return high;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (ratio_at(middle, fine, coarse) < ratio)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

size_t sb_finest_levels(const sb_level *levels, size_t count, size_t chosen[3])
{
    size_t found = 0;
    for (size_t i = count; i-- > 0 && found < 3;)
        if (!isnan(levels[i].value)) chosen[2 - found++] = i;
    for (size_t i = 0; found < 3 && i < found; i++) chosen[i] = chosen[i + 3 - found];
    return found;
}

/* A level with too few seeds for a standard error gets the largest one of the others. */
static size_t finest(const sb_level *levels, size_t count, sb_level chosen[3])
{
    size_t index[3], found = sb_finest_levels(levels, count, index);
    double largest = (double)NAN;
    for (size_t i = 0; i < found; i++) largest = fmax(largest, levels[index[i]].error);
    for (size_t i = 0; i < found; i++) {
        chosen[i] = levels[index[i]];
        if (isnan(chosen[i].error)) chosen[i].error = largest;
    }
    return found;
}

static double known(double error)
{
    return isnan(error) ? 0 : error;
}

static int is_noise(const sb_level *a, const sb_level *b)
{
    return fabs(a->value - b->value) <= 2 * hypot(known(a->error), known(b->error));
}

static double range_of(const sb_level *l)
{
    return fmax(fmax(l[0].value, l[1].value), l[2].value) - fmin(fmin(l[0].value, l[1].value), l[2].value);
}

static sb_convergence of_two(const sb_level *l)
{
    double step = fabs(l[0].value - l[1].value) / (l[0].spacing / l[1].spacing - 1);
    return (sb_convergence){SB_ORDER_ASSUMED, 1, (double)NAN, hypot(3 * step, known(l[1].error))};
}

sb_convergence sb_converge(const sb_level *levels, size_t count)
{
    sb_level l[3];
    sb_convergence c = {SB_ORDER_MISSING, (double)NAN, (double)NAN, (double)NAN};
    size_t found = finest(levels, count, l);
    if (found < 2) return c;
    if (found == 2) return of_two(l);
    double coarse = l[0].value - l[1].value, fine = l[1].value - l[2].value;
    double noise = known(l[2].error);
    if (is_noise(&l[0], &l[1]) || is_noise(&l[1], &l[2])) {
        c.kind = SB_ORDER_NOISE;
        c.uncertainty = range_of(l) + 2 * noise;
        return c;
    }
    const double fine_ratio = l[1].spacing / l[2].spacing, coarse_ratio = l[0].spacing / l[1].spacing;
    c.order = order_of(coarse / fine, fine_ratio, coarse_ratio);
    if (isnan(c.order)) {
        c.kind = coarse / fine < 0 ? SB_ORDER_OSCILLATING : SB_ORDER_DIVERGING;
        c.uncertainty = hypot(3 * range_of(l), noise);
        return c;
    }
    if (c.order < SLOWEST) {
        c.kind = SB_ORDER_SLOW;
        c.uncertainty = hypot(3 * fmax(range_of(l), fabs(fine) / (pow(fine_ratio, SLOWEST) - 1)), noise);
        return c;
    }
    c.kind = SB_ORDER_OBSERVED;
    const double credible = fmin(c.order, CREDIBLE);
    c.extrapolated = l[2].value - fine / (pow(fine_ratio, credible) - 1);
    /* A fine difference may be small by chance; the error bar uses the one expected from the coarse difference. */
    const double expected = coarse / ratio_at(credible, fine_ratio, coarse_ratio);
    c.uncertainty = hypot(SAFETY * expected / (pow(fine_ratio, credible) - 1), noise);
    return c;
}

sb_order_range sb_order_over_seeds(const double spacing[3], const double *const values[3], const size_t seeds[3])
{
    sb_order_range r = {(double)NAN, (double)NAN, 0};
    double fine = spacing[1] / spacing[2], coarse = spacing[0] / spacing[1];
    size_t tried = 0, observed = 0;
    for (size_t i = 0; i < seeds[0]; i++)
        for (size_t j = 0; j < seeds[1]; j++)
            for (size_t k = 0; k < seeds[2]; k++) {
                double a = values[0][i], b = values[1][j], c = values[2][k];
                if (isnan(a + b + c)) continue;
                tried++;
                double order = order_of((a - b) / (b - c), fine, coarse);
                if (isnan(order)) continue;
                r.low = fmin(r.low, order); /* fmin and fmax ignore NaN */
                r.high = fmax(r.high, order);
                observed++;
            }
    r.share = tried ? (double)observed / (double)tried : (double)NAN;
    return r;
}

void sb_mean_of(const double *values, size_t count, double *mean, double *error)
{
    double sum = 0, squares = 0, n = 0;
    for (size_t i = 0; i < count; i++)
        if (!isnan(values[i])) sum += values[i], n++;
    *mean = sum / n;
    for (size_t i = 0; i < count; i++)
        if (!isnan(values[i])) squares += (values[i] - *mean) * (values[i] - *mean);
    *error = n > 1 ? sqrt(squares / (n - 1) / n) : (double)NAN;
}

const char *sb_order_remark(sb_order_kind kind)
{
    static const char *const remarks[] = {
        [SB_ORDER_OBSERVED] = "",
        [SB_ORDER_ASSUMED] = "two spacings: first order assumed",
        [SB_ORDER_NOISE] = "order not observable: a difference is 0 or within the scatter of the seeds",
        [SB_ORDER_OSCILLATING] = "order not observable: the differences change sign",
        [SB_ORDER_SLOW] = "order below 0.5: no reliable value at spacing 0",
        [SB_ORDER_DIVERGING] = "order not observable: the differences do not shrink",
        [SB_ORDER_MISSING] = "not measured at two spacings",
    };
    return remarks[kind];
}

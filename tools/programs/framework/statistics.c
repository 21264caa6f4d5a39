#include "statistics.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

double sb_median(double *values, size_t count)
{
    if (!count) return (double)NAN;
    qsort(values, count, sizeof *values, ascending);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

const sb_spread sb_spread_none = {0, (double)NAN, (double)NAN, (double)NAN};

void sb_spread_add(sb_spread *spread, double value)
{
    if (isnan(value)) return;
    const double known = (double)spread->count++;
    spread->mean = known > 0 ? (spread->mean * known + value) / (known + 1) : value;
    spread->low = fmin(spread->low, value); /* ignores NaN */
    spread->high = fmax(spread->high, value);
}

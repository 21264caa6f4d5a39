/* Medians, and the range and mean of values. */
#ifndef SB_FRAMEWORK_STATISTICS_H
#define SB_FRAMEWORK_STATISTICS_H

#include <stddef.h>

/* Sorts the values, none of which is NaN. With an even number of them: the mean of the two in the middle. NaN: none. */
double sb_median(double *values, size_t count);

/* Values so far; begin with sb_spread_none, whose mean and bounds are NaN. */
typedef struct sb_spread {
    size_t count;
    double mean, low, high;
} sb_spread;
extern const sb_spread sb_spread_none;
/* Adds a value; NaN is ignored. */
void sb_spread_add(sb_spread *spread, double value);

#endif

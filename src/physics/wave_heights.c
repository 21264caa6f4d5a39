#include "physics/wave_heights.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static int compare_falling(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a < b) - (a > b);
}

/* Fills the heights of the waves between upward crossings, and sets the times of the first and last crossing. */
static size_t find_waves(const double *t, const double *z, size_t n, double level, double *heights, double ends[2])
{
    size_t crossings = 0;
    double low = 0, high = 0;
    for (size_t i = 1; i < n; i++) {
        const double before = z[i - 1] - level, after = z[i] - level;
        if (before < 0 && after >= 0) {
            ends[1] = t[i - 1] + (t[i] - t[i - 1]) * before / (before - after);
            if (crossings == 0) ends[0] = ends[1];
            if (crossings > 0) heights[crossings - 1] = high - low;
            crossings++;
            low = high = after;
        }
        low = fmin(low, after);
        high = fmax(high, after);
    }
    return crossings > 0 ? crossings - 1 : 0;
}

sb_status sb_wave_heights_of(const double *t, const double *z, size_t n, sb_wave_heights *heights, sb_error *error)
{
    const double none = (double)NAN;
    sb_wave_heights made = {0, none, none, none, none, none, none};
    double ends[2], square = 0, *all = sb_alloc(n, sizeof *all);
    if (n > 0 && !all) return sb_fail_memory(error, "heights of waves");
    if (n > 0) made.level = 0;
    for (size_t i = 0; i < n; i++) made.level += z[i] / (double)n;
    for (size_t i = 0; i < n; i++) square += (z[i] - made.level) * (z[i] - made.level);
    if (n > 0) made.spectral = 4 * sqrt(square / (double)n);
    made.count = find_waves(t, z, n, made.level, all, ends);
    if (made.count > 0) {
        const size_t third = (made.count + 2) / 3;
        qsort(all, made.count, sizeof *all, compare_falling);
        made.mean = made.significant = 0;
        for (size_t k = 0; k < made.count; k++) made.mean += all[k] / (double)made.count;
        for (size_t k = 0; k < third; k++) made.significant += all[k] / (double)third;
        made.highest = all[0];
        made.period = (ends[1] - ends[0]) / (double)made.count;
    }
    sb_free(all);
    *heights = made;
    return SB_OK;
}

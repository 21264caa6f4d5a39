#include "physics/records/wave_heights.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static int compare_falling(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a < b) - (a > b);
}

/* Share of the spectral height: within it a surface is at its mean level, since gauges scatter. */
static const double NOISE = 0.02;

/* Fills the heights of the waves between upward crossings, and sets the sum of their durations. Of the crossings
   between `noise` below the mean level and `noise` above it the last one counts; the first wave may begin at rest. */
static size_t find_waves(const double *t, const double *z, size_t n, double level, double noise, double *heights,
                         double *lasting)
{
    size_t count = 0;
    bool begun = false, crossed = false, was_low = true;
    double low = 0, high = 0, begin = 0, crossing = 0;
    *lasting = 0;
    for (size_t i = 1; i < n; i++) {
        const double before = z[i - 1] - level, after = z[i] - level;
        if (before < 0 && after >= 0) {
            crossing = t[i - 1] + (t[i] - t[i - 1]) * before / (before - after);
            crossed = true;
        }
        if (after < -noise) was_low = true;
        if (after > noise && was_low && crossed) {
            if (begun) {
                heights[count++] = high - low;
                *lasting += crossing - begin;
            }
            begun = true;
            begin = crossing;
            low = high = after;
        }
        if (after > noise) was_low = crossed = false;
        low = fmin(low, after);
        high = fmax(high, after);
    }
    return count;
}

sb_status sb_wave_heights_of(const double *t, const double *z, size_t n, sb_wave_heights *heights, sb_error *error)
{
    const double none = (double)NAN;
    sb_wave_heights made = {0, none, none, none, none, none, none, none, none, none, none};
    double lasting, square = 0, *all = sb_alloc(n, sizeof *all);
    if (n > 0 && !all) return sb_fail_memory(error, "heights of waves");
    if (n > 0) made.level = 0;
    for (size_t i = 0; i < n; i++) made.level += z[i] / (double)n;
    for (size_t i = 0; i < n; i++) square += (z[i] - made.level) * (z[i] - made.level);
    for (size_t i = 0; i < n; i++) {
        if (!(z[i] <= made.crest)) made.crest_time = t[i];
        if (!(z[i] >= made.trough)) made.trough_time = t[i];
        made.crest = fmax(made.crest, z[i]);
        made.trough = fmin(made.trough, z[i]);
    }
    if (n > 0) made.spectral = 4 * sqrt(square / (double)n);
    made.count = find_waves(t, z, n, made.level, NOISE * made.spectral, all, &lasting);
    if (made.count > 0) {
        const size_t third = made.count < 2 ? 1 : (made.count + 1) / 3;
        qsort(all, made.count, sizeof *all, compare_falling);
        made.mean = made.significant = 0;
        for (size_t k = 0; k < made.count; k++) made.mean += all[k] / (double)made.count;
        for (size_t k = 0; k < third; k++) made.significant += all[k] / (double)third;
        made.highest = all[0];
        made.period = lasting / (double)made.count;
    }
    sb_free(all);
    *heights = made;
    return SB_OK;
}

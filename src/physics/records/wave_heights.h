/* Heights and periods of the waves in a series of surface elevations. */
#ifndef SB_PHYSICS_WAVE_HEIGHTS_H
#define SB_PHYSICS_WAVE_HEIGHTS_H

#include "base/status.h"

#include <stddef.h>

/* Of waves between upward crossings of the series' mean. A crossing counts where the surface comes from a fiftieth of
   `spectral` below the mean and goes as far above it, so that scatter has no waves. NaN where there are none. */
typedef struct sb_wave_heights {
    size_t count;
    double level;                      /* m, mean of the series */
    double mean, significant, highest; /* m: of all heights, of the highest third, to the nearest whole
                                          number, of the highest wave */
    double period;                     /* s, mean */
    double spectral;                   /* m, four standard deviations of the series */
    double crest, crest_time;          /* m, s: the highest elevation of the series, and when it was first */
    double trough, trough_time;        /* m, s: the lowest */
} sb_wave_heights;

/* n elevations z in m at increasing times t in s. Crossings are interpolated linearly. Fails only without memory. */
sb_status sb_wave_heights_of(const double *t, const double *z, size_t n, sb_wave_heights *heights, sb_error *error);

#endif

/* Waves in the series of gauges: harmonics by least squares, crests and troughs, and theory for a closed flume. All
   times in s, lengths in m, angles in rad. */
#ifndef SB_VALIDATE_WAVE_FIT_H
#define SB_VALIDATE_WAVE_FIT_H

#include "case.h"
#include "physics/records/reflection.h"
#include "physics/waves/stokes.h"

enum { SB_FIT_HARMONICS = 4 };

/* The harmonic n is amplitude[n - 1] cos(n omega t - phase[n - 1]). */
typedef struct sb_wave_fit {
    double mean;
    double amplitude[SB_FIT_HARMONICS], phase[SB_FIT_HARMONICS];
} sb_wave_fit;

/* Fits the curve over first <= t <= last. All values are NaN if the points do not determine them. */
sb_wave_fit sb_wave_fit_of(const sb_curve *curve, double period, double first, double last);
/* The fitted series at t. */
double sb_wave_fit_at(const sb_wave_fit *fit, double period, double t);

/* Crest and trough: means over the whole periods of first..last of the highest and the lowest value in each. Waves with
   several crests in a period count as one. NaN: no whole period with values. */
typedef struct sb_wave_range {
    double crest, trough;
} sb_wave_range;
sb_wave_range sb_wave_fit_range(const sb_curve *curve, double period, double first, double last);
/* Crest minus trough. */
double sb_wave_fit_height(const sb_curve *curve, double period, double first, double last);

/* Lays the curve from `first` on over `data` by one lag, the clocks having no common origin: the curve's first point
   comes to a time of the data from `onto` to a period later. Sets the lag, s, of the least root mean square of the
   difference, and returns it. NaN, and a lag of NaN, where the data never cover the whole curve. */
double sb_wave_fit_least(const sb_curve *curve, const sb_curve *data, double first, double onto, double period,
                         double *lag);

/* Splits the first harmonic at all gauges whose names begin with `prefix`. number: of its waves, 1/m. */
sb_split sb_wave_fit_split(const sb_case_run *run, const char *prefix, double period, double number, double first,
                           double last);

/* Wave number of the law's regular waves in a closed flume, 1/m; of linear theory if there are no such steady waves. */
double sb_wave_fit_number(const sb_wavemaker_parameters *law);

/* Wave number over that of linear theory of waves of the amplitude own that meet waves of the amplitude other and the
   same period, to third order in a closed flume. kd: by linear theory. Own part: Stokes' wave without transport; sum of
   both parts: the standing wave [Tadjbakhsh and Keller 1960, J. Fluid Mech. 8]. */
double sb_wave_fit_met(double kd, double own, double other, double depth);

/* The gauge's elevation above the still level, or an empty curve if the scene has no such gauge. */
sb_curve *sb_wave_fit_gauge(const sb_case_run *run, const char *name);

/* The Stokes wave of fifth order of a period in a closed flume, where no water is carried on average; current: the
   uniform return current, m/s, negative. False: there is no such wave. */
bool sb_wave_fit_stokes(double height, double period, double depth, double gravity, sb_stokes *wave, double *current);

/* Difference of two angles in -pi..pi. */
double sb_wave_fit_turn(double angle, double from);

#endif

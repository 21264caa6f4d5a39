#include "wave_fit.h"

#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "theory.h"

#include <math.h>
#include <string.h>

enum { MOST_TERMS = 2 * SB_FIT_HARMONICS + 1, MOST_GAUGES = 32 };

sb_wave_fit sb_wave_fit_of(const sb_curve *curve, double period, double first, double last)
{
    double sums[MOST_TERMS * MOST_TERMS + MOST_TERMS] = {0}, scratch[MOST_TERMS * MOST_TERMS + MOST_TERMS];
    double cosines[SB_FIT_HARMONICS], sines[SB_FIT_HARMONICS], total = 0;
    sb_wave_fit fit = {.mean = (double)NAN};
    size_t count = 0;
    for (size_t i = 0; i < curve->count; i++) {
        if (curve->x[i] < first || curve->x[i] > last || isnan(curve->y[i])) continue;
        sb_harmonics_add(sums, SB_FIT_HARMONICS, 2 * M_PI / period, curve->x[i], curve->y[i]);
        total += curve->y[i];
        count++;
    }
    const bool solved = sb_harmonics_solve(sums, SB_FIT_HARMONICS, scratch, cosines, sines);
    if (solved) fit.mean = total / (double)count;
    for (int n = 0; n < SB_FIT_HARMONICS; n++) {
        fit.amplitude[n] = solved ? hypot(cosines[n], sines[n]) : (double)NAN;
        fit.phase[n] = solved ? atan2(sines[n], cosines[n]) : (double)NAN;
    }
    return fit;
}

double sb_wave_fit_at(const sb_wave_fit *fit, double period, double t)
{
    double sum = fit->mean;
    for (int n = 0; n < SB_FIT_HARMONICS; n++)
        sum += fit->amplitude[n] * cos((n + 1) * 2 * M_PI * t / period - fit->phase[n]);
    return sum;
}

sb_wave_range sb_wave_fit_range(const sb_curve *curve, double period, double first, double last)
{
    sb_wave_range sum = {0, 0};
    const int periods = (int)((last - first) / period + 1e-6);
    for (int p = 0; p < periods; p++) {
        const double from = first + p * period;
        const size_t high = sb_curve_highest(curve, from, from + period),
                     low = sb_curve_lowest(curve, from, from + period);
        sum.crest += sb_curve_y(curve, high);
        sum.trough += sb_curve_y(curve, low);
    }
    const double count = periods > 0 ? periods : (double)NAN;
    return (sb_wave_range){sum.crest / count, sum.trough / count};
}

double sb_wave_fit_height(const sb_curve *curve, double period, double first, double last)
{
    const sb_wave_range range = sb_wave_fit_range(curve, period, first, last);
    return range.crest - range.trough;
}

sb_curve *sb_wave_fit_gauge(const sb_case_run *run, const char *name)
{
    const sb_measure_settings *measure = &run->scene->measure;
    for (size_t g = 0; g < measure->gauge_count; g++)
        if (strcmp(measure->gauges[g].name, name) == 0) return sb_run_curve(run, "gauges.csv", name, "time_s", "eta_m");
    return sb_curve_new(run->made);
}

double sb_wave_fit_number(const sb_wavemaker_parameters *law)
{
    sb_steady_wave wave;
    if (sb_steady_wave_of(law->height, law->period, law->depth, law->gravity, &wave)) return 2 * M_PI / wave.length;
    return sb_wave_number(law->period, law->depth, law->gravity);
}

/* Root mean square of the difference from `first` on, if the data cover it. */
static double distance(const sb_curve *curve, const sb_curve *data, double first, double lag)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < curve->count; i++) {
        if (curve->x[i] < first) continue;
        const double difference = curve->y[i] - sb_curve_at(data, curve->x[i] + lag);
        sum += difference * difference;
        count++;
    }
    return count > 1 ? sqrt(sum / (double)count) : (double)NAN;
}

double sb_wave_fit_least(const sb_curve *curve, const sb_curve *data, double first, double onto, double period,
                         double *lag)
{
    enum { TRIES = 244 };
    double least = *lag = (double)NAN;
    for (int i = 0; i < TRIES; i++) {
        const double here = onto - first + period * i / TRIES, d = distance(curve, data, first, here);
        if (!(d >= least) && !isnan(d)) {
            least = d;
            *lag = here;
        }
    }
    return least;
}

sb_split sb_wave_fit_split(const sb_case_run *run, const char *prefix, double period, double number, double first,
                           double last)
{
    const sb_measure_settings *measure = &run->scene->measure;
    double x[MOST_GAUGES], cosines[MOST_GAUGES], sines[MOST_GAUGES];
    size_t count = 0;
    for (size_t g = 0; g < measure->gauge_count && count < MOST_GAUGES; g++) {
        if (strncmp(measure->gauges[g].name, prefix, strlen(prefix)) != 0) continue;
        const sb_wave_fit fit = sb_wave_fit_of(sb_wave_fit_gauge(run, measure->gauges[g].name), period, first, last);
        x[count] = measure->gauges[g].x;
        cosines[count] = fit.amplitude[0] * cos(fit.phase[0]);
        sines[count++] = fit.amplitude[0] * sin(fit.phase[0]);
    }
    return sb_split_of(x, cosines, sines, count, number);
}

/* Volume that the wave carries per second and metre of width, m^2/s: the mean of the integral of u from the bed to the
   surface. */
static double carried(const sb_stokes *wave)
{
    enum { PHASES = 64 };
    double sum = 0;
    for (int i = 0; i < PHASES; i++) {
        const double ahead = wave->length * i / PHASES, top = wave->depth + sb_stokes_elevation(wave, ahead);
        for (int j = 0; j < wave->order; j++) {
            const double k = (j + 1) * wave->number;
            sum += wave->velocity[j] * cos(k * ahead) * sinh(k * top) / (k * cosh(k * wave->depth)) / PHASES;
        }
    }
    return sum;
}

bool sb_wave_fit_stokes(double height, double period, double depth, double gravity, sb_stokes *wave, double *current)
{
    const double linear = 2 * M_PI / sb_wave_number(period, depth, gravity);
    double shortest = 0.7 * linear, longest = 1.4 * linear;
    sb_error why = {0};
    if (!(height > 0 && period > 0 && depth > 0)) return false;
    for (int i = 0; i < 60; i++) {
        const double length = 0.5 * (shortest + longest);
        if (sb_stokes_create(5, height, length, depth, gravity, wave, &why) != SB_OK) return false;
        *current = -carried(wave) / depth;
        if (length < (wave->celerity + *current) * period)
            shortest = length;
        else
            longest = length;
    }
    return true;
}

double sb_wave_fit_turn(double angle, double from)
{
    return remainder(angle - from, 2 * M_PI);
}

double sb_wave_fit_met(double kd, double own, double other, double depth)
{
    /* Parts of the frequency at a given number, over (k a)^2. */
    const double t = tanh(kd), group = 0.5 * (1 + 2 * kd / sinh(2 * kd));
    const double stokes = (9 * pow(t, 4) - 10 * t * t + 9) / (16 * pow(t, 4)) - 1 / (2 * kd * t);
    /* two waves of amplitude a are a standing one of 2 a */
    const double standing = 4 * (sb_theory_standing_shift(kd, 1) - 1);
    const double k = kd / depth, change = pow(k * own, 2) * stokes + pow(k * other, 2) * (standing - stokes);
    return 1 - change / group;
}

/* A paddle makes waves towards a wall and absorbs what comes back; beside it the same paddle without absorption. */
#include "cases.h"
#include "paddle_case.h"
#include "wave_fit.h"

#include <complex.h>
#include <math.h>

enum { LATE = 8 }; /* periods, the last ones of the run */

/* When the first waves have passed the gauges and less than 1 % of a wave has returned by linear theory, in periods. */
typedef struct early {
    double first, last;
} early;

/* Complex amplitudes of the waves that leave the paddle and of those that return, at the paddle. */
typedef struct pair {
    double complex out, back;
} pair;

/* As sb_wave_fit_split, but with phases, and a number for each wave: least squares for out exp(-i k x) + back exp(i l
   x), the fitted series being the real part of that times exp(i omega t). */
static pair split_phases(const sb_case_run *run, double first, double last, double k, double l)
{
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const sb_measure_settings *measure = &run->scene->measure;
    double complex cross = 0, forward = 0, backward = 0;
    const double n = (double)measure->gauge_count;
    for (size_t g = 0; g < measure->gauge_count; g++) {
        const double x = measure->gauges[g].x;
        const double complex out = cexp(CMPLX(0, k * x)), back = cexp(CMPLX(0, l * x));
        const sb_wave_fit fit =
            sb_wave_fit_of(sb_wave_fit_gauge(run, measure->gauges[g].name), law->period, first, last);
        const double complex value = fit.amplitude[0] * CMPLX(cos(fit.phase[0]), -sin(fit.phase[0]));
        cross += out * back;
        forward += out * value;
        backward += conj(back) * value;
    }
    /* Normal equations: n out + cross back = forward; conj(cross) out + n back = backward. */
    const double determinant = n * n - creal(cross * conj(cross));
    return (pair){(n * forward - cross * backward) / determinant, (n * backward - conj(cross) * forward) / determinant};
}

/* The split with the numbers that waves of these amplitudes have when they meet. With those of linear theory a change
   of the number looks like a reflection. */
static pair split(const sb_case_run *run, double first, double last)
{
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const double k = sb_wave_number(law->period, law->depth, run->scene->fluid.gravity), kd = k * law->depth;
    const pair linear = split_phases(run, first, last, k, k);
    const double out = cabs(linear.out), back = cabs(linear.back);
    return split_phases(run, first, last, k * sb_wave_fit_met(kd, out, back, law->depth),
                        k * sb_wave_fit_met(kd, back, out, law->depth));
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const early *when = run->of->what;
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const double end = run->scene->duration;
    const pair before = split(run, when->first * law->period, when->last * law->period);
    const pair after = split(run, end - LATE * law->period, end);
    const double made = cabs(before.out);
    sb_figure_below(figures, "reflected by the paddle", "%", 100 * cabs(after.out - before.out) / cabs(after.back), 4,
                    "change of the waves that leave the paddle from periods %.3g to %.3g to the last %d, over those "
                    "that return, as complex amplitudes of the first harmonic",
                    when->first, when->last, LATE);
    sb_paddle_drift(run, figures);
    sb_figure_report(figures, "waves that leave, first over aimed", "", 1, 2 * made / law->height, "early, as above");
    sb_figure_report(figures, "waves that leave, last over first", "", (double)NAN, cabs(after.out) / made,
                     "amplitudes");
    sb_figure_report(figures, "waves that return, over those that leave", "", (double)NAN,
                     cabs(after.back) / cabs(after.out), "at the end; less than 1 by the loss on the way");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    sb_paddle_plot(runs, count, "Surface at 0.65 wavelengths", "a1", plot);
}

#define METHOD                                                                                                         \
    "Reference: none is needed. A paddle makes regular waves towards a wall four wavelengths away. Four gauges split " \
    "the first\nharmonic by least squares, with phases: what leaves the paddle while less than 1 % has come back by "  \
    "linear theory, and in the "                                                                                       \
    "last eight periods,\nwith the lengths that waves have when they meet (third order, docs/decisions/0109). The "    \
    "difference is what the paddle reflects. The other column is the same paddle with "                                \
    "`absorb: false`; its waves need not be\nregular. The full form runs for 100 periods."

/* from, to: periods of `early`; shorter: duration of the quick form and of the paddle without absorption, s. */
#define PADDLE(id, label, what_is, fine, coarse, from, to, shorter)                                                    \
    static const early early_##id = {from, to};                                                                        \
    static const char *const quick_##id[] = {"duration=" shorter, NULL};                                               \
    static const char *const fixed_##id[] = {"duration=" shorter, "wavemakers.waves.absorb=false", NULL};              \
    const sb_case sb_case_paddle_##id = {                                                                              \
        .name = "absorbing-paddle-" label,                                                                             \
        .title = "A paddle absorbs the waves that a wall returns, " what_is,                                           \
        .targets = "reflected: at most 4 %; drift after 100 periods: at most 1 % of the stroke",                       \
        .method = METHOD,                                                                                              \
        .scene = "absorbing-paddle/" label ".yaml",                                                                    \
        .headline = "reflected by the paddle",                                                                         \
        .what = &early_##id,                                                                                           \
        .full = {{.resolution = fine, .variant = "without absorption", .settings = fixed_##id},                        \
                 {.resolution = fine, .judged = true, .seeds = 3}},                                                    \
        .quick = {{.resolution = coarse, .variant = "without absorption", .settings = fixed_##id},                     \
                  {.resolution = coarse, .judged = true, .settings = quick_##id}},                                     \
        .evaluate = evaluate,                                                                                          \
        .plot = plot};

PADDLE(long, "kd0.3", "kd 0.3", 0.24, 0.48, 4.2, 7, "311.4")
PADDLE(middle, "kd0.7", "kd 0.7", 0.56, 1.12, 4.5, 7, "226.5")
PADDLE(short, "kd1.5", "kd 1.5", 0.8, 1.6, 5.5, 7, "218.7")
PADDLE(deep, "kd3", "kd 3", 0.8, 1.6, 5.5, 6.5, "240.7")

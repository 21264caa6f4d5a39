/* Regular waves through a side of kind sea, which a wall sends back to it. */
#include "cases.h"
#include "physics/waves/dispersion.h"
#include "sea_case.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

static const int PERIODS = 4; /* at the end of a run, from which the components are found */

/* The waves along the gauges: complex amplitudes of a cos(kx - wt) and of the wave in the other direction. */
typedef struct waves {
    double complex in, out;
} waves;

/* Component exp(i w t) of a gauge over the last periods, by sums over resampled readings. */
static double complex component(const sb_case_run *run, const sb_gauge *gauge)
{
    enum { PER_PERIOD = 80 };
    const sb_scene *scene = run->scene;
    const double period = scene->given.period, first = scene->duration - 0.05 - PERIODS * period;
    const sb_curve *eta = sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m");
    double complex sum = 0;
    for (int k = 0; k < PERIODS * PER_PERIOD; k++) {
        const double t = first + k * period / PER_PERIOD;
        sum += sb_curve_at(eta, t) * cexp(CMPLX(0, -2 * M_PI * t / period));
    }
    return 2 * sum / (PERIODS * PER_PERIOD);
}

/* Least squares over the gauges: component = in exp(-ikx) + out exp(ikx). Returns the sum of the squares that remain.
 */
static double fit(const sb_case_run *run, const double complex *eta, size_t n, double k, waves *w)
{
    const sb_gauge *gauges = run->scene->measure.gauges;
    double complex cross = 0, in = 0, out = 0;
    double left = 0;
    for (size_t g = 0; g < n; g++) {
        const double complex phase = cexp(CMPLX(0, k * gauges[g].x));
        cross += phase * phase;
        in += eta[g] * phase;
        out += eta[g] / phase;
    }
    const double size = (double)n, determinant = size * size - cabs(cross) * cabs(cross);
    *w = (waves){(size * in - cross * out) / determinant, (size * out - conj(cross) * in) / determinant};
    for (size_t g = 0; g < n; g++) {
        const double complex phase = cexp(CMPLX(0, k * gauges[g].x));
        const double off = cabs(eta[g] - w->in / phase - w->out * phase);
        left += off * off;
    }
    return left;
}

/* The waves, with the wave number within 3 % of the linear one that explains the gauges best: that of the particles
   differs from the theory's. *over: it over that of the theory. */
static waves split(const sb_case_run *run, double *over)
{
    enum { TRIALS = 121, GAUGES = 16 };
    const sb_given_sea *given = &run->scene->given;
    const double k = sb_wave_number(given->period, given->depth, run->scene->fluid.gravity);
    double complex eta[GAUGES] = {0};
    waves best = {0};
    double least = HUGE_VAL;
    const size_t count = run->scene->measure.gauge_count < GAUGES ? run->scene->measure.gauge_count : GAUGES;
    for (size_t g = 0; g < count; g++) eta[g] = component(run, &run->scene->measure.gauges[g]);
    for (int n = 0; n < TRIALS; n++) {
        waves w;
        const double share = 0.97 + 0.06 * n / (TRIALS - 1), left = fit(run, eta, count, share * k, &w);
        if (!(left < least)) continue;
        least = left;
        best = w;
        *over = share;
    }
    return best;
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const double amplitude = 0.5 * run->scene->given.height;
    double over = (double)NAN;
    const waves w = split(run, &over);
    sb_figure_share(figures, "incoming amplitude", "m", amplitude, cabs(w.in), amplitude, 2,
                    "over the last %d periods; a part of the reflected wave that came back counts", PERIODS);
    sb_figure_below(
        figures, "reflected again", "%", 100 * cabs(w.in - amplitude) / cabs(w.out), 4,
        "difference of the incoming wave from the given one, its phase included, over the wave from the wall");
    sb_figure_report(figures, "amplitude from the wall", "m", amplitude, cabs(w.out), "by the same fit");
    sb_figure_report(figures, "phase of the incoming wave", "deg", 0, carg(w.in) * 180 / M_PI,
                     "against the theory at x = 0; positive: early");
    sb_figure_report(figures, "wave number", "of the theory", 1, over,
                     "that within 3 %% which explains the gauges best");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const sb_gauge *gauge = &runs[0].scene->measure.gauges[runs[0].scene->measure.gauge_count - 1];
    sb_plot_panel(plot, "Surface at the gauge next to the wall", "time (s)", "m");
    for (size_t i = 0; i < count; i++) {
        sb_curve *eta = sb_run_curve(&runs[i], "gauges.csv", gauge->name, "time_s", "z_m");
        sb_curve_map(eta, 1, 0, 1, -runs[i].scene->sea.level);
        sb_plot_run(plot, &runs[i], eta);
    }
}

#define METHOD                                                                                                         \
    "Reference: the given wave, of second order, H L^2/d^3 < 26. h = 1 m, a wall 12 m from the side. The surface at "  \
    "seven "                                                                                                           \
    "gauges is\nsplit by least squares into the waves towards the wall and from it, whose wave number is fitted, "     \
    "too. The "                                                                                                        \
    "wave "                                                                                                            \
    "from the wall leaves\nthrough the side where the given one comes in."
#define TARGETS "incoming wave: within 2 %; reflected again: at most 4 % of the wave from the wall"

static const char *const middle[] = {"sea.height=0.1", "sea.period=3.0843", "duration=37.1", NULL};
static const char *const shorter[] = {"sea.height=0.1", "sea.period=1.7216", "duration=24.2", NULL};

const sb_case sb_case_sea_regular_long = {.name = "sea-regular-0.3",
                                          .title =
                                              "Regular waves of kd = 0.3 in through a side of kind sea and out again",
                                          .targets = TARGETS,
                                          .method = METHOD,
                                          .scene = "sea/regular.yaml",
                                          .headline = "incoming amplitude",
                                          SB_SEA_RUNS(NULL),
                                          .evaluate = evaluate,
                                          .plot = plot};

const sb_case sb_case_sea_regular_middle = {.name = "sea-regular-0.7",
                                            .title =
                                                "Regular waves of kd = 0.7 in through a side of kind sea and out again",
                                            .targets = TARGETS,
                                            .method = METHOD,
                                            .scene = "sea/regular.yaml",
                                            .headline = "incoming amplitude",
                                            SB_SEA_RUNS(middle),
                                            .evaluate = evaluate,
                                            .plot = plot};

const sb_case sb_case_sea_regular_short = {.name = "sea-regular-1.5",
                                           .title =
                                               "Regular waves of kd = 1.5 in through a side of kind sea and out again",
                                           .targets = TARGETS,
                                           .method = METHOD,
                                           .scene = "sea/regular.yaml",
                                           .headline = "incoming amplitude",
                                           SB_SEA_RUNS(shorter),
                                           .evaluate = evaluate,
                                           .plot = plot};

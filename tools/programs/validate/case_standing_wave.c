/* A standing wave in a vertical slice over ten periods. */
#include "cases.h"
#include "physics/waves/wave_theory.h"
#include "theory.h"

#include <math.h>
#include <stdio.h>

enum { MAIN = 2, PERIODS = 10 }; /* the wave is shape 2 of cos(n pi x/length) */

typedef struct wave {
    double amplitude, depth, k, gravity, length, period; /* of the scene; the period is that of linear theory */
} wave;

static wave wave_of(const sb_case_run *run)
{
    const sb_scene *scene = run->scene;
    wave w = {.amplitude = scene->wave.height,
              .depth = scene->wave.depth,
              .k = 2 * M_PI / scene->wave.wavelength,
              .gravity = scene->fluid.gravity,
              .length = scene->domain.max.x - scene->domain.min.x};
    w.period = sb_standing_period(scene->wave.wavelength, w.depth, w.gravity);
    return w;
}

/* Amplitude over time of the shape cos(n pi x/length) in the elevation. The gauges are at the midpoints of equal
   intervals. */
static sb_curve *shape(const sb_case_run *run, int n)
{
    const sb_scene *scene = run->scene;
    double length = scene->domain.max.x - scene->domain.min.x;
    sb_curve *sum = sb_curve_new(run->made);
    for (size_t g = 0; g < scene->measure.gauge_count; g++) {
        const sb_gauge *gauge = &scene->measure.gauges[g];
        double share =
            2.0 / (double)scene->measure.gauge_count * cos(n * M_PI * (gauge->x - scene->domain.min.x) / length);
        sb_curve *eta = sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m");
        sb_curve_map(eta, 1, 0, share, -share * scene->sea.level);
        sb_curve_sum(sum, eta);
    }
    return sum;
}

/* Results for a damped oscillation: the period from a line through all zero crossings, the decay from a line through
   the logarithms of the extremes between them. */
typedef struct oscillation {
    double period, decay, mean_square; /* s, 1/s, m^2 of the extremes */
} oscillation;

/* Extremes below this fraction of the largest are noise. */
static const double LEAST = 0.02;

/* Finds zero crossings (over their number) and the logarithms of the extremes before them (over time). */
static void find_extremes(const sb_case_run *run, const sb_curve *a, double last, sb_curve *crossings,
                          sb_curve *extremes)
{
    sb_curve *size = sb_curve_new(run->made);
    sb_curve_sum(size, a);
    for (size_t k = 0; k < size->count; k++) size->y[k] = fabs(size->y[k]);
    double before = sb_curve_x(a, 0), least = LEAST * sb_curve_peak(size, before, last, 0.1).y;
    for (size_t i = 1; i < a->count && a->x[i] <= last; i++) {
        if ((a->y[i - 1] < 0) == (a->y[i] < 0)) continue;
        double share = a->y[i - 1] / (a->y[i - 1] - a->y[i]);
        double at = a->x[i - 1] + share * (a->x[i] - a->x[i - 1]);
        sb_peak peak = sb_curve_peak(size, before, at, 0.3 * (at - before));
        if (!(peak.y > least)) continue;
        if (crossings->count) sb_curve_add(extremes, peak.x, log(peak.y));
        sb_curve_add(crossings, (double)crossings->count, at);
        before = at;
    }
}

static oscillation measure(const sb_case_run *run, double last)
{
    sb_curve *crossings = sb_curve_new(run->made), *extremes = sb_curve_new(run->made);
    double first, slope, squares = 0;
    oscillation found = {(double)NAN, (double)NAN, (double)NAN};
    const sb_curve *a = shape(run, MAIN);
    if (a->count == 0 && run->error->status == SB_OK) sb_fail(run->error, SB_FAILED, "no surface elevations");
    find_extremes(run, a, last, crossings, extremes);
    if (sb_curve_line(crossings, 0, HUGE_VAL, &first, &slope)) found.period = 2 * slope;
    if (sb_curve_line(extremes, 0, HUGE_VAL, &first, &slope)) {
        for (size_t i = 0; i < extremes->count; i++) squares += exp(2 * extremes->y[i]);
        found.decay = -slope;
        found.mean_square = squares / (double)extremes->count;
    }
    return found;
}

static void figure_oscillation(const sb_case_run *run, const wave *w, sb_figures *figures)
{
    const oscillation found = measure(run, PERIODS * w->period);
    double steepness = w->k * sqrt(found.mean_square);
    double period = w->period / sb_theory_standing_shift(w->k * w->depth, steepness);
    sb_figure_share(figures, "period", "s", period, found.period, period, 1,
                    "line through all zero crossings of ten periods; linear theory gives %.4f s, the third-order "
                    "correction at the simulated mean steepness %+.2f %%",
                    w->period, 100 * (period / w->period - 1));
    sb_figure_below(figures, "decay of the amplitude", "% per period", 100 * found.decay * w->period, 1,
                    "line through the logarithms of the extremes; water has 2 nu k^2, less than 0.01 %% per period");
}

/* Size of a shape in % of the initial amplitude. */
static double size_of(const sb_case_run *run, const wave *w, int n)
{
    return 100 * (sqrt(2.0) * sb_curve_rms(shape(run, n), 0, PERIODS * w->period) / w->amplitude);
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    static const char note[] = "root mean square over ten periods times sqrt(2), relative to the initial amplitude";
    wave w = wave_of(run);
    figure_oscillation(run, &w, figures);
    sb_figure_below(figures, "second wave, half the wave number", "%", size_of(run, &w, 1), 10, note);
    sb_figure_below(figures, "second wave, 1.5 times the wave number", "%", size_of(run, &w, 3), 10, note);
    sb_figure_report(figures, "twice the wave number", "%", (double)NAN, size_of(run, &w, 4),
                     "the same; part of it is the second-order shape of the wave itself");
}

static void compare(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures)
{
    double most = -HUGE_VAL;
    (void)runs;
    for (size_t i = 1; i < count; i++) {
        double coarse = sb_figures_find(&of_each[i - 1], "decay of the amplitude")->value;
        double fine = sb_figures_find(&of_each[i], "decay of the amplitude")->value;
        double ratio = fine / coarse;
        most = ratio > most || isnan(ratio) ? ratio : most;
    }
    sb_figure_below(figures, "decay, finer over coarser", "", most, 1,
                    "largest ratio of two neighbouring spacings of %zu; below 1 the decay falls with the spacing",
                    count);
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    wave w = wave_of(&runs[0]);
    sb_curve *theory = sb_curve_new(runs[0].made);
    for (int i = 0; i <= 60 * PERIODS; i++) {
        double t = w.period * i / 60;
        sb_curve_add(theory, t, w.amplitude * cos(2 * M_PI * t / w.period));
    }
    sb_plot_panel(plot, "Amplitude of the standing wave", "time (s)", "m");
    sb_plot_range(plot, 0, PERIODS * w.period, (double)NAN, (double)NAN);
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "linear, no viscosity", theory);
    for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], shape(&runs[i], MAIN));
    sb_plot_panel(plot, "Amplitude at half the wave number: should be none", "time (s)", "m");
    sb_plot_range(plot, 0, PERIODS * w.period, (double)NAN, (double)NAN);
    for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], shape(&runs[i], 1));
}

const sb_case sb_case_standing_wave = {
    .name = "standing-wave",
    .title = "Standing wave over ten periods",
    .targets = "period: within 1 %; decay: at most 1 % per period, and falling with the spacing; other shapes: at most "
               "10 % of the amplitude",
    .method = "Reference: linear theory with the third-order shift of frequency (Tadjbakhsh and Keller 1960). Walls "
              "have the friction of smooth ones.\nWhat the viscosity of water takes could not be seen "
              "(2 nu k^2, Lamb 1932, art. 348). h = 1 m, wavelength 2 m, amplitude 0.05 "
              "m. Forty gauges are projected on cos(n pi x/2); the wave is\nn = 2. No filter, no time shift.",
    .scene = "standing-wave/standing-wave.yaml",
    .headline = "period",
    .full = {{.resolution = 0.05, .paper = true},
             {.resolution = 0.025, .paper = true},
             {.resolution = 0.0125, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.05}, {.resolution = 0.04, .judged = true}},
    .evaluate = evaluate,
    .compare = compare,
    .plot = plot};

/* A standing wave in a vertical slice over ten periods. */
#include "cases.h"
#include "physics/wave_theory.h"
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
static sb_status shape(const sb_case_run *run, int n, sb_curve *amplitude, sb_error *error)
{
    const sb_scene *scene = run->scene;
    double length = scene->domain.max.x - scene->domain.min.x;
    sb_curve sum = {0};
    sb_status status = SB_OK;
    for (size_t g = 0; status == SB_OK && g < scene->measure.gauge_count; g++) {
        sb_curve eta = {0};
        const sb_gauge *gauge = &scene->measure.gauges[g];
        double share =
            2.0 / (double)scene->measure.gauge_count * cos(n * M_PI * (gauge->x - scene->domain.min.x) / length);
        status = sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m", &eta, error);
        if (status == SB_OK) sb_curve_map(&eta, 1, 0, share, -share * scene->sea.level);
        for (size_t i = 0; i < sum.count && i < eta.count; i++) sum.y[i] += eta.y[i];
        if (sum.count)
            sb_curve_free(&eta);
        else
            sum = eta;
    }
    if (status != SB_OK)
        sb_curve_free(&sum);
    else
        *amplitude = sum;
    return status;
}

/* Results for a damped oscillation: the period from a line through all zero crossings, the decay from a line through
   the logarithms of the extremes between them. */
typedef struct oscillation {
    double period, decay, mean_square; /* s, 1/s, m^2 of the extremes */
} oscillation;

/* Extremes below this fraction of the largest are noise. */
static const double LEAST = 0.02;

/* Finds zero crossings (over their number) and the logarithms of the extremes before them (over time). */
static sb_status find_extremes(const sb_curve *a, double last, sb_curve *crossings, sb_curve *extremes, sb_error *error)
{
    sb_curve size = {0};
    if (a->count == 0) return sb_fail(error, SB_FAILED, "no surface elevations");
    sb_status status = sb_curve_copy(a, &size, error);
    for (size_t k = 0; k < size.count; k++) size.y[k] = fabs(size.y[k]);
    double before = a->x[0], least = LEAST * sb_curve_peak(&size, before, last, 0.1).y;
    for (size_t i = 1; status == SB_OK && i < a->count && a->x[i] <= last; i++) {
        if ((a->y[i - 1] < 0) == (a->y[i] < 0)) continue;
        double share = a->y[i - 1] / (a->y[i - 1] - a->y[i]);
        double at = a->x[i - 1] + share * (a->x[i] - a->x[i - 1]);
        sb_peak peak = sb_curve_peak(&size, before, at, 0.3 * (at - before));
        if (!(peak.y > least)) continue;
        if (crossings->count) status = sb_curve_add(extremes, peak.x, log(peak.y), error);
        if (status == SB_OK) status = sb_curve_add(crossings, (double)crossings->count, at, error);
        before = at;
    }
    sb_curve_free(&size);
    return status;
}

static sb_status measure(const sb_curve *a, double last, oscillation *found, sb_error *error)
{
    sb_curve crossings = {0}, extremes = {0};
    double first, slope, squares = 0;
    *found = (oscillation){(double)NAN, (double)NAN, (double)NAN};
    sb_status status = find_extremes(a, last, &crossings, &extremes, error);
    if (status == SB_OK && sb_curve_line(&crossings, 0, HUGE_VAL, &first, &slope)) found->period = 2 * slope;
    if (status == SB_OK && sb_curve_line(&extremes, 0, HUGE_VAL, &first, &slope)) {
        for (size_t i = 0; i < extremes.count; i++) squares += exp(2 * extremes.y[i]);
        found->decay = -slope;
        found->mean_square = squares / (double)extremes.count;
    }
    sb_curve_free(&crossings);
    sb_curve_free(&extremes);
    return status;
}

static sb_status figure_oscillation(const sb_case_run *run, const wave *w, sb_figures *figures, sb_error *error)
{
    sb_curve a = {0};
    oscillation found;
    sb_status status = shape(run, MAIN, &a, error);
    if (status == SB_OK) status = measure(&a, PERIODS * w->period, &found, error);
    sb_curve_free(&a);
    if (status != SB_OK) return status;
    double viscosity = sb_theory_viscosity(run->scene, w->depth);
    double steepness = w->k * sqrt(found.mean_square);
    double period = w->period / sb_theory_standing_shift(w->k * w->depth, steepness);
    double decay = sb_theory_decay(viscosity, w->k);
    status =
        sb_figure_share(figures, "period", "s", period, found.period, period, 1, error,
                        "line through all zero crossings of ten periods; linear theory gives %.4f s, the third-order "
                        "correction at the simulated mean steepness %+.2f %%",
                        w->period, 100 * (period / w->period - 1));
    if (status == SB_OK)
        status = sb_figure_share(figures, "decay of the amplitude", "1/s", decay, found.decay, decay, 20, error,
                                 "line through the logarithms of the extremes; theory 2 nu k^2 at nu_eff = %.3g m^2/s",
                                 viscosity);
    return status;
}

static sb_status figure_shape(const sb_case_run *run, const wave *w, int n, double limit, const char *quantity,
                              const char *note, sb_figures *figures, sb_error *error)
{
    sb_curve a = {0};
    sb_status status = shape(run, n, &a, error);
    if (status != SB_OK) return status;
    double size = sqrt(2.0) * sb_curve_rms(&a, 0, PERIODS * w->period) / w->amplitude;
    sb_curve_free(&a);
    if (isnan(limit)) return sb_figure_report(figures, quantity, "%", (double)NAN, 100 * size, error, "%s", note);
    return sb_figure_below(figures, quantity, "%", 100 * size, limit, error, "%s", note);
}

static sb_status evaluate(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    static const char note[] = "root mean square over ten periods times sqrt(2), relative to the initial amplitude";
    wave w = wave_of(run);
    sb_status status = figure_oscillation(run, &w, figures, error);
    if (status == SB_OK)
        status = figure_shape(run, &w, 1, 10, "second wave, half the wave number", note, figures, error);
    if (status == SB_OK)
        status = figure_shape(run, &w, 3, 10, "second wave, 1.5 times the wave number", note, figures, error);
    if (status == SB_OK)
        status = figure_shape(run, &w, 4, (double)NAN, "twice the wave number",
                              "the same; part of it is the second-order shape of the wave itself", figures, error);
    return status;
}

static sb_status compare(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures,
                         sb_error *error)
{
    double most = -HUGE_VAL;
    (void)runs;
    for (size_t i = 1; i < count; i++) {
        double coarse = sb_figures_find(&of_each[i - 1], "decay of the amplitude")->value;
        double fine = sb_figures_find(&of_each[i], "decay of the amplitude")->value;
        double ratio = fine / coarse;
        most = ratio > most || isnan(ratio) ? ratio : most;
    }
    return sb_figure_below(
        figures, "decay, finer over coarser", "", most, 1, error,
        "largest ratio of two neighbouring spacings of %zu; below 1 the decay falls with the spacing", count);
}

static sb_status plot(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    wave w = wave_of(&runs[0]);
    sb_curve theory = {0};
    sb_status status = sb_plot_panel(plot, "Amplitude of the standing wave", "time (s)", "m", error);
    if (status == SB_OK) sb_plot_range(plot, 0, PERIODS * w.period, (double)NAN, (double)NAN);
    for (int i = 0; status == SB_OK && i <= 60 * PERIODS; i++) {
        double t = w.period * i / 60;
        status = sb_curve_add(&theory, t, w.amplitude * cos(2 * M_PI * t / w.period), error);
    }
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_REFERENCE, "linear, no viscosity", &theory, error);
    sb_curve_free(&theory);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_curve a = {0};
        status = shape(&runs[i], MAIN, &a, error);
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &a, error);
        sb_curve_free(&a);
    }
    if (status == SB_OK)
        status = sb_plot_panel(plot, "Amplitude at half the wave number: should be none", "time (s)", "m", error);
    if (status == SB_OK) sb_plot_range(plot, 0, PERIODS * w.period, (double)NAN, (double)NAN);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_curve a = {0};
        status = shape(&runs[i], 1, &a, error);
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &a, error);
        sb_curve_free(&a);
    }
    return status;
}

static const sb_plan full[] = {{.resolution = 0.05, .paper = true},
                               {.resolution = 0.025, .paper = true},
                               {.resolution = 0.0125, .judged = true, .seeds = 3},
                               {.resolution = 0}};
static const sb_plan quick[] = {{.resolution = 0.05}, {.resolution = 0.04, .judged = true}, {.resolution = 0}};

const sb_case sb_case_standing_wave = {
    .name = "standing-wave",
    .title = "Standing wave over ten periods",
    .targets = "period: within 1 %; decay: within 20 % of theory for the effective viscosity, and falling with the "
               "spacing; other shapes: at most 10 % of the amplitude",
    .method =
        "Reference: linear theory with the third-order shift of frequency (Tadjbakhsh and Keller 1960). The decay is "
        "that of the\nviscosity of the irrotational flow, 2 nu k^2 (Lamb 1932, art. 348), for the effective viscosity "
        "of the viscous terms\n(docs/method.md, section 6, with the lattice sum averaged over all directions of "
        "strain). Walls are free-slip, so that there\nare no boundary layers. h = 1 m, wavelength 2 m, amplitude 0.05 "
        "m. Forty gauges are projected on cos(n pi x/2); the wave is\nn = 2. No filter, no time shift.",
    .scene = "standing-wave/standing-wave.yaml",
    .headline = "period",
    .full = full,
    .quick = quick,
    .evaluate = evaluate,
    .compare = compare,
    .plot = plot};

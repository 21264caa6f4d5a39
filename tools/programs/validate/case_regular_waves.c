/* Regular waves in flumes of twelve wavelengths: height, loss of height and wavelength. One scene each. */
#include "cases.h"
#include "paddle_case.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "wave_fit.h"

#include <math.h>
#include <stdio.h>

enum {
    WINDOW = 4, /* periods: those over which a gauge counts, the last ones of the run for heights */
    SETTLE = 3, /* periods after the ramp and the way of the first waves */
    ENOUGH = 5  /* gauges that determine a length */
};

/* The bars of a case; NaN: reported. */
typedef struct bars {
    double height, loss, length; /* % */
} bars;

typedef struct train {
    const sb_wavemaker_parameters *law;
    double ramp;         /* s, of the paddle's motion */
    double linear;       /* m, wavelength of linear theory, in which places are given */
    double first, last;  /* s, the window */
    double first_height; /* m, at two wavelengths */
    double second;       /* amplitude of the second harmonic over the first, there */
    double loss;         /* %, over ten wavelengths */
    double loss_error;   /* %, standard error of the loss */
} train;

/* The line of phases. */
typedef struct phases {
    size_t gauges;
    double height, mean; /* m, means over the gauges of height and elevation */
    double length;       /* m */
} phases;

/* Standard error of the slope of a line through the points, from their distances to it. */
static double error_of_slope(const sb_curve *points, double a, double slope)
{
    double mean = 0, spread = 0, off = 0;
    for (size_t i = 0; i < points->count; i++) mean += points->x[i] / (double)points->count;
    for (size_t i = 0; i < points->count; i++) {
        spread += pow(points->x[i] - mean, 2);
        off += pow(points->y[i] - a - slope * points->x[i], 2);
    }
    return points->count > 2 ? sqrt(off / (double)(points->count - 2) / spread) : (double)NAN;
}

/* The slope of ln H over x gives the loss. */
static void follow(const sb_case_run *run, train *w, sb_curve *heights)
{
    const sb_measure_settings *measure = &run->scene->measure;
    sb_curve *logarithm = sb_curve_new(run->made);
    double a, slope;
    for (size_t g = 0; g < measure->gauge_count; g++) {
        const double x = measure->gauges[g].x;
        const sb_curve *eta = sb_wave_fit_gauge(run, measure->gauges[g].name);
        const double height = sb_wave_fit_height(eta, w->law->period, w->first, w->last);
        sb_curve_add(logarithm, x, log(height));
        sb_curve_add(heights, x / w->linear, height / w->law->height);
        if (g > 0) continue;
        const sb_wave_fit fit = sb_wave_fit_of(eta, w->law->period, w->first, w->last);
        w->first_height = height;
        w->second = fit.amplitude[1] / fit.amplitude[0];
    }
    w->loss = w->loss_error = (double)NAN;
    if (sb_curve_line(logarithm, 0, HUGE_VAL, &a, &slope)) {
        w->loss = 100 * (1 - exp(10 * w->linear * slope));
        w->loss_error = 10 * w->linear * (100 - w->loss) * error_of_slope(logarithm, a, slope);
    }
}

/* Waves that start on water at rest leave a free long wave, which runs ahead of them. When it comes back from the end
   of the flume, it changes level and current, and the length with them. Returns until when the flow at x is steady;
   before the waves have settled there: 0. */
static double steady_until(const sb_case_run *run, const train *w, double x)
{
    const sb_scene *scene = run->scene;
    const double omega = 2 * M_PI / w->law->period, number = 2 * M_PI / w->linear;
    const double settled = w->ramp + SETTLE * w->law->period + x / sb_group_speed(omega, number, w->law->depth);
    const double back = (2 * scene->domain.max.x - x) / sqrt(scene->fluid.gravity * w->law->depth);
    const double until = fmin(back, w->last);
    return until - WINDOW * w->law->period >= settled ? until : 0;
}

/* The slope of the phase of the first harmonic over x is the wave number. The phases are taken relative to linear
   theory, and unrolled from gauge to gauge. steady: the gauges where the flow is steady, while it is; otherwise all, in
   the last periods of the run. */
static phases phases_of(const sb_case_run *run, const train *w, bool steady)
{
    const sb_measure_settings *measure = &run->scene->measure;
    sb_curve *line = sb_curve_new(run->made);
    const double number = 2 * M_PI / w->linear, period = w->law->period;
    phases found = {.length = (double)NAN};
    double a, slope, before = 0;
    for (size_t g = 0; g < measure->gauge_count; g++) {
        const double x = measure->gauges[g].x, last = steady ? steady_until(run, w, x) : w->last;
        if (!(last > 0)) continue;
        const sb_curve *eta = sb_wave_fit_gauge(run, measure->gauges[g].name);
        const sb_wave_fit fit = sb_wave_fit_of(eta, period, last - WINDOW * period, last);
        const double turned = fit.phase[0] - number * x;
        before = found.gauges++ ? before + sb_wave_fit_turn(turned, before) : turned;
        sb_curve_add(line, x, before);
        found.height += sb_wave_fit_height(eta, period, last - WINDOW * period, last);
        found.mean += fit.mean;
    }
    found.height /= (double)found.gauges;
    found.mean /= (double)found.gauges;
    if (sb_curve_line(line, 0, HUGE_VAL, &a, &slope)) found.length = 2 * M_PI / (number + slope);
    return found;
}

static double ramp_of(const sb_wavemaker_parameters *law)
{
    sb_paddle paddle = {0};
    if (sb_paddle_create(law, &paddle, NULL) != SB_OK) return (double)NAN;
    const double ramp = paddle.kind->facts(paddle.state)->ramp;
    sb_paddle_destroy(&paddle);
    return ramp;
}

static train train_of(const sb_case_run *run, sb_curve *heights)
{
    const sb_scene *scene = run->scene;
    const sb_wavemaker_parameters *law = &scene->wavemakers[0].law;
    train w = {.law = law,
               .ramp = ramp_of(law),
               .linear = 2 * M_PI / sb_wave_number(law->period, law->depth, scene->fluid.gravity),
               .first = scene->duration - WINDOW * law->period,
               .last = scene->duration};
    follow(run, &w, heights);
    return w;
}

/* A row that is judged, or only reported where the case has no bar. */
static void figure(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                   double limit, const char *note)
{
    sb_figure_share(figures, quantity, unit, reference, value, reference, limit, "%s", note);
}

static void figure_length(const sb_case_run *run, const train *w, double limit, sb_figures *figures)
{
    char note[SB_FIGURE_NOTE];
    sb_steady_wave wave;
    phases p = phases_of(run, w, true);
    const bool before = p.gauges >= ENOUGH;
    if (!before) p = phases_of(run, w, false);
    const char *when = before ? "before the long wave comes back" : "in the last four periods";
    const bool steady =
        sb_steady_wave_of(p.height, w->law->period, w->law->depth + p.mean, run->scene->fluid.gravity, &wave);
    if (steady)
        snprintf(note, sizeof note,
                 "from the phases at %zu gauges %s; a steady wave of their mean height %.4g m and level %+.2g m, with "
                 "the return current of a closed flume, %.3g m/s; linear %.5g m",
                 p.gauges, when, p.height, p.mean, wave.current, w->linear);
    else
        snprintf(note, sizeof note, "from the phases at %zu gauges %s; no steady wave has a mean height of %.4g m",
                 p.gauges, when, p.height);
    figure(figures, "wavelength", "m", steady ? wave.length : (double)NAN, p.length, limit, note);
}

/* The long wave of the start raises level and height when it comes back. */
static void figure_height(const sb_case_run *run, const train *w, double limit, sb_figures *figures)
{
    const sb_gauge *gauge = &run->scene->measure.gauges[0];
    const double until = steady_until(run, w, gauge->x);
    const bool before = until > 0 && until < w->last;
    const double height = before ? sb_wave_fit_height(sb_wave_fit_gauge(run, gauge->name), w->law->period,
                                                      until - WINDOW * w->law->period, until)
                                 : w->first_height;
    figure(figures, "height at two wavelengths", "m", w->law->height, height, limit,
           before ? "mean of crest minus trough in the last four periods before the long wave of the start comes back"
                  : "mean of crest minus trough in the last four periods");
    if (before)
        sb_figure_report(figures, "height at two wavelengths, last four periods", "m", w->law->height, w->first_height,
                         "when the long wave of the start has come back");
}

/* A line over gauges within two wavelengths, as in quick forms, does not distinguish a loss over ten from scatter. */
static void figure_loss(const sb_case_run *run, const train *w, double limit, sb_figures *figures)
{
    static const char note[] = "line through the logarithms of the heights at %zu gauges, whose scatter makes a "
                               "standard error of %.2g points";
    const size_t gauges = run->scene->measure.gauge_count;
    if (isnan(limit) || run->quick)
        sb_figure_report(figures, "loss of height over ten wavelengths", "%", (double)NAN, w->loss, note, gauges,
                         w->loss_error);
    else
        sb_figure_share(figures, "loss of height over ten wavelengths", "%", 0, w->loss, 100, limit, note, gauges,
                        w->loss_error);
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const bars *limit = run->of->what;
    const train w = train_of(run, sb_curve_new(run->made));
    figure_height(run, &w, limit->height, figures);
    figure_loss(run, &w, limit->loss, figures);
    figure_length(run, &w, limit->length, figures);
    sb_figure_report(figures, "second harmonic over first, at two wavelengths", "", (double)NAN, w.second,
                     "by least squares");
    sb_figure_report(figures, "particles per height", "", (double)NAN, w.law->height / run->resolution, "as aimed at");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    double x[] = {0, 12}, y[] = {1, 1};
    sb_plot_panel(plot, "Wave height along the flume", "distance from the paddle (wavelengths)",
                  "over the height aimed at");
    sb_plot_range(plot, 0, 12.5, 0.6, 1.2);
    sb_plot_points(plot, "no loss", 2, x, y);
    for (size_t i = 0; i < count; i++) {
        sb_curve *heights = sb_curve_new(runs[i].made);
        train_of(&runs[i], heights);
        sb_plot_run(plot, &runs[i], heights);
    }
    sb_paddle_plot(runs, count, "Surface at two wavelengths", runs[0].scene->measure.gauges[0].name, plot);
}

#define METHOD                                                                                                         \
    "Reference: the height aimed at, and a steady wave (Rienecker and Fenton 1981; Stokes' theory of fifth order is "  \
    "within 0.02 % of it in all flumes but the cnoidal one) in a closed flume, where a return "                        \
    "current\ncarries back what the waves carry forward. Gauges stand from 2 to 12 wavelengths from the paddle; the "  \
    "last four periods\ncount, for the height at two wavelengths those before the long wave of the start comes back "  \
    "(docs/decisions/0108). Loss: from the line through the logarithms of the heights. Wavelength: from the line "     \
    "through the phases of the first\nharmonics, over the last four periods before the long wave of the start comes "  \
    "back from the end of the flume, at the gauges\nthat the waves have reached by then (docs/decisions/0108); with "  \
    "fewer than five such gauges, at all in the last four periods. No\nfilter, no time shift. The quick form has "     \
    "gauges from 2 to 3.9 "                                                                                            \
    "wavelengths, two to eight particles per\nheight, and reports the loss."

/* The flume of a quick form ends after five wavelengths. */
#define SHORT(top, periods)                                                                                            \
    "domain.max=[550, " top "]", "duration=" periods,                                                                  \
        "measure.gauges=[{name: g0200, x: 200}, {name: g0237, x: 237}, {name: g0280, x: 280}, {name: g0330, x: 330}, " \
        "{name: g0390, x: 390}]",                                                                                      \
        NULL
static const char *const short_half[] = {SHORT("10", "141.3")}, *const short_low[] = {SHORT("20", "119.2")},
                         *const short_one[] = {SHORT("24", "119.2")}, *const short_two[] = {SHORT("38", "122.3")},
                         *const short_three[] = {SHORT("54", "128.4")}, *const short_cnoidal[] = {SHORT("13", "138.6")};

#define FLUME(id, label, file, what_is, aims, height_bar, loss_bar, length_bar, fine, many, coarse, more)              \
    static const bars bars_##id = {height_bar, loss_bar, length_bar};                                                  \
    const sb_case sb_case_regular_##id = {                                                                             \
        .name = "regular-waves-" label,                                                                                \
        .title = "Regular waves over twelve wavelengths, " what_is,                                                    \
        .targets = aims,                                                                                               \
        .method = METHOD,                                                                                              \
        .scene = "regular-waves/" file ".yaml",                                                                        \
        .headline = "loss of height over ten wavelengths",                                                             \
        .what = &bars_##id,                                                                                            \
        .full = {{.resolution = 2 * (fine)}, {.resolution = fine, .judged = true, .seeds = many}},                     \
        .quick = {{.resolution = coarse, .judged = true, .settings = more}},                                           \
        .evaluate = evaluate,                                                                                          \
        .plot = plot};

#define NONE ((double)NAN)
#define AIMS(loss)                                                                                                     \
    "height at two wavelengths: within 3 %; loss over ten wavelengths: at most " loss " %; wavelength: within 0.5 %"
#define AIMS_SHORT "wavelength: within 0.5 %; height and loss: reported"

FLUME(half, "kd0.5", "kd0.5", "kd 0.5, H/L 0.01", AIMS("5"), 3, 5, 0.5, 0.125, 1, 0.5, short_half)
FLUME(low, "kd1-low", "kd1-low", "kd 1, H/L 0.02", AIMS("5"), 3, 5, 0.5, 0.25, 1, 1, short_low)
FLUME(one, "kd1", "kd1", "kd 1, H/L 0.04", AIMS("5"), 3, 5, 0.5, 0.5, 3, 1, short_one)
FLUME(fine, "kd1-fine", "kd1", "kd 1, H/L 0.04, 16 particles per height", AIMS("2"), 3, 2, 0.5, 0.25, 1, 0.5, short_one)
FLUME(two, "kd2", "kd2", "kd 2, H/L 0.03", AIMS_SHORT, NONE, NONE, 0.5, 0.375, 1, 1.5, short_two)
FLUME(three, "kd3", "kd3", "kd 3, H/L 0.03", AIMS_SHORT, NONE, NONE, 0.5, 0.375, 1, 1.5, short_three)
FLUME(cnoidal, "cnoidal", "cnoidal", "cnoidal, H L^2/d^3 = 34.6", AIMS("5"), 3, 5, 0.5, 0.25, 1, 0.5, short_cnoidal)

/* Solitary waves on a plane beach of 1:19.85: a breaking and a non-breaking one. */
#include "cases.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double COTANGENT = 19.85;
static const double OFFSET = 0.5; /* m; distance from the start of the run-up line to the shoreline */
static const char *const times[] = {"15", "20", "25", "30"};
enum { TIMES = 4 };

/* The laboratory's run-up for a wave of height H/d, interpolated between groups of runs on logarithmic axes. which:
   "runup" (means of the groups), "least" or "greatest" of a group. */
static double laboratory(const sb_case_run *run, const char *which, double height)
{
    sb_curve *table = sb_reference_curve(run, "solitary-runup/runup.csv", NULL, "height", which);
    for (size_t i = 0; i < table->count; i++) {
        table->x[i] = log(table->x[i]);
        table->y[i] = log(table->y[i]);
    }
    return exp(sb_curve_at(table, log(height)));
}

static sb_curve *front_of(const sb_case_run *run)
{
    return sb_run_curve(run, "runup.csv", "beach", "time_s", "front_m");
}

static void figure_runup(const sb_case_run *run, double limit, sb_figures *figures)
{
    const sb_initial_wave *wave = &run->scene->wave;
    double height = wave->height / wave->depth, measured = laboratory(run, "runup", height);
    double law = height > 0.045 ? 1.109 * pow(height, 0.582) : 2.831 * sqrt(COTANGENT) * pow(height, 1.25);
    const sb_curve *front = front_of(run), *top = sb_run_curve(run, "runup.csv", "beach", "time_s", "z_m");
    size_t far = sb_curve_highest(front, 0, HUGE_VAL), high = sb_curve_highest(top, 0, HUGE_VAL);
    double reached = (sb_curve_y(front, far) - OFFSET) / COTANGENT / wave->depth;
    sb_figure_share(figures, "run-up R/d", "", measured, reached, measured, limit,
                    "height of the beach at the front of the connected water, at t sqrt(g/d) = %.1f, for H/d = %g; the "
                    "run-up law gives %.3f",
                    sb_curve_x(front, far) * sqrt(run->scene->fluid.gravity / wave->depth), height, law);
    sb_figure_report(figures, "highest water over d", "", measured, sb_curve_y(top, high) / wave->depth,
                     "upper face of the highest particle on the beach");
}

/* Free surface over x/d (seaward, as in the laboratory) at a time in sqrt(d/g); the beach where there is no water. */
static sb_curve *surface(const sb_case_run *run, double time)
{
    const sb_scene *scene = run->scene;
    double depth = scene->wave.depth, t = time * sqrt(depth / scene->fluid.gravity);
    sb_curve *eta = sb_curve_new(run->made);
    for (size_t g = scene->measure.gauge_count; g-- > 0;) {
        const sb_gauge *gauge = &scene->measure.gauges[g];
        double beach = fmax(gauge->x / COTANGENT, -depth);
        double level = sb_curve_at(sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m"), t);
        sb_curve_add(eta, -gauge->x / depth, (isnan(level) ? beach : level) / depth);
    }
    return eta;
}

static sb_curve *measured_surface(const sb_case_run *run, const char *time)
{
    return sb_reference_curve(run, "solitary-runup/profiles.csv", time, "x", "eta");
}

static void figure_profile(const sb_case_run *run, const char *time, sb_figures *figures)
{
    char quantity[SB_FIGURE_TEXT];
    double height = run->scene->wave.height / run->scene->wave.depth;
    const sb_curve *ours = surface(run, strtod(time, NULL)), *lab = measured_surface(run, time);
    snprintf(quantity, sizeof quantity, "profile at t sqrt(g/d) = %s, RMS", time);
    sb_figure_below(figures, quantity, "%", 100 * sb_curve_rms_difference(ours, lab, -HUGE_VAL, HUGE_VAL) / height, 10,
                    "relative to H; at %zu measured places, x/d from %.1f to %.1f", lab->count, sb_curve_x(lab, 0),
                    sb_curve_x(lab, lab->count - 1));
}

static void evaluate_breaking(const sb_case_run *run, sb_figures *figures)
{
    figure_runup(run, 10, figures);
    for (int i = 0; i < TIMES; i++) figure_profile(run, times[i], figures);
}

static void evaluate_nonbreaking(const sb_case_run *run, sb_figures *figures)
{
    figure_runup(run, 15, figures);
}

static void plot_profile(const sb_case_run *runs, size_t count, const char *time, sb_plot *plot)
{
    char title[64];
    double x[] = {-8, 0}, y[] = {8 / COTANGENT, 0};
    snprintf(title, sizeof title, "Free surface at t sqrt(g/d) = %s", time);
    sb_plot_panel(plot, title, "x/d, seaward of the still shoreline", "eta/d");
    sb_plot_range(plot, -8, 20, -0.05, 0.45);
    sb_plot_points(plot, "beach", 2, x, y);
    sb_plot_curve(plot, SB_PLOT_POINTS, "laboratory", measured_surface(&runs[0], time));
    for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], surface(&runs[i], strtod(time, NULL)));
}

/* The laboratory's run-up is a level with the range of its runs. */
static void plot_runup(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const char *const which[] = {"least", "greatest", "runup"};
    const sb_initial_wave *wave = &runs[0].scene->wave;
    double x[] = {0, runs[0].scene->duration}, y[3][2];
    sb_curve level[3];
    for (int k = 0; k < 3; k++) {
        y[k][0] = y[k][1] = laboratory(&runs[0], which[k], wave->height / wave->depth);
        level[k] = (sb_curve){.count = 2, .x = x, .y = y[k]};
    }
    sb_plot_panel(plot, "Shoreline: the beach's height below the foremost water", "time (s)", "over d");
    sb_plot_band(plot, "laboratory, range", &level[0], &level[1]);
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "laboratory", &level[2]);
    for (size_t i = 0; i < count; i++) {
        sb_curve *front = front_of(&runs[i]);
        sb_curve_map(front, 1, 0, 1 / (COTANGENT * wave->depth), -OFFSET / (COTANGENT * wave->depth));
        sb_plot_run(plot, &runs[i], front);
    }
}

static void plot_breaking(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    plot_runup(runs, count, plot);
    for (int i = 0; i < TIMES; i++) plot_profile(runs, count, times[i], plot);
}

/* A wave of H/d = 0.1 is enough particles high in a cheap run. */
static const char *const higher[] = {"water.wave.height=0.1", "water.wave.position=-27.8039", "domain.min=[-40, -1]",
                                     "duration=18.5", NULL};

const sb_case sb_case_runup_breaking = {
    .name = "runup-breaking",
    .title = "Solitary wave that breaks on a beach, H/d = 0.3",
    .targets =
        "run-up: within 10 % of the laboratory; profiles at t sqrt(g/d) = 15, 20, 25, 30: RMS difference at most "
        "10 % of H",
    .method =
        "Reference: laboratory, Synolakis (1987), beach 1:19.85. The run-up is interpolated between groups of runs "
        "near H/d = 0.3;\nprofiles are in bins of 0.25 d. The clock begins as in the laboratory, when the crest is "
        "arccosh(sqrt(20))/sqrt(0.75 H/d)\ndepths before the toe; no time shift. d = 1 m, with the viscosity scaled "
        "to the laboratory's Reynolds number. Gauges are\n0.125 m apart; no filter. Where the simulation is dry, the "
        "surface is the beach.",
    .scene = "solitary-runup/breaking.yaml",
    .headline = "run-up R/d",
    .full = {{.resolution = 0.06, .paper = true},
             {.resolution = 0.03, .paper = true},
             {.resolution = 0.02, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.05, .judged = true}},
    .evaluate = evaluate_breaking,
    .plot = plot_breaking};

const sb_case sb_case_runup_nonbreaking = {
    .name = "runup-nonbreaking",
    .title = "Solitary wave that runs up a beach without breaking, H/d = 0.04",
    .targets = "run-up: within 15 % of the laboratory at 4 to 5 particles per wave height",
    .method =
        "Reference: laboratory, Synolakis (1987), beach 1:19.85, interpolated between groups of runs near H/d = "
        "0.04. d = 1 m, with\nthe viscosity scaled to the laboratory's Reynolds number. No filter, no time shift. "
        "The quick form has H/d = 0.1, a wave that\njust breaks. The preset `paper` runs only at the coarsest "
        "spacing, which takes one and a half hours of one thread; the\nnext spacing would take five.",
    .scene = "solitary-runup/nonbreaking.yaml",
    .headline = "run-up R/d",
    /* The preset `paper` at the second spacing would take about five hours of one thread. */
    .full = {{.resolution = 0.02, .paper = true, .seeds = 3},
             {.resolution = 0.0133},
             {.resolution = 0.01, .judged = true}},
    .quick = {{.resolution = 0.05, .judged = true, .settings = higher}},
    .evaluate = evaluate_nonbreaking,
    .plot = plot_runup};

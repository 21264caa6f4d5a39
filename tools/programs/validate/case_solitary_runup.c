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
static sb_status laboratory(const sb_case_run *run, const char *which, double height, double *runup, sb_error *error)
{
    sb_curve table = {0};
    sb_status status = sb_reference_curve(run, "solitary-runup/runup.csv", NULL, "height", which, &table, error);
    for (size_t i = 0; i < table.count; i++) {
        table.x[i] = log(table.x[i]);
        table.y[i] = log(table.y[i]);
    }
    *runup = exp(sb_curve_at(&table, log(height)));
    sb_curve_free(&table);
    return status;
}

static sb_status figure_runup(const sb_case_run *run, double limit, sb_figures *figures, sb_error *error)
{
    const sb_initial_wave *wave = &run->scene->wave;
    sb_curve front = {0}, top = {0};
    double height = wave->height / wave->depth, measured = (double)NAN;
    double law = height > 0.045 ? 1.109 * pow(height, 0.582) : 2.831 * sqrt(COTANGENT) * pow(height, 1.25);
    sb_status status = laboratory(run, "runup", height, &measured, error);
    if (status == SB_OK) status = sb_run_curve(run, "runup.csv", "beach", "time_s", "front_m", &front, error);
    if (status == SB_OK) status = sb_run_curve(run, "runup.csv", "beach", "time_s", "z_m", &top, error);
    if (status == SB_OK) {
        size_t far = sb_curve_highest(&front, 0, HUGE_VAL), high = sb_curve_highest(&top, 0, HUGE_VAL);
        double reached = (front.y[far] - OFFSET) / COTANGENT / wave->depth;
        status = sb_figure_share(figures, "run-up R/d", "", measured, reached, measured, limit, error,
                                 "height of the beach at the front of the connected water, at t sqrt(g/d) = %.1f, for "
                                 "H/d = %g; the run-up law gives %.3f",
                                 front.x[far] * sqrt(run->scene->fluid.gravity / wave->depth), height, law);
        if (status == SB_OK)
            status = sb_figure_report(figures, "highest water over d", "", measured, top.y[high] / wave->depth, error,
                                      "upper face of the highest particle on the beach");
    }
    sb_curve_free(&front);
    sb_curve_free(&top);
    return status;
}

/* Free surface over x/d (seaward, as in the laboratory) at a time in sqrt(d/g); the beach where there is no water. */
static sb_status surface(const sb_case_run *run, double time, sb_curve *eta, sb_error *error)
{
    const sb_scene *scene = run->scene;
    double depth = scene->wave.depth, t = time * sqrt(depth / scene->fluid.gravity);
    sb_curve made = {0};
    sb_status status = SB_OK;
    for (size_t g = scene->measure.gauge_count; status == SB_OK && g-- > 0;) {
        const sb_gauge *gauge = &scene->measure.gauges[g];
        sb_curve series = {0};
        status = sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m", &series, error);
        double beach = fmax(gauge->x / COTANGENT, -depth), level = sb_curve_at(&series, t);
        if (isnan(level)) level = beach;
        sb_curve_free(&series);
        if (status == SB_OK) status = sb_curve_add(&made, -gauge->x / depth, level / depth, error);
    }
    if (status != SB_OK)
        sb_curve_free(&made);
    else
        *eta = made;
    return status;
}

static sb_status figure_profile(const sb_case_run *run, const char *time, sb_figures *figures, sb_error *error)
{
    char quantity[SB_FIGURE_TEXT];
    sb_curve ours = {0}, lab = {0};
    double height = run->scene->wave.height / run->scene->wave.depth;
    sb_status status = surface(run, strtod(time, NULL), &ours, error);
    if (status == SB_OK) status = sb_reference_curve(run, "solitary-runup/profiles.csv", time, "x", "eta", &lab, error);
    snprintf(quantity, sizeof quantity, "profile at t sqrt(g/d) = %s, RMS", time);
    if (status == SB_OK)
        status = sb_figure_below(figures, quantity, "%",
                                 100 * sb_curve_rms_difference(&ours, &lab, -HUGE_VAL, HUGE_VAL) / height, 10, error,
                                 "relative to H; at %zu measured places, x/d from %.1f to %.1f", lab.count,
                                 lab.count ? lab.x[0] : 0, lab.count ? lab.x[lab.count - 1] : 0);
    sb_curve_free(&ours);
    sb_curve_free(&lab);
    return status;
}

static sb_status evaluate_breaking(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_status status = figure_runup(run, 10, figures, error);
    for (int i = 0; status == SB_OK && i < TIMES; i++) status = figure_profile(run, times[i], figures, error);
    return status;
}

static sb_status evaluate_nonbreaking(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    return figure_runup(run, 15, figures, error);
}

static sb_status plot_profile(const sb_case_run *runs, size_t count, const char *time, sb_plot *plot, sb_error *error)
{
    char title[64];
    sb_curve lab = {0};
    snprintf(title, sizeof title, "Free surface at t sqrt(g/d) = %s", time);
    sb_status status = sb_plot_panel(plot, title, "x/d, seaward of the still shoreline", "eta/d", error);
    if (status == SB_OK) sb_plot_range(plot, -8, 20, -0.05, 0.45);
    double x[] = {-8, 0}, y[] = {8 / COTANGENT, 0};
    if (status == SB_OK)
        status = sb_plot_curve(plot, SB_PLOT_REFERENCE, "beach", &(sb_curve){.count = 2, .x = x, .y = y}, error);
    if (status == SB_OK)
        status = sb_reference_curve(&runs[0], "solitary-runup/profiles.csv", time, "x", "eta", &lab, error);
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_POINTS, "laboratory", &lab, error);
    sb_curve_free(&lab);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_curve ours = {0};
        status = surface(&runs[i], strtod(time, NULL), &ours, error);
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &ours, error);
        sb_curve_free(&ours);
    }
    return status;
}

/* Plots the laboratory's run-up as a level with the range of its runs. level: least, greatest, mean. */
static sb_status plot_level(sb_plot *plot, double end, const double level[3], sb_error *error)
{
    double x[] = {0, end}, y[3][2];
    sb_curve curve[3];
    for (int k = 0; k < 3; k++) {
        y[k][0] = y[k][1] = level[k];
        curve[k] = (sb_curve){.count = 2, .x = x, .y = y[k]};
    }
    const sb_status status = sb_plot_band(plot, "laboratory, range", &curve[0], &curve[1], error);
    return status == SB_OK ? sb_plot_curve(plot, SB_PLOT_REFERENCE, "laboratory", &curve[2], error) : status;
}

static sb_status plot_runup(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    static const char *const which[] = {"least", "greatest", "runup"};
    double measured[3], end = runs[0].scene->duration;
    const sb_initial_wave *wave = &runs[0].scene->wave;
    sb_status status =
        sb_plot_panel(plot, "Shoreline: the beach's height below the foremost water", "time (s)", "over d", error);
    for (int k = 0; status == SB_OK && k < 3; k++)
        status = laboratory(&runs[0], which[k], wave->height / wave->depth, &measured[k], error);
    if (status == SB_OK) status = plot_level(plot, end, measured, error);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_curve front = {0};
        status = sb_run_curve(&runs[i], "runup.csv", "beach", "time_s", "front_m", &front, error);
        sb_curve_map(&front, 1, 0, 1 / (COTANGENT * wave->depth), -OFFSET / (COTANGENT * wave->depth));
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &front, error);
        sb_curve_free(&front);
    }
    return status;
}

static sb_status plot_breaking(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    sb_status status = plot_runup(runs, count, plot, error);
    for (int i = 0; status == SB_OK && i < TIMES; i++) status = plot_profile(runs, count, times[i], plot, error);
    return status;
}

static const sb_plan breaking_full[] = {{.resolution = 0.06, .paper = true},
                                        {.resolution = 0.03, .paper = true},
                                        {.resolution = 0.02, .judged = true, .seeds = 3},
                                        {.resolution = 0}};
static const sb_plan breaking_quick[] = {{.resolution = 0.05, .judged = true}, {.resolution = 0}};

/* The preset `paper` at the second spacing would take about five hours of one thread. */
static const sb_plan nonbreaking_full[] = {{.resolution = 0.02, .paper = true, .seeds = 3},
                                           {.resolution = 0.0133},
                                           {.resolution = 0.01, .judged = true},
                                           {.resolution = 0}};
/* A wave of H/d = 0.1 is enough particles high in a cheap run. */
static const char *const higher[] = {"water.wave.height=0.1", "water.wave.position=-27.8039", "domain.min=[-40, -1]",
                                     "duration=18.5", NULL};
static const sb_plan nonbreaking_quick[] = {{.resolution = 0.05, .judged = true, .settings = higher},
                                            {.resolution = 0}};

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
    .full = breaking_full,
    .quick = breaking_quick,
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
    .full = nonbreaking_full,
    .quick = nonbreaking_quick,
    .evaluate = evaluate_nonbreaking,
    .plot = plot_runup};

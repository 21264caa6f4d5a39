/* Ebb and flood, and rest, over an uneven bed beside a side of kind sea. */
#include "cases.h"
#include "channel.h"

#include <math.h>
#include <stdio.h>

static const double SMOOTH = 3;  /* s; running mean of surfaces and volumes */
static const double STILL = 0.4; /* s; the mean of the first readings, before the tide comes, is the still surface */

/* The bed of tide.yaml. */
static double bed(double x)
{
    if (x >= 4.2 && x <= 4.6) return 0.45;
    return fmin(fmax(0.12 * (x - 1), 0), 0.3);
}

/* The amplitude of the tide at the wall: twice that of the table. */
static double amplitude_of(const sb_curve *surface)
{
    return 2 * sb_curve_y(surface, sb_curve_highest(surface, 0, HUGE_VAL));
}

static sb_curve *rise(const sb_case_run *run, const char *gauge)
{
    sb_curve *eta = sb_run_curve(run, "gauges.csv", gauge, "time_s", "z_m");
    sb_curve_map(eta, 1, 0, 1, -sb_curve_mean(eta, 0, STILL));
    return sb_curve_mean_filter(run->made, eta, SMOOTH);
}

/* Volume of the water above that at the start, m^2. */
static sb_curve *volume(const sb_case_run *run)
{
    sb_curve *mass = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg");
    sb_curve_map(mass, 1, 0, 1 / run->scene->fluid.density, -sb_curve_first(mass) / run->scene->fluid.density);
    return sb_curve_mean_filter(run->made, mass, SMOOTH);
}

static double still_volume(const sb_case_run *run)
{
    return sb_curve_first(sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg")) / run->scene->fluid.density;
}

/* Reference: elevation at a gauge, and volume. */
static void solve(const sb_case_run *run, double x, sb_curve *eta, sb_curve *above)
{
    const sb_channel channel = {.length = run->scene->domain.max.x,
                                .level = run->scene->sea.level,
                                .gravity = run->scene->fluid.gravity,
                                .bed = bed,
                                .surface = sb_reference_curve(run, "sea/tide.csv", NULL, "t", "eta"),
                                .velocity = sb_reference_curve(run, "sea/tide.csv", NULL, "t", "u")};
    if (channel.surface->count > 1) sb_channel_solve(&channel, run->scene->duration, 0.25, x, eta, above);
}

static void evaluate_tide(const sb_case_run *run, sb_figures *figures)
{
    const double amplitude = amplitude_of(sb_reference_curve(run, "sea/tide.csv", NULL, "t", "eta"));
    double worst = 0, mean = 0;
    sb_curve *above = NULL;
    for (size_t g = 0; g < run->scene->measure.gauge_count; g++) {
        const sb_gauge *gauge = &run->scene->measure.gauges[g];
        sb_curve *eta = sb_curve_new(run->made);
        above = sb_curve_new(run->made);
        solve(run, gauge->x, eta, above);
        const sb_curve *own = rise(run, gauge->name);
        worst = fmax(worst, sb_curve_rms_difference(own, eta, STILL, HUGE_VAL));
        mean += (sb_curve_mean(own, STILL, HUGE_VAL) - sb_curve_mean(eta, STILL, HUGE_VAL)) /
                (double)run->scene->measure.gauge_count;
    }
    const sb_curve *own = volume(run);
    sb_figure_below(
        figures, "level, RMS difference, worst gauge", "%", 100 * worst / amplitude, 0.5,
        "of the amplitude at the wall, %g m; running mean over %g s; the still surface of a gauge is the mean "
        "of its first %g s",
        amplitude, SMOOTH, STILL);
    sb_figure_report(figures, "level, mean difference", "%", 0, 100 * mean / amplitude,
                     "of the amplitude; mean of the gauges, over all periods");
    sb_figure_below(
        figures, "volume, RMS difference", "%",
        100 * sb_curve_rms_difference(own, above, STILL, HUGE_VAL) / still_volume(run), 0.1,
        "of the still volume; volume of the particles less that at the start, against that of the reference");
    sb_figure_report(figures, "volume, at the end", "%", 0, 100 * sb_curve_last(own) / still_volume(run),
                     "of the still volume, after whole periods");
}

/* Drift: the line through the readings, over the whole run. */
static double drift(const sb_curve *curve, double duration)
{
    double a, b;
    return sb_curve_line(curve, STILL, HUGE_VAL, &a, &b) ? b * duration : (double)NAN;
}

static void evaluate_rest(const sb_case_run *run, sb_figures *figures)
{
    const double amplitude = amplitude_of(sb_reference_curve(run, "sea/tide.csv", NULL, "t", "eta"));
    const double volume_still = still_volume(run),
                 kinetic = sb_curve_mean(sb_run_curve(run, "energy.csv", NULL, "time_s", "kinetic_J"),
                                         0.5 * run->scene->duration, HUGE_VAL);
    double worst = 0;
    for (size_t g = 0; g < run->scene->measure.gauge_count; g++)
        worst = fmax(worst, fabs(drift(rise(run, run->scene->measure.gauges[g].name), run->scene->duration)));
    const sb_curve *own = volume(run);
    sb_figure_below(figures, "level, drift, worst gauge", "%", 100 * worst / amplitude, 0.5,
                    "line through the surface times the duration, over the amplitude of the case sea-tide, %g m",
                    amplitude);
    sb_figure_below(figures, "volume, drift", "%", 100 * fabs(drift(own, run->scene->duration)) / volume_still, 0.1,
                    "line through the volume of the particles times the duration, over the still volume");
    sb_figure_report(figures, "speed, root mean square", "% of sqrt(g h)", 0,
                     100 * sqrt(2 * kinetic / (volume_still * run->scene->fluid.density) /
                                (run->scene->fluid.gravity * run->scene->sea.level)),
                     "over the second half of the run");
}

static void plot_tide(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    for (size_t g = 0; g < runs[0].scene->measure.gauge_count; g++) {
        const sb_gauge *gauge = &runs[0].scene->measure.gauges[g];
        sb_curve *eta = sb_curve_new(runs[0].made), *above = sb_curve_new(runs[0].made);
        solve(&runs[0], gauge->x, eta, above);
        sb_plot_panel(plot, gauge->name, "time (s)", "m");
        sb_plot_curve(plot, SB_PLOT_REFERENCE, "shallow-water equations", eta);
        for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], rise(&runs[i], gauge->name));
    }
}

static void plot_rest(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    for (size_t g = 0; g < runs[0].scene->measure.gauge_count; g++) {
        const sb_gauge *gauge = &runs[0].scene->measure.gauges[g];
        sb_plot_panel(plot, gauge->name, "time (s)", "m");
        for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], rise(&runs[i], gauge->name));
    }
}

static const char *const one_period[] = {"duration=63.9", NULL}, *const two_periods[] = {"duration=127.7", NULL};

const sb_case sb_case_sea_tide = {
    .name = "sea-tide",
    .title = "Three periods of ebb and flood over an uneven bed",
    .targets = "level: RMS difference at most 0.5 % of the amplitude; volume: at most 0.1 % of the still volume",
    .method = "Reference: shallow-water equations over the same bed, solved on 120 cells, with the same wave. The wave "
              "has a period "
              "of\n200 sqrt(h/g) and comes in through the side x_min as a table; its amplitude is 0.15 m, twice that "
              "at the wall. "
              "h = 1 m; the bed\nrises to 0.3 m and has a bar of 0.45 m.",
    .scene = "sea/tide.yaml",
    .headline = "level, RMS difference, worst gauge",
    .full = {{.resolution = 0.1, .seeds = 3},
             {.resolution = 0.05},
             {.resolution = 0.025, .judged = true},
             {.resolution = 0.0125}},
    .quick = {{.resolution = 0.1, .judged = true, .settings = one_period}},
    .evaluate = evaluate_tide,
    .plot = plot_tide};

const sb_case sb_case_sea_rest = {
    .name = "sea-rest",
    .title = "Twenty such periods at rest",
    .targets = "level: drift at most 0.5 % of the amplitude of sea-tide; volume: drift at most 0.1 %",
    .method = "Still water beside a side of kind sea, over the bed of sea-tide, for twenty periods of 200 sqrt(h/g). "
              "The quick form "
              "has two periods.",
    .scene = "sea/rest.yaml",
    .headline = "level, drift, worst gauge",
    .full = {{.resolution = 0.1, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.1, .judged = true, .settings = two_periods}},
    .evaluate = evaluate_rest,
    .plot = plot_rest};

/* A solitary wave from a depth-averaged grid into the particles, and back. */
#include "cases.h"
#include "sea_case.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double STILL = 0.5;      /* s; the mean of a gauge's first readings is its still surface */
static const double HALF_WIDTH = 0.2; /* s; of the parabola at a crest */
static const double SMOOTH = 0.3;     /* s; running mean of what is left over */

typedef struct sides {
    bool both; /* waves that leave the particles continue in the grid */
} sides;

static const char *const within[] = {"g1", "g2", "g3", "g4", "g5", NULL}, *const outside[] = {"out1", "out2", "out3",
                                                                                              NULL};

/* Elevation over the still surface: that of the particles is the mean of the first readings, that of the grid is exact.
 */
static sb_curve *rise(const sb_case_run *run, const char *gauge)
{
    sb_curve *eta = sb_run_curve(run, "gauges.csv", gauge, "time_s", "z_m");
    const double still = gauge[0] == 'o' ? run->scene->sea.level : sb_curve_mean(eta, 0, STILL);
    sb_curve_map(eta, 1, 0, 1, -still);
    return eta;
}

/* Time at which the wave is at the wall: half way between its passages of x = 0 by its celerity. */
static double turn(const sb_scene *scene)
{
    const sb_initial_wave *wave = &scene->offshore.wave;
    const double celerity = sqrt(scene->fluid.gravity * (wave->depth + wave->height));
    return (scene->domain.max.x - wave->position) / celerity;
}

static double crest(const sb_case_run *run, const char *const *gauges, double first, double last)
{
    double sum = 0, count = 0;
    for (; *gauges; gauges++, count++) sum += sb_curve_peak(rise(run, *gauges), first, last, HALF_WIDTH).y;
    return sum / count;
}

/* Largest change of the surface in the particles when the reflected wave's crest is 10 depths outside. */
static double left_over(const sb_case_run *run)
{
    const sb_scene *scene = run->scene;
    const double celerity = sqrt(scene->fluid.gravity * (scene->offshore.wave.depth + scene->offshore.wave.height));
    const double from = turn(scene) + (scene->domain.max.x + 8) / celerity;
    double sum = 0, count = 0;
    for (const char *const *g = within; *g; g++, count++) {
        const sb_curve *eta = sb_curve_mean_filter(run->made, rise(run, *g), SMOOTH);
        sum += fmax(fabs(sb_curve_y(eta, sb_curve_highest(eta, from, HUGE_VAL))),
                    fabs(sb_curve_y(eta, sb_curve_lowest(eta, from, HUGE_VAL))));
    }
    return sum / count;
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const double height = run->scene->offshore.wave.height, middle = turn(run->scene);
    const bool both = ((const sides *)run->of->what)->both;
    sb_figure_share(
        figures, "height in the particles", "m", height, crest(run, within, 0, middle - 1), height, 2,
        "mean of the crests at five gauges 2.5 to 5 depths from the side, before the wall reflects the wave");
    if (both) {
        const double in = crest(run, outside, 0, middle), out = crest(run, outside, middle, HUGE_VAL);
        sb_figure_share(
            figures, "height in the grid after it has left", "m", in, out, in, 2,
            "mean of the crests 6, 8 and 10 depths outside of the side, against those of the wave that came in");
    }
    sb_figure_below(figures, "left over", "% of H", 100 * left_over(run) / height, 2,
                    "largest change of the surface in the particles after the wave has left; running mean over %g s",
                    SMOOTH);
    const sb_curve *mass = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg");
    sb_figure_below(figures, "volume of the particles at the end", "%",
                    100 * fabs(sb_curve_last(mass) / sb_curve_first(mass) - 1), 0.1,
                    "change since the start; the wave has left again");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const char *const shown[] = {"out2", "g3", NULL};
    for (const char *const *gauge = shown; *gauge; gauge++) {
        sb_plot_panel(plot, *gauge, "time (s)", "m");
        for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], rise(&runs[i], *gauge));
    }
}

#define METHOD                                                                                                         \
    "Reference: the wave of the Serre-Green-Naghdi equations, H/h = 0.2, in the grid. It enters the particles at x = " \
    "0, is "                                                                                                           \
    "reflected by\na wall 12 depths from there, and leaves. h = 1 m, cells of 0.1 m, no friction. "
#define TARGETS "height and what is left over: within 2 % of H; volume: 0.1 %"

static const char *const both_ways[] = {"offshore.coupling=two-way", NULL};
static const char *const without_wall[] = {"offshore.coupling=two-way", "offshore.max=[40]", NULL};

const sb_case sb_case_sea_nested = {.name = "sea-nested",
                                    .title = "Solitary wave from a grid into the particles",
                                    .targets = TARGETS,
                                    .method = METHOD "The coupling is one-way.",
                                    .scene = "sea/nested.yaml",
                                    .headline = "height in the particles",
                                    SB_SEA_RUNS(NULL),
                                    .what = &(const sides){.both = false},
                                    .evaluate = evaluate,
                                    .plot = plot};

const sb_case sb_case_sea_two_way = {.name = "sea-two-way",
                                     .title = "Solitary wave from a grid into the particles and back into the grid",
                                     .targets = TARGETS,
                                     .method = METHOD "The coupling is two-way; the grid has the same wall.",
                                     .scene = "sea/nested.yaml",
                                     .headline = "height in the grid after it has left",
                                     SB_SEA_RUNS(both_ways),
                                     .what = &(const sides){.both = true},
                                     .evaluate = evaluate,
                                     .plot = plot};

const sb_case sb_case_sea_two_way_unknown = {
    .name = "sea-two-way-unknown",
    .title = "The same, with a wall that the grid does not have",
    .targets = TARGETS,
    .method = METHOD
    "The coupling is two-way; in the grid the wave goes on, so that all of what\nthe wall reflects is unknown to it.",
    .scene = "sea/nested.yaml",
    .headline = "height in the grid after it has left",
    SB_SEA_RUNS(without_wall),
    .what = &(const sides){.both = true},
    .evaluate = evaluate,
    .plot = plot};

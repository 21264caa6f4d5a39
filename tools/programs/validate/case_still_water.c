/* Water at rest: a slice, a cube, and a basin with slope, stairs, pillar and pocket. */
#include "cases.h"
#include "still_pressure.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* s; means begin here. */
static const double START = 1;

static sb_curve *column_of(const sb_case_run *run, const char *column)
{
    return sb_run_curve(run, "energy.csv", NULL, "time_s", column);
}

/* Upward reaction of all bodies relative to the water's weight, -sum Fz / (M g), over time. */
static sb_curve *reaction(const sb_case_run *run)
{
    const sb_scene *scene = run->scene;
    sb_curve *total = sb_curve_new(run->made);
    for (size_t b = 0; b < scene->body_count; b++)
        sb_curve_sum(total, sb_run_curve(run, "forces.csv", scene->bodies[b].name, "time_s", "Fz_N"));
    sb_curve_map(total, 1, 0, -1 / (scene->fluid.gravity * sb_curve_first(column_of(run, "mass_kg"))), 0);
    return total;
}

static void figure_level(const sb_case_run *run, sb_figures *figures)
{
    const sb_scene *scene = run->scene;
    double worst = 0;
    const char *name = "";
    for (size_t g = 0; g < scene->measure.gauge_count; g++) {
        const sb_curve *eta = sb_run_curve(run, "gauges.csv", scene->measure.gauges[g].name, "time_s", "z_m");
        double miss = sb_curve_mean(eta, START, HUGE_VAL) - scene->sea.level;
        if (!isnan(worst) && !(fabs(miss) <= fabs(worst))) { /* a gauge without a value stays the worst */
            worst = miss;
            name = scene->measure.gauges[g].name;
        }
    }
    sb_figure_below(figures, "level, worst gauge", "spacings", fabs(worst) / scene->resolution, 0.5,
                    "mean after %g s minus still-water level: %+.4f m at gauge %s", START, worst, name);
}

static void figure_energy(const sb_case_run *run, sb_figures *figures)
{
    const double half = 0.5 * run->scene->duration;
    const sb_curve *kinetic = column_of(run, "kinetic_J");
    double before = sb_curve_mean(kinetic, START, half), after = sb_curve_mean(kinetic, half, HUGE_VAL);
    double speed = sqrt(2 * after / sb_curve_first(column_of(run, "mass_kg")));
    double celerity = sqrt(run->scene->fluid.gravity * sb_still_depth(run->scene));
    sb_figure_below(figures, "kinetic energy, growth", "%", 100 * (after / before - 1), 5,
                    "mean of the second half relative to that of the first half after %g s, minus 1; two means of a "
                    "steady motion differ by some per cent",
                    START);
    sb_figure_report(figures, "speed, root mean square", "%", (double)NAN, 100 * speed / celerity,
                     "relative to sqrt(g D); second half of the run");
}

static void figure_force(const sb_case_run *run, sb_figures *figures)
{
    const sb_curve *share = reaction(run);
    sb_figure_share(figures, "force on all bodies, mean", "weights", 1, sb_curve_mean(share, START, HUGE_VAL), 1, 0.2,
                    "upward reaction of the tank and all bodies in it, relative to the weight of all particles; mean "
                    "after %g s",
                    START);
    sb_figure_below(figures, "force on all bodies, standard deviation", "%",
                    100 * sb_curve_deviation(share, START, HUGE_VAL), 1,
                    "relative to the weight; from means over %g s, no filter", run->scene->measure.interval);
}

static void evaluate(const sb_case_run *run, double volume, sb_figures *figures)
{
    figure_force(run, figures);
    figure_energy(run, figures);
    sb_still_figures(run, figures);
    figure_level(run, figures);
    sb_figure_report(figures, "mass of water", run->scene->dimensions == 2 ? "kg/m" : "kg",
                     run->scene->fluid.density * volume, sb_curve_last(column_of(run, "mass_kg")),
                     "at the end of the run");
}

static void evaluate_tank(const sb_case_run *run, sb_figures *figures)
{
    evaluate(run, 1, figures); /* 1 m x (1 m x) 1 m */
}

/* Volume of basin.yaml: the tank minus stairs, pillar, walls of the pocket and slope. */
static void evaluate_basin(const sb_case_run *run, sb_figures *figures)
{
    double volume = 3 * 0.6 - 0.2 * (0.45 + 0.3 + 0.15) - M_PI * 0.12 * 0.12 * 0.6 - 2 * 0.2 * 0.4 * 0.45 -
                    (0.75 * 0.6 / 2 + 0.25 * 0.6);
    evaluate(run, volume, figures);
}

static void plot_smooth(const sb_case_run *run, const sb_curve *curve, sb_plot *plot)
{
    sb_plot_run(plot, run, sb_curve_mean_filter(run->made, curve, 0.5));
}

static void draw(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    double end = runs[0].scene->duration, depth = sb_still_depth(runs[0].scene);
    sb_plot_panel(plot, "Force on all bodies, 0.5 s running mean", "time (s)", "over the weight");
    sb_plot_points(plot, "the weight", 2, (double[]){0, end}, (double[]){1, 1});
    for (size_t i = 0; i < count; i++) plot_smooth(&runs[i], reaction(&runs[i]), plot);
    sb_plot_panel(plot, "Kinetic energy, 0.5 s running mean", "time (s)", runs[0].scene->dimensions == 2 ? "J/m" : "J");
    for (size_t i = 0; i < count; i++) plot_smooth(&runs[i], column_of(&runs[i], "kinetic_J"), plot);
    sb_plot_panel(plot, "Pressure minus hydrostatic, means of layers over the second half",
                  "height above the floor (m)", "% of rho g D");
    sb_plot_points(plot, "hydrostatic", 2, (double[]){0, depth}, (double[]){0, 0});
    for (size_t i = 0; i < count; i++) sb_still_plot(&runs[i], plot);
}

#define TARGETS                                                                                                        \
    "force on all bodies: mean within 0.2 % of the weight, standard deviation at most 1 %; kinetic energy: does not "  \
    "grow; pressure at probes and in layers: within 1 % of rho g D; level: within half a spacing"
#define METHOD                                                                                                         \
    "Reference: hydrostatics. The water rests for 20 s, after the settling of the defaults. D is the still-water\n"    \
    "depth. The weight is that of all particles. Forces are summed over all bodies that touch water."

static const char *const shorter[] = {"duration=8", NULL};

const sb_case sb_case_still_water_flat = {.name = "still-water-2d",
                                          .title = "Still water in a slice of a tank",
                                          .targets = TARGETS,
                                          .method = METHOD,
                                          .scene = "still-water/flat.yaml",
                                          .headline = "force on all bodies, standard deviation",
                                          .full = {{.resolution = 0.1, .paper = true},
                                                   {.resolution = 0.05, .paper = true, .judged = true, .seeds = 3},
                                                   {.resolution = 0.025}},
                                          .quick = {{.resolution = 0.05, .judged = true}},
                                          .evaluate = evaluate_tank,
                                          .plot = draw};

const sb_case sb_case_still_water_box = {.name = "still-water-box",
                                         .title = "Still water in a cube",
                                         .targets = TARGETS,
                                         .method = METHOD,
                                         .scene = "still-water/box.yaml",
                                         .headline = "force on all bodies, standard deviation",
                                         .full = {{.resolution = 0.1, .paper = true},
                                                  {.resolution = 0.05, .paper = true, .judged = true, .seeds = 3},
                                                  {.resolution = 0.025}},
                                         .quick = {{.resolution = 0.1, .judged = true}},
                                         .evaluate = evaluate_tank,
                                         .plot = draw};

const sb_case sb_case_still_water_basin = {.name = "still-water-basin",
                                           .title = "Still water in a basin with slope, stairs, pillar and pocket",
                                           .targets = TARGETS,
                                           .method = METHOD,
                                           .scene = "still-water/basin.yaml",
                                           .headline = "force on all bodies, standard deviation",
                                           .full = {{.resolution = 0.1, .paper = true},
                                                    {.resolution = 0.05, .paper = true, .judged = true, .seeds = 3},
                                                    {.resolution = 0.025}},
                                           .quick = {{.resolution = 0.075, .judged = true, .settings = shorter}},
                                           .evaluate = evaluate_basin,
                                           .plot = draw};

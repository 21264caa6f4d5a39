/* Water at rest: a slice, a cube, and a basin with slope, stairs, pillar and pocket. */
#include "cases.h"
#include "still_pressure.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* s; means begin here. */
static const double START = 1;

/* Upward reaction of all bodies relative to the water's weight, -sum Fz / (M g), over time. */
static sb_status reaction(const sb_case_run *run, sb_curve *share, sb_error *error)
{
    const sb_scene *scene = run->scene;
    sb_curve mass = {0}, total = {0};
    sb_status status = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg", &mass, error);
    for (size_t b = 0; status == SB_OK && b < scene->body_count; b++) {
        sb_curve force = {0};
        status = sb_run_curve(run, "forces.csv", scene->bodies[b].name, "time_s", "Fz_N", &force, error);
        for (size_t i = 0; i < force.count && total.count; i++) total.y[i] += force.y[i];
        if (total.count)
            sb_curve_free(&force);
        else
            total = force;
    }
    if (status == SB_OK) {
        sb_curve_map(&total, 1, 0, -1 / (scene->fluid.gravity * mass.y[0]), 0);
        *share = total;
    } else
        sb_curve_free(&total);
    sb_curve_free(&mass);
    return status;
}

static sb_status figure_level(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    const sb_scene *scene = run->scene;
    double worst = 0;
    const char *name = "";
    for (size_t g = 0; g < scene->measure.gauge_count; g++) {
        sb_curve eta = {0};
        sb_status status = sb_run_curve(run, "gauges.csv", scene->measure.gauges[g].name, "time_s", "z_m", &eta, error);
        if (status != SB_OK) return status;
        double miss = sb_curve_mean(&eta, START, HUGE_VAL) - scene->sea.level;
        sb_curve_free(&eta);
        if (!isnan(worst) && !(fabs(miss) <= fabs(worst))) { /* a gauge without a value stays the worst */
            worst = miss;
            name = scene->measure.gauges[g].name;
        }
    }
    return sb_figure_below(figures, "level, worst gauge", "spacings", fabs(worst) / scene->resolution, 0.5, error,
                           "mean after %g s minus still-water level: %+.4f m at gauge %s", START, worst, name);
}

static sb_status figure_energy(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_curve kinetic = {0}, mass = {0};
    double end = run->scene->duration, half = 0.5 * end;
    sb_status status = sb_run_curve(run, "energy.csv", NULL, "time_s", "kinetic_J", &kinetic, error);
    if (status == SB_OK) status = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg", &mass, error);
    if (status == SB_OK) {
        double before = sb_curve_mean(&kinetic, START, half);
        double after = sb_curve_mean(&kinetic, half, HUGE_VAL);
        double speed = sqrt(2 * after / mass.y[0]);
        double celerity = sqrt(run->scene->fluid.gravity * sb_still_depth(run->scene));
        status = sb_figure_below(
            figures, "kinetic energy, growth", "%", 100 * (after / before - 1), 5, error,
            "mean of the second half relative to that of the first half after %g s, minus 1; two means of "
            "a steady motion differ by some per cent",
            START);
        if (status == SB_OK)
            status = sb_figure_report(figures, "speed, root mean square", "%", (double)NAN, 100 * speed / celerity,
                                      error, "relative to sqrt(g D); second half of the run");
    }
    sb_curve_free(&kinetic);
    sb_curve_free(&mass);
    return status;
}

static sb_status figure_force(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_curve share = {0};
    sb_status status = reaction(run, &share, error);
    if (status != SB_OK) return status;
    double mean = sb_curve_mean(&share, START, HUGE_VAL);
    status = sb_figure_share(
        figures, "force on all bodies, mean", "weights", 1, mean, 1, 0.2, error,
        "upward reaction of the tank and all bodies in it, relative to the weight of all particles; mean "
        "after %g s",
        START);
    if (status == SB_OK)
        status = sb_figure_below(
            figures, "force on all bodies, standard deviation", "%", 100 * sb_curve_deviation(&share, START, HUGE_VAL),
            1, error, "relative to the weight; from means over %g s, no filter", run->scene->measure.interval);
    sb_curve_free(&share);
    return status;
}

static sb_status figure_mass(const sb_case_run *run, double volume, sb_figures *figures, sb_error *error)
{
    sb_curve mass = {0};
    sb_status status = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg", &mass, error);
    if (status != SB_OK) return status;
    double expected = run->scene->fluid.density * volume;
    status = sb_figure_report(figures, "mass of water", run->scene->dimensions == 2 ? "kg/m" : "kg", expected,
                              mass.y[mass.count - 1], error, "at the end of the run");
    sb_curve_free(&mass);
    return status;
}

static sb_status evaluate(const sb_case_run *run, double volume, sb_figures *figures, sb_error *error)
{
    sb_status status = figure_force(run, figures, error);
    if (status == SB_OK) status = figure_energy(run, figures, error);
    if (status == SB_OK) status = sb_still_figures(run, figures, error);
    if (status == SB_OK) status = figure_level(run, figures, error);
    return status == SB_OK ? figure_mass(run, volume, figures, error) : status;
}

static sb_status evaluate_tank(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    return evaluate(run, 1, figures, error); /* 1 m x (1 m x) 1 m */
}

/* Volume of basin.yaml: the tank minus stairs, pillar, walls of the pocket and slope. */
static sb_status evaluate_basin(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    double volume = 3 * 0.6 - 0.2 * (0.45 + 0.3 + 0.15) - M_PI * 0.12 * 0.12 * 0.6 - 2 * 0.2 * 0.4 * 0.45 -
                    (0.75 * 0.6 / 2 + 0.25 * 0.6);
    return evaluate(run, volume, figures, error);
}

static sb_status plot_force(const sb_case_run *run, sb_plot *plot, sb_error *error)
{
    sb_curve share = {0}, smooth = {0};
    sb_status status = reaction(run, &share, error);
    if (status == SB_OK) status = sb_curve_mean_filter(&share, 0.5, &smooth, error);
    if (status == SB_OK) status = sb_plot_run(plot, run, &smooth, error);
    sb_curve_free(&share);
    sb_curve_free(&smooth);
    return status;
}

static sb_status plot_energy(const sb_case_run *run, sb_plot *plot, sb_error *error)
{
    sb_curve kinetic = {0}, smooth = {0};
    sb_status status = sb_run_curve(run, "energy.csv", NULL, "time_s", "kinetic_J", &kinetic, error);
    if (status == SB_OK) status = sb_curve_mean_filter(&kinetic, 0.5, &smooth, error);
    if (status == SB_OK) status = sb_plot_run(plot, run, &smooth, error);
    sb_curve_free(&kinetic);
    sb_curve_free(&smooth);
    return status;
}

static sb_status plot_line(sb_plot *plot, const char *label, double x0, double x1, double y, sb_error *error)
{
    double x[] = {x0, x1}, values[] = {y, y};
    return sb_plot_curve(plot, SB_PLOT_REFERENCE, label, &(sb_curve){.count = 2, .x = x, .y = values}, error);
}

static sb_status draw(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    double end = runs[0].scene->duration, depth = sb_still_depth(runs[0].scene);
    sb_status status =
        sb_plot_panel(plot, "Force on all bodies, 0.5 s running mean", "time (s)", "over the weight", error);
    if (status == SB_OK) status = plot_line(plot, "the weight", 0, end, 1, error);
    for (size_t i = 0; status == SB_OK && i < count; i++) status = plot_force(&runs[i], plot, error);
    if (status == SB_OK)
        status = sb_plot_panel(plot, "Kinetic energy, 0.5 s running mean", "time (s)",
                               runs[0].scene->dimensions == 2 ? "J/m" : "J", error);
    for (size_t i = 0; status == SB_OK && i < count; i++) status = plot_energy(&runs[i], plot, error);
    if (status == SB_OK)
        status = sb_plot_panel(plot, "Pressure minus hydrostatic, means of layers over the second half",
                               "height above the floor (m)", "% of rho g D", error);
    if (status == SB_OK) status = plot_line(plot, "hydrostatic", 0, depth, 0, error);
    for (size_t i = 0; status == SB_OK && i < count; i++) status = sb_still_plot(&runs[i], plot, error);
    return status;
}

#define TARGETS                                                                                                        \
    "force on all bodies: mean within 0.2 % of the weight, standard deviation at most 1 %; kinetic energy: does not "  \
    "grow; pressure at probes and in layers: within 1 % of rho g D; level: within half a spacing"
#define METHOD                                                                                                         \
    "Reference: hydrostatics. The water rests for 20 s, after the settling of the defaults. D is the still-water\n"    \
    "depth. The weight is that of all particles. Forces are summed over all bodies that touch water."

static const sb_plan flat_full[] = {{.resolution = 0.1, .paper = true},
                                    {.resolution = 0.05, .paper = true, .judged = true, .seeds = 3},
                                    {.resolution = 0.025},
                                    {.resolution = 0}};
static const sb_plan flat_quick[] = {{.resolution = 0.05, .judged = true}, {.resolution = 0}};
static const sb_plan box_quick[] = {{.resolution = 0.1, .judged = true}, {.resolution = 0}};
static const char *const shorter[] = {"duration=8", NULL};
static const sb_plan basin_quick[] = {{.resolution = 0.075, .judged = true, .settings = shorter}, {.resolution = 0}};

const sb_case sb_case_still_water_flat = {.name = "still-water-2d",
                                          .title = "Still water in a slice of a tank",
                                          .targets = TARGETS,
                                          .method = METHOD,
                                          .scene = "still-water/flat.yaml",
                                          .headline = "force on all bodies, standard deviation",
                                          .full = flat_full,
                                          .quick = flat_quick,
                                          .evaluate = evaluate_tank,
                                          .plot = draw};

const sb_case sb_case_still_water_box = {.name = "still-water-box",
                                         .title = "Still water in a cube",
                                         .targets = TARGETS,
                                         .method = METHOD,
                                         .scene = "still-water/box.yaml",
                                         .headline = "force on all bodies, standard deviation",
                                         .full = flat_full,
                                         .quick = box_quick,
                                         .evaluate = evaluate_tank,
                                         .plot = draw};

const sb_case sb_case_still_water_basin = {.name = "still-water-basin",
                                           .title = "Still water in a basin with slope, stairs, pillar and pocket",
                                           .targets = TARGETS,
                                           .method = METHOD,
                                           .scene = "still-water/basin.yaml",
                                           .headline = "force on all bodies, standard deviation",
                                           .full = flat_full,
                                           .quick = basin_quick,
                                           .evaluate = evaluate_basin,
                                           .plot = draw};

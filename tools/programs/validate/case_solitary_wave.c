/* A solitary wave over fifty depths of still water. */
#include "cases.h"
#include "physics/waves/wave_theory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double FIRST = 10, LAST = 60; /* m; the wave is measured between these */
static const double STRETCH = 10;          /* m; length of the fits through heights at either end */
static const double HALF_WIDTH = 0.25;     /* s; of the parabola at a crest */

/* Finds the crests at the gauges: height above still water, and time, over x. */
static sb_curve *crests(const sb_case_run *run, bool times)
{
    sb_curve *found = sb_curve_new(run->made);
    const sb_scene *scene = run->scene;
    for (size_t g = 0; g < scene->measure.gauge_count; g++) {
        const sb_gauge *gauge = &scene->measure.gauges[g];
        const sb_curve *eta = sb_run_curve(run, "gauges.csv", gauge->name, "time_s", "z_m");
        sb_peak crest = sb_curve_peak(eta, 0, HUGE_VAL, HALF_WIDTH);
        sb_curve_add(found, gauge->x, times ? crest.x : crest.y - scene->sea.level);
    }
    return found;
}

/* Whether each crest is later than the one before. If the wave has decayed to noise, a line through the times of the
   crests gives no celerity. */
static bool travels(const sb_curve *times)
{
    for (size_t g = 1; g < times->count; g++)
        if (!(times->y[g] > times->y[g - 1])) return false;
    return times->count > 1;
}

static double line_at(const sb_curve *curve, double first, double last, double x)
{
    double a, b;
    return sb_curve_line(curve, first, last, &a, &b) ? a + b * x : (double)NAN;
}

/* Height at the start and at the end, and the height that Keulegan's damping leaves at the end. */
typedef struct journey {
    double first, last, damped, celerity; /* m, m, m, m/s */
    double leaves, arrives;               /* s */
} journey;

static journey follow(const sb_case_run *run)
{
    const sb_scene *scene = run->scene;
    const sb_curve *heights = crests(run, false), *times = crests(run, true);
    double a, b;
    journey j = {.first = line_at(heights, FIRST, FIRST + STRETCH, FIRST),
                 .last = line_at(heights, LAST - STRETCH, LAST, LAST),
                 .celerity = travels(times) && sb_curve_line(times, FIRST, LAST, &a, &b) ? 1 / b : (double)NAN,
                 .leaves = line_at(times, FIRST, FIRST + STRETCH, FIRST),
                 .arrives = line_at(times, LAST - STRETCH, LAST, LAST)};
    j.damped =
        sb_keulegan_height(j.first, scene->wave.depth, scene->fluid.viscosity, scene->fluid.gravity, LAST - FIRST);
    return j;
}

/* Energy of the wave by Boussinesq, J per metre of width: 8/(3 sqrt 3) rho g (H h)^1.5, half of it kinetic. */
static double wave_energy(const sb_scene *scene, double height)
{
    return 8 / (3 * sqrt(3.0)) * scene->fluid.density * scene->fluid.gravity * pow(height * scene->wave.depth, 1.5);
}

/* Change of a column of energy.csv while the wave travels from FIRST to LAST. */
static double change_of(const sb_case_run *run, const char *column, const journey *j)
{
    const sb_curve *curve = sb_run_curve(run, "energy.csv", NULL, "time_s", column);
    return sb_curve_at(curve, j->arrives) - sb_curve_at(curve, j->leaves);
}

static void figure_items(const sb_case_run *run, const journey *j, double energy, sb_figures *figures)
{
    const sb_sheet *sheet = sb_run_sheet(run, "energy.csv");
    for (size_t k = 0; k < sheet->columns; k++) {
        char name[SB_FIGURE_TEXT], quantity[SB_FIGURE_TEXT];
        if (!sb_energy_item(sheet, k, name)) continue;
        double change = change_of(run, sheet->fields[k], j);
        snprintf(quantity, sizeof quantity, "energy, item %.60s", name);
        sb_figure_report(figures, quantity, "%", (double)NAN, 100 * change / energy,
                         "relative to the wave's energy at x = %g m", FIRST);
    }
}

static void figure_energy(const sb_case_run *run, const journey *j, sb_figures *figures)
{
    double energy = wave_energy(run->scene, j->first), kinetic = change_of(run, "kinetic_J", j);
    double total = kinetic + change_of(run, "potential_J", j);
    sb_figure_report(figures, "energy, change over 50 depths", "%", (double)NAN, 100 * total / energy,
                     "kinetic and potential, relative to the wave's energy at x = %g m (%.0f J/m by theory "
                     "for its height); Keulegan: %.2f %%. A level lower by 0.001 depths changes it by a third "
                     "of the wave's energy",
                     FIRST, energy, 100 * (pow(j->damped / j->first, 1.5) - 1));
    sb_figure_report(figures, "kinetic energy, change over 50 depths", "%", (double)NAN, 200 * kinetic / energy,
                     "relative to half of that energy");
    sb_figure_report(figures, "energy, change by the loss of height", "%", (double)NAN,
                     100 * (pow(j->last / j->first, 1.5) - 1), "from the heights, for a wave with energy ~ H^1.5");
    figure_items(run, j, energy, figures);
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_scene *scene = run->scene;
    const journey j = follow(run);
    double unit = sqrt(scene->fluid.gravity * scene->wave.depth);
    sb_figure_share(figures, "celerity", "sqrt(g h)", 1.138, j.celerity / unit, 1.138, 1,
                    "line through the times of the crests at gauges every 2 m; no value if a crest is not later than "
                    "the one before");
    sb_figure_below(figures, "height loss beyond Keulegan", "%", 100 * (j.damped - j.last) / j.damped, 5,
                    "at x = %g m, from the height at %g m; lines through the crests of the first and last %g m", LAST,
                    FIRST, STRETCH);
    sb_figure_report(figures, "height at x = 10 m", "m", scene->wave.height, j.first,
                     "the initial wave, of third-order theory, is at x = %g m", scene->wave.position);
    sb_figure_report(figures, "height at x = 60 m", "m", j.damped, j.last,
                     "reference: Keulegan's damping for nu = %g m^2/s", scene->fluid.viscosity);
    figure_energy(run, &j, figures);
}

static double loss_of(const sb_figures *figures)
{
    return sb_figures_find(figures, "height loss beyond Keulegan")->value;
}

static void compare(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures)
{
    size_t f = count - 1;
    double ratio = runs[f - 1].resolution / runs[f].resolution;
    double pair = log(loss_of(&of_each[f - 1]) / loss_of(&of_each[f])) / log(ratio);
    sb_figure_report(figures, "order of convergence, two finest", "", (double)NAN, pair,
                     "of the height loss beyond Keulegan, which tends to 0");
    if (count < 3) return;
    double steps =
        (loss_of(&of_each[f - 2]) - loss_of(&of_each[f - 1])) / (loss_of(&of_each[f - 1]) - loss_of(&of_each[f]));
    sb_figure_report(figures, "order of convergence, three finest", "", (double)NAN, log(steps) / log(ratio),
                     "of the same loss with an unknown limit (Richardson); no value if its differences do not shrink");
}

static void plot_heights(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const sb_scene *scene = runs[0].scene;
    sb_curve *theory = sb_curve_new(runs[0].made);
    for (double x = FIRST; x <= LAST; x += 2)
        sb_curve_add(theory, x,
                     sb_keulegan_height(scene->wave.height, scene->wave.depth, scene->fluid.viscosity,
                                        scene->fluid.gravity, x - FIRST));
    sb_plot_panel(plot, "Height of the crest", "x (m)", "m");
    sb_plot_range(plot, FIRST, LAST, 0, 0.35);
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "Keulegan", theory);
    for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], crests(&runs[i], false));
}

/* Elevation at the last gauge, with each crest at time 0: the shape of the wave and its trailing waves. */
static void plot_shapes(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const sb_scene *scene = runs[0].scene;
    sb_solitary wave = {scene->wave.height, scene->wave.depth, scene->fluid.gravity, scene->wave.theory};
    double celerity = sb_solitary_celerity(&wave);
    sb_curve *theory = sb_curve_new(runs[0].made);
    for (int i = -60; i <= 40; i++) sb_curve_add(theory, 0.05 * i, sb_solitary_elevation(&wave, -0.05 * i * celerity));
    sb_plot_panel(plot, "Elevation at x = 60 m, each crest at 0", "time (s)", "m");
    sb_plot_range(plot, -3, 2, -0.05, 0.35);
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "third order, H = 0.3 m", theory);
    for (size_t i = 0; i < count; i++) {
        sb_curve *eta = sb_run_curve(&runs[i], "gauges.csv", "x60", "time_s", "z_m");
        sb_curve_map(eta, 1, -sb_curve_peak(eta, 0, HUGE_VAL, HALF_WIDTH).x, 1, -scene->sea.level);
        sb_plot_run(plot, &runs[i], eta);
    }
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    plot_heights(runs, count, plot);
    plot_shapes(runs, count, plot);
}

const sb_case sb_case_solitary_wave = {
    .name = "solitary-wave",
    .title = "Solitary wave over fifty depths",
    .targets = "celerity: within 1 % of 1.138 sqrt(g h); height loss beyond Keulegan: at most 5 % at 20 particles per "
               "wave height",
    .method =
        "Reference: celerity of the exact solitary wave of H/h = 0.3; damping by Keulegan (1948) for the viscosity "
        "of water,\n1e-6 m^2/s, which is taken off the loss. Walls have the friction of smooth ones. H = 0.3 m,\nh = 1 "
        "m, from x = 10 m to 60 m. A crest is a parabola through 0.5 s of a gauge's "
        "elevation; no other filter, no time shift.",
    .scene = "solitary-wave/solitary-wave.yaml",
    .headline = "height loss beyond Keulegan",
    .full = {{.resolution = 0.06, .paper = true},
             {.resolution = 0.03, .paper = true, .seeds = 3},
             {.resolution = 0.015, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.06, .judged = true}},
    .evaluate = evaluate,
    .compare = compare,
    .plot = plot};

/* The depth-averaged model alone, against exact solutions of the shallow-water equations. */
#include "cases.h"

#include <math.h>
#include <stdio.h>

/* An exact solution. depth: at a place and time, m. expected: order at which the model should converge to it; limit: of
   the mean error at the judged cells, % of 1 m. */
typedef struct exact {
    double (*depth)(double gravity, double x, double t);
    double (*bed)(double x);
    double from, expected, limit; /* s, from which time errors count */
} exact;

static double flat(double x)
{
    (void)x;
    return 0;
}

static double bowl(double x)
{
    return x * x / 100 - 1;
}

/* Ritter 1892: 1 m of water, whose dam at x = 0 breaks on a dry bed. */
static double ritter(double gravity, double x, double t)
{
    const double c = sqrt(gravity), s = x / t;
    if (s <= -c) return 1;
    return s >= 2 * c ? 0 : (2 * c - s) * (2 * c - s) / (9 * gravity);
}

/* Stoker 1957: the same on 0.1 m of water. The depth between rarefaction and bore is found by bisection. */
static double stoker(double gravity, double x, double t)
{
    const double low = 0.1, c = sqrt(gravity), s = x / t;
    double a = low, b = 1;
    for (int k = 0; k < 100; k++) {
        const double h = 0.5 * (a + b);
        if (2 * (c - sqrt(gravity * h)) > (h - low) * sqrt(0.5 * gravity * (h + low) / (h * low)))
            a = h;
        else
            b = h;
    }
    const double u = 2 * (c - sqrt(gravity * a));
    if (s <= -c) return 1;
    if (s <= u - sqrt(gravity * a)) return (2 * c - s) * (2 * c - s) / (9 * gravity);
    return s < u * a / (a - low) ? a : low;
}

/* Thacker 1981: a parabola of water swings in a parabolic canal without changing its form. */
static double thacker(double gravity, double x, double t)
{
    const double at = x - 2 * cos(sqrt(2 * gravity) / 10 * t);
    return fmax(1 - at * at / 100, 0);
}

/* Mean error of the depth over the gauges and times, m. */
static double error_of(const sb_case_run *run)
{
    const exact *solution = run->of->what;
    double sum = 0;
    size_t count = 0;
    for (size_t g = 0; g < run->scene->measure.gauge_count; g++) {
        const double x = run->scene->measure.gauges[g].x;
        const sb_curve *surface = sb_run_curve(run, "gauges.csv", run->scene->measure.gauges[g].name, "time_s", "z_m");
        for (size_t i = 0; i < surface->count; i++) {
            if (surface->x[i] < solution->from) continue;
            const double depth = isnan(surface->y[i]) ? 0 : surface->y[i] - solution->bed(x);
            sum += fabs(depth - solution->depth(run->scene->fluid.gravity, x, surface->x[i]));
            count++;
        }
    }
    return sum / (double)count;
}

static void evaluate_exact(const sb_case_run *run, sb_figures *figures)
{
    const exact *solution = run->of->what;
    sb_figure_below(figures, "depth, mean error", "%", 100 * error_of(run), solution->limit,
                    "of 1 m; mean over %zu gauges and all times from %g s on", run->scene->measure.gauge_count,
                    solution->from);
}

/* The order between the two finest cells may be below the expected one by this. */
static const double LESS = 0.15;

static void compare(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures)
{
    const exact *solution = runs[0].of->what;
    const double coarse = of_each[count - 2].rows[0].value, fine = of_each[count - 1].rows[0].value;
    const double order = log(coarse / fine) / log(runs[count - 2].resolution / runs[count - 1].resolution);
    sb_figure figure = {.quantity = "order of convergence, two finest",
                        .reference = solution->expected,
                        .value = order,
                        .error = solution->expected - order,
                        .limit = LESS,
                        .one_sided = true,
                        .pass = solution->expected - order <= LESS,
                        .note = "of the mean error of the depth; error: what is missing to the reference"};
    sb_figures_add(figures, &figure);
}

static void plot_exact(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const exact *solution = runs[0].of->what;
    const sb_measure_settings *measure = &runs[0].scene->measure;
    for (size_t g = measure->gauge_count / 4; g < measure->gauge_count; g += measure->gauge_count / 4) {
        const double x = measure->gauges[g].x;
        char title[64];
        snprintf(title, sizeof title, "Surface at x = %g m", x);
        sb_curve *theory = sb_curve_new(runs[0].made);
        for (double t = solution->from; t <= runs[0].scene->duration; t += 0.01)
            sb_curve_add(theory, t, solution->bed(x) + solution->depth(runs[0].scene->fluid.gravity, x, t));
        sb_plot_panel(plot, title, "time (s)", "m");
        sb_plot_curve(plot, SB_PLOT_REFERENCE, "exact", theory);
        for (size_t i = 0; i < count; i++)
            sb_plot_run(plot, &runs[i], sb_run_curve(&runs[i], "gauges.csv", measure->gauges[g].name, "time_s", "z_m"));
    }
}

static double cells_of(const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    return (o->x_max - o->x_min) / o->cell * (o->y_max - o->y_min) / o->cell;
}

static void evaluate_lake(const sb_case_run *run, sb_figures *figures)
{
    const double most = *(const double *)run->of->what;
    const sb_curve *kinetic = sb_run_curve(run, "energy.csv", NULL, "time_s", "kinetic_J");
    const sb_curve *mass = sb_run_curve(run, "energy.csv", NULL, "time_s", "mass_kg");
    const double highest = sb_curve_y(kinetic, sb_curve_highest(kinetic, 0, HUGE_VAL));
    sb_figure_below(figures, "speed, root mean square", "m/s", sqrt(2 * highest / sb_curve_first(mass)), 1e-12,
                    "from the largest kinetic energy");
    sb_figure_below(figures, "time per cell and step", "ns",
                    1e9 * run->cpu / (cells_of(run->scene) * (double)run->steps), most,
                    "processor time of the whole run; %g cells, %zu steps, %.3g iterations per step",
                    cells_of(run->scene), run->steps, run->iterations);
}

static void plot_lake(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    sb_plot_panel(plot, "Kinetic energy", "time (s)", "J");
    for (size_t i = 0; i < count; i++)
        sb_plot_run(plot, &runs[i], sb_run_curve(&runs[i], "energy.csv", NULL, "time_s", "kinetic_J"));
}

static const char *const dispersive[] = {"offshore.dispersion=true", NULL};

const sb_case sb_case_grid_lake = {.name = "grid-lake",
                                   .title = "Depth-averaged lake at rest",
                                   .targets =
                                       "speed: at most 1e-12 m/s; at most 80 ns of processor time per cell and step",
                                   .method = "A lake of 400 m by 400 m with islands over a rough bed; cells of 1 m.",
                                   .scene = "sea/lake.yaml",
                                   .grid = true,
                                   .headline = "speed, root mean square",
                                   .full = {{.resolution = 1, .judged = true}},
                                   .quick = {{.resolution = 2, .judged = true}},
                                   .what = &(const double){80},
                                   .evaluate = evaluate_lake,
                                   .plot = plot_lake};

const sb_case sb_case_grid_lake_dispersive = {
    .name = "grid-lake-dispersive",
    .title = "Depth-averaged lake at rest, with dispersion",
    .targets = "speed: at most 1e-12 m/s; at most 320 ns of processor time per cell and step",
    .method = "The lake of grid-lake by the Serre-Green-Naghdi equations. Water at rest needs few iterations: in waves "
              "a step costs "
              "more.",
    .scene = "sea/lake.yaml",
    .grid = true,
    .headline = "speed, root mean square",
    .full = {{.resolution = 1, .judged = true, .settings = dispersive}},
    .quick = {{.resolution = 2, .judged = true, .settings = dispersive}},
    .what = &(const double){320},
    .evaluate = evaluate_lake,
    .plot = plot_lake};

const sb_case sb_case_grid_ritter = {
    .name = "grid-ritter",
    .title = "Depth-averaged dam break on a dry bed",
    .targets = "depth: mean error at most 0.5 % of the depth; order of convergence 1, less 0.15 at most",
    .method = "Reference: Ritter (1892). A discontinuity limits the order to 1.",
    .scene = "sea/ritter.yaml",
    .grid = true,
    .headline = "depth, mean error",
    .full = {{.resolution = 0.1}, {.resolution = 0.05}, {.resolution = 0.025, .judged = true}},
    .quick = {{.resolution = 0.1}, {.resolution = 0.05, .judged = true}},
    .what = &(const exact){ritter, flat, 0.2, 1, 0.5},
    .evaluate = evaluate_exact,
    .compare = compare,
    .plot = plot_exact};

const sb_case sb_case_grid_stoker = {
    .name = "grid-stoker",
    .title = "Depth-averaged dam break on water",
    .targets = "depth: mean error at most 0.5 % of the depth; order of convergence 1, less 0.15 at most",
    .method = "Reference: Stoker (1957), 0.1 m of water. A discontinuity limits the order to 1.",
    .scene = "sea/stoker.yaml",
    .grid = true,
    .headline = "depth, mean error",
    .full = {{.resolution = 0.1}, {.resolution = 0.05}, {.resolution = 0.025, .judged = true}},
    .quick = {{.resolution = 0.1}, {.resolution = 0.05, .judged = true}},
    .what = &(const exact){stoker, flat, 0.2, 1, 0.5},
    .evaluate = evaluate_exact,
    .compare = compare,
    .plot = plot_exact};

const sb_case sb_case_grid_thacker = {
    .name = "grid-thacker",
    .title = "Depth-averaged water that swings in a parabolic canal",
    .targets = "depth: mean error at most 0.5 % of the depth; order of convergence 1.5, less 0.15 at most",
    .method =
        "Reference: Thacker (1981), plane surface, one period. The shores that move limit the order to about 1.5.",
    .scene = "sea/thacker.yaml",
    .grid = true,
    .headline = "depth, mean error",
    .full = {{.resolution = 0.4}, {.resolution = 0.2}, {.resolution = 0.1, .judged = true}},
    .quick = {{.resolution = 0.4}, {.resolution = 0.2, .judged = true}},
    .what = &(const exact){thacker, bowl, 0.1, 1.5, 0.5},
    .evaluate = evaluate_exact,
    .compare = compare,
    .plot = plot_exact};

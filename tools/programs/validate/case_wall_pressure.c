/* Pressures on the end wall of a dam-break tank, in a vertical slice and in the whole tank. */
#include "cases.h"

#include <math.h>
#include <stdio.h>

#define NONE ((double)NAN)

static const char *const TABLE = "wall-pressure/pressures.csv";
static const double FILTER = 0.002;      /* s, running mean, as in the reference table */
static const double LONG_FILTER = 0.005; /* s, a second running mean, of a reported figure */
static const double ARRIVAL = 500;       /* Pa; the clocks are aligned where S1 passes this value */
static const double TOUCH = 200;         /* Pa; a sensor's first 0.15 s begin where the measured median passes it */
static const double FIRST = 0.15, PLATEAU_BEGIN = 0.7, PLATEAU_END = 0.9; /* s */

static const char *const sensors[] = {"S1", "S2", "S3", "S4"};
enum { SENSORS = 4 };

/* One sensor: measured median and percentiles, and the simulated pressure on the measured clock. */
typedef struct pressures {
    const sb_curve *median, *low, *high;
    sb_curve *simulated;
} pressures;

/* A dry sensor has the pressure of the air, 0. */
static sb_curve *simulated(const sb_case_run *run, const char *sensor)
{
    sb_curve *raw = sb_run_curve(run, "probes.csv", sensor, "time_s", "p_Pa");
    for (size_t i = 0; i < raw->count; i++) raw->y[i] = isnan(raw->y[i]) ? 0 : raw->y[i];
    return sb_curve_mean_filter(run->made, raw, FILTER);
}

static sb_curve *measured(const sb_case_run *run, const char *sensor, const char *column)
{
    return sb_reference_curve(run, TABLE, sensor, "time_s", column);
}

/* Time to be added to that of the simulation. */
static double shift_of(const sb_case_run *run)
{
    return sb_curve_onset(measured(run, sensors[0], "median_Pa"), ARRIVAL, 0) -
           sb_curve_onset(simulated(run, sensors[0]), ARRIVAL, 0);
}

static pressures load(const sb_case_run *run, const char *sensor, double shift)
{
    const pressures p = {measured(run, sensor, "median_Pa"), measured(run, sensor, "low_Pa"),
                         measured(run, sensor, "high_Pa"), simulated(run, sensor)};
    sb_curve_map(p.simulated, 1, shift, 1, 0);
    return p;
}

static double highest(const sb_curve *curve, double last)
{
    return sb_curve_y(curve, sb_curve_highest(curve, 0, last));
}

static void add_sensor(const sb_case_run *run, const char *sensor, double shift, sb_figures *figures)
{
    char name[SB_FIGURE_TEXT];
    const pressures p = load(run, sensor, shift);
    double touch = sb_curve_onset(p.median, TOUCH, 0), end = touch + FIRST;
    snprintf(name, sizeof name, "%s first peak", sensor);
    sb_figure_band(figures, name, "Pa", highest(p.low, end), highest(p.high, end), highest(p.simulated, end), 15,
                   "2 ms means; until %.3f s; band %.0f to %.0f Pa, median %.0f Pa; clock shifted by %.4f s", end,
                   highest(p.low, end), highest(p.high, end), highest(p.median, end), shift);
    snprintf(name, sizeof name, "%s first peak, 5 ms means", sensor);
    sb_figure_report(figures, name, "Pa", highest(sb_curve_mean_filter(run->made, p.median, LONG_FILTER), end),
                     highest(sb_curve_mean_filter(run->made, p.simulated, LONG_FILTER), end),
                     "2 ms means, then 5 ms means, of both");
    double impulse = sb_curve_integral(p.median, touch, end);
    snprintf(name, sizeof name, "%s impulse of the first 0.15 s", sensor);
    sb_figure_share(figures, name, "Pa s", impulse, sb_curve_integral(p.simulated, touch, end), impulse, 10,
                    "from %.3f s on; band %.0f to %.0f Pa s", touch, sb_curve_integral(p.low, touch, end),
                    sb_curve_integral(p.high, touch, end));
    double plateau = sb_curve_mean(p.median, PLATEAU_BEGIN, PLATEAU_END);
    snprintf(name, sizeof name, "%s mean from 0.7 to 0.9 s", sensor);
    sb_figure_share(figures, name, "Pa", plateau, sb_curve_mean(p.simulated, PLATEAU_BEGIN, PLATEAU_END), plateau, 10,
                    "band %.0f to %.0f Pa", sb_curve_mean(p.low, PLATEAU_BEGIN, PLATEAU_END),
                    sb_curve_mean(p.high, PLATEAU_BEGIN, PLATEAU_END));
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const double shift = shift_of(run);
    for (int k = 0; k < SENSORS; k++) add_sensor(run, sensors[k], shift, figures);
}

static void draw(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const char *const titles[] = {"S1, 3 mm above the floor", "S2, 15 mm", "S3, 30 mm", "S4, 80 mm"};
    for (int k = 0; k < SENSORS; k++) {
        const pressures p = load(&runs[0], sensors[k], 0);
        sb_plot_panel(plot, titles[k], "time [s]", "pressure, 2 ms means [Pa]");
        sb_plot_range(plot, 0.4, 0.92, NONE, NONE);
        sb_plot_band(plot, "measured, 2.5 to 97.5 %", p.low, p.high);
        sb_plot_curve(plot, SB_PLOT_REFERENCE, "median", p.median);
        for (size_t i = 0; i < count; i++)
            sb_plot_run(plot, &runs[i], load(&runs[i], sensors[k], shift_of(&runs[i])).simulated);
    }
}

#define TARGETS                                                                                                        \
    "first peak at S1 to S4: in the measured band or within 15 % of its edge; impulse of the first 0.15 s at S1 to "   \
    "S4: "                                                                                                             \
    "within 10 %; mean from 0.7 to 0.9 s at S1 to S4: within 10 %"

const sb_case sb_case_wall_pressure = {
    .name = "wall-pressure",
    .title = "Wall pressures of a dam break, a vertical slice",
    .targets = TARGETS,
    .method =
        "Reference: Lobovsky et al. 2014, H = 0.30 m, median and band (2.5 to 97.5 %) of repeated experiments. Both "
        "sides are running\nmeans over 2 ms.\n\n"
        "- The edges of the band are the maxima of the filtered percentiles.\n"
        "- One shift of the clock makes the simulated pressure at S1 pass 500 Pa at the measured time. All sensors "
        "use it.\n"
        "- The first 0.15 s of a sensor begin when its measured median passes 200 Pa. The first peak is the highest "
        "value until\n  their end.\n"
        "- A probe on the wall reports the force of the step on a patch with a radius of two spacings, weighted "
        "towards its\n  centre, divided by the area of the patch. Drops stopped by the contact resolution alone are "
        "not included. On a dry\n  wall the pressure is 0.\n"
        "- Late means: the measured median is higher at S4 (80 mm) than at S2 and S3 below it, and falls faster from "
        "S1 to S3\n  than hydrostatic pressure. No smooth flow of water does both.",
    .scene = "wall-pressure/slice.yaml",
    .headline = "S2 first peak",
    .full = {{.resolution = 0.012, .paper = true},
             {.resolution = 0.006, .paper = true},
             {.resolution = 0.003, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.006, .judged = true}},
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_wall_pressure_gate = {
    .name = "wall-pressure-gate",
    .title = "Wall pressures of a dam break, a vertical slice, with a gate",
    .targets = TARGETS,
    .method =
        "As in the vertical slice, with a gate that opens upwards at 2 m/s, a speed that laboratories use (0.2 to "
        "2.5 m/s:\nJ. Mar. Sci. Eng. 9 (2021) 67). The speed in this experiment is not known.",
    .scene = "wall-pressure/slice-gate.yaml",
    .headline = "S2 first peak",
    .full = {{.resolution = 0.012}, {.resolution = 0.006}, {.resolution = 0.003, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.006, .judged = true}},
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_wall_pressure_3d = {
    .name = "wall-pressure-3d",
    .title = "Wall pressures of a dam break, the whole tank",
    .targets = TARGETS,
    .method = "As in the vertical slice, but in the whole tank, 0.15 m wide, with sensors at mid-width.",
    .scene = "wall-pressure/tank.yaml",
    .headline = "S2 first peak",
    .full = {{.resolution = 0.012, .paper = true},
             {.resolution = 0.006, .paper = true, .seeds = 3},
             {.resolution = 0.003, .judged = true}},
    .quick = {{.resolution = 0.012, .judged = true}},
    .evaluate = evaluate,
    .plot = draw};

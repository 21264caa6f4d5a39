/* Pressures on the end wall of a dam-break tank, as a slice and whole. */
#include "cases.h"

#include <math.h>
#include <stdio.h>

#define NONE ((double)NAN)

static const char *const TABLE = "wall-pressure/pressures.csv";
static const double FILTER = 0.002; /* s, running mean, as the reference table has it */
static const double CALM = 0.005;   /* s, a second running mean, reported */
static const double ARRIVAL = 500;  /* Pa at S1: the clocks are set equal here */
static const double TOUCH = 200;    /* Pa in the measured median: a sensor's first 0.15 s begin */
static const double FIRST = 0.15, PLATEAU_BEGIN = 0.7, PLATEAU_END = 0.9; /* s */

static const char *const sensors[] = {"S1", "S2", "S3", "S4"};
enum { SENSORS = 4 };

/* One sensor: measured median and percentiles, and the simulation on the measured clock. */
typedef struct pressures {
    sb_curve median, low, high, simulated;
} pressures;

static void pressures_free(pressures *p)
{
    sb_curve_free(&p->median);
    sb_curve_free(&p->low);
    sb_curve_free(&p->high);
    sb_curve_free(&p->simulated);
}

/* A dry sensor feels the air. */
static sb_status simulated(const sb_case_run *run, const char *sensor, sb_curve *filtered, sb_error *error)
{
    sb_curve raw = {0};
    sb_status status = sb_run_curve(run, "probes.csv", sensor, "time_s", "p_Pa", &raw, error);
    for (size_t i = 0; i < raw.count; i++) raw.y[i] = isnan(raw.y[i]) ? 0 : raw.y[i];
    if (status == SB_OK) status = sb_curve_mean_filter(&raw, FILTER, filtered, error);
    sb_curve_free(&raw);
    return status;
}

/* What has to be added to the simulation's time. */
static sb_status shift_of(const sb_case_run *run, double *shift, sb_error *error)
{
    sb_curve measured = {0}, ours = {0};
    sb_status status = sb_reference_curve(run, TABLE, sensors[0], "time_s", "median_Pa", &measured, error);
    if (status == SB_OK) status = simulated(run, sensors[0], &ours, error);
    if (status == SB_OK) *shift = sb_curve_onset(&measured, ARRIVAL, 0) - sb_curve_onset(&ours, ARRIVAL, 0);
    sb_curve_free(&measured);
    sb_curve_free(&ours);
    return status;
}

static sb_status load(const sb_case_run *run, const char *sensor, double shift, pressures *p, sb_error *error)
{
    *p = (pressures){0};
    sb_status status = sb_reference_curve(run, TABLE, sensor, "time_s", "median_Pa", &p->median, error);
    if (status == SB_OK) status = sb_reference_curve(run, TABLE, sensor, "time_s", "low_Pa", &p->low, error);
    if (status == SB_OK) status = sb_reference_curve(run, TABLE, sensor, "time_s", "high_Pa", &p->high, error);
    if (status == SB_OK) status = simulated(run, sensor, &p->simulated, error);
    if (status == SB_OK) sb_curve_map(&p->simulated, 1, shift, 1, 0);
    if (status != SB_OK) pressures_free(p);
    return status;
}

static double highest(const sb_curve *curve, double first, double last)
{
    size_t top = sb_curve_highest(curve, first, last);
    return top == (size_t)-1 ? NONE : curve->y[top];
}

/* Peaks that a calmer filter leaves. */
static sb_status add_calm_peak(const pressures *p, const char *sensor, double touch, sb_figures *figures,
                               sb_error *error)
{
    char name[SB_FIGURE_TEXT];
    snprintf(name, sizeof name, "%s first peak, 5 ms means", sensor);
    sb_curve measured = {0}, ours = {0};
    sb_status status = sb_curve_mean_filter(&p->median, CALM, &measured, error);
    if (status == SB_OK) status = sb_curve_mean_filter(&p->simulated, CALM, &ours, error);
    if (status == SB_OK)
        status =
            sb_figure_report(figures, name, "Pa", highest(&measured, 0, touch + FIRST),
                             highest(&ours, 0, touch + FIRST), error, "2 ms means, then 5 ms means, on both sides");
    sb_curve_free(&measured);
    sb_curve_free(&ours);
    return status;
}

static sb_status add_sensor(const pressures *p, const char *sensor, double shift, sb_figures *figures, sb_error *error)
{
    char name[SB_FIGURE_TEXT];
    double touch = sb_curve_onset(&p->median, TOUCH, 0), end = touch + FIRST;
    snprintf(name, sizeof name, "%s first peak", sensor);
    sb_status status = sb_figure_band(
        figures, name, "Pa", highest(&p->low, 0, end), highest(&p->high, 0, end), highest(&p->simulated, 0, end), 15,
        error, "2 ms means; until %.3f s; band %.0f to %.0f Pa, median %.0f Pa; clock shifted by %.4f s", end,
        highest(&p->low, 0, end), highest(&p->high, 0, end), highest(&p->median, 0, end), shift);
    if (status == SB_OK) status = add_calm_peak(p, sensor, touch, figures, error);
    double impulse = sb_curve_integral(&p->median, touch, end);
    snprintf(name, sizeof name, "%s impulse of the first 0.15 s", sensor);
    if (status == SB_OK)
        status = sb_figure_share(figures, name, "Pa s", impulse, sb_curve_integral(&p->simulated, touch, end), impulse,
                                 10, error, "from %.3f s on; band %.0f to %.0f Pa s", touch,
                                 sb_curve_integral(&p->low, touch, end), sb_curve_integral(&p->high, touch, end));
    double plateau = sb_curve_mean(&p->median, PLATEAU_BEGIN, PLATEAU_END);
    snprintf(name, sizeof name, "%s mean from 0.7 to 0.9 s", sensor);
    if (status == SB_OK)
        status = sb_figure_share(figures, name, "Pa", plateau, sb_curve_mean(&p->simulated, PLATEAU_BEGIN, PLATEAU_END),
                                 plateau, 10, error, "band %.0f to %.0f Pa",
                                 sb_curve_mean(&p->low, PLATEAU_BEGIN, PLATEAU_END),
                                 sb_curve_mean(&p->high, PLATEAU_BEGIN, PLATEAU_END));
    return status;
}

static sb_status evaluate(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    double shift = NONE;
    sb_status status = shift_of(run, &shift, error);
    for (int k = 0; status == SB_OK && k < SENSORS; k++) {
        pressures p;
        status = load(run, sensors[k], shift, &p, error);
        if (status != SB_OK) break;
        status = add_sensor(&p, sensors[k], shift, figures, error);
        pressures_free(&p);
    }
    return status;
}

static sb_status draw_run(const sb_case_run *run, const char *sensor, sb_plot *plot, sb_error *error)
{
    double shift = NONE;
    pressures p = {0};
    sb_status status = shift_of(run, &shift, error);
    if (status == SB_OK) status = load(run, sensor, shift, &p, error);
    if (status == SB_OK) status = sb_plot_run(plot, run, &p.simulated, error);
    pressures_free(&p);
    return status;
}

static sb_status draw_measured(const sb_case_run *run, const char *sensor, sb_plot *plot, sb_error *error)
{
    pressures p;
    sb_status status = load(run, sensor, 0, &p, error);
    if (status == SB_OK) status = sb_plot_band(plot, "measured, 2.5 to 97.5 %", &p.low, &p.high, error);
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_REFERENCE, "median", &p.median, error);
    pressures_free(&p);
    return status;
}

static sb_status draw(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    static const char *const titles[] = {"S1, 3 mm above the floor", "S2, 15 mm", "S3, 30 mm", "S4, 80 mm"};
    sb_status status = SB_OK;
    for (int k = 0; status == SB_OK && count && k < SENSORS; k++) {
        status = sb_plot_panel(plot, titles[k], "time [s]", "pressure, 2 ms means [Pa]", error);
        sb_plot_range(plot, 0.4, 0.92, NONE, NONE);
        if (status == SB_OK) status = draw_measured(&runs[0], sensors[k], plot, error);
        for (size_t i = 0; status == SB_OK && i < count; i++) status = draw_run(&runs[i], sensors[k], plot, error);
    }
    return status;
}

static const sb_plan slice_full[] = {{.resolution = 0.012, .paper = true},
                                     {.resolution = 0.006, .paper = true},
                                     {.resolution = 0.003, .judged = true, .seeds = 3},
                                     {.resolution = 0}};
static const sb_plan slice_quick[] = {{.resolution = 0.006, .judged = true}, {.resolution = 0}};
static const sb_plan tank_full[] = {{.resolution = 0.012, .paper = true},
                                    {.resolution = 0.006, .paper = true, .seeds = 3},
                                    {.resolution = 0.003, .judged = true},
                                    {.resolution = 0}};
static const sb_plan tank_quick[] = {{.resolution = 0.012, .judged = true}, {.resolution = 0}};

#define REACH                                                                                                          \
    "S1-S4: first peak inside the measured band or within 15 % of its edge, impulse of the first "                     \
    "0.15 s and mean from 0.7 to 0.9 s within 10 %"

const sb_case sb_case_wall_pressure = {
    .name = "wall-pressure",
    .title = "Wall pressures of a dam break, a vertical slice",
    .reach = REACH,
    .method = "Lobovsky et al. 2014, H = 0.30 m, median and band (2.5 to 97.5 %) of the repeats. Running "
              "means over 2 ms on both sides; the band's edges are the maxima of the filtered "
              "percentiles. One shift of the clock makes the pressure at S1 pass 500 Pa at the measured "
              "time (arrival); all sensors use it. A sensor's first 0.15 s begin when its measured "
              "median passes 200 Pa. The first peak is the highest value until their end. A probe on "
              "the wall reads the force of the step on a patch of two spacings' radius (weighted "
              "towards its middle) over its area; drops that contact alone stops are not in it. Where "
              "the wall is dry the pressure is 0. Of the plateau, note that the measured median is "
              "higher at S4 (80 mm) than at S2 and S3 below it, and falls faster from S1 to S3 than "
              "hydrostatic pressure would: no water in a smooth flow does both.",
    .scene = "wall-pressure/slice.yaml",
    .headline = "S2 first peak",
    .full = slice_full,
    .quick = slice_quick,
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_wall_pressure_3d = {.name = "wall-pressure-3d",
                                          .title = "Wall pressures of a dam break, the whole tank",
                                          .reach = REACH,
                                          .method = "As the slice, in the tank of 0.15 m width, sensors at mid-width.",
                                          .scene = "wall-pressure/tank.yaml",
                                          .headline = "S2 first peak",
                                          .full = tank_full,
                                          .quick = tank_quick,
                                          .evaluate = evaluate,
                                          .plot = draw};

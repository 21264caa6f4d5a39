/* Force of a dam-break bore on a square column. */
#include "cases.h"

#include <math.h>
#include <stdio.h>

#define NONE ((double)NAN)

static const char *const FORCES = "column/force.csv";
static const char *const sets[] = {"a", "b"};
enum { SETS = 2 };

static const double FILTER = 0.02; /* s, running median, as in the reference table */
static const double STEP = 0.01;   /* s between its values */
static const double ONSET = 2;     /* N; the clocks are aligned where the force passes this value */
static const double ZERO = 0.05;   /* s; before it the measured force is only a zero offset */
static const double IMPULSE_BEGIN = 0.32, IMPULSE_END = 1.3; /* s */
static const double REFLECTED_END = 1.85;                    /* s */

/* Force on the column: two digitisations, and the simulation at multiples of STEP on the measured clock. */
typedef struct forces {
    sb_curve measured[SETS], simulated;
    double shift; /* s, added to the simulation's time */
} forces;

static void forces_free(forces *f)
{
    for (int k = 0; k < SETS; k++) sb_curve_free(&f->measured[k]);
    sb_curve_free(&f->simulated);
}

static sb_status filtered_force(const sb_case_run *run, sb_curve *filtered, sb_error *error)
{
    sb_curve raw = {0};
    sb_status status = sb_run_curve(run, "forces.csv", "column", "time_s", "Fx_N", &raw, error);
    if (status == SB_OK) status = sb_curve_median_filter(&raw, FILTER, filtered, error);
    sb_curve_free(&raw);
    return status;
}

static sb_status load(const sb_case_run *run, forces *f, sb_error *error)
{
    *f = (forces){0};
    sb_curve ours = {0};
    double onset = 0;
    sb_status status = filtered_force(run, &ours, error);
    for (int k = 0; status == SB_OK && k < SETS; k++) {
        status = sb_reference_curve(run, FORCES, sets[k], "time_s", "force_N", &f->measured[k], error);
        onset += status == SB_OK ? sb_curve_onset(&f->measured[k], ONSET, ZERO) / SETS : 0;
    }
    if (status == SB_OK) {
        f->shift = onset - sb_curve_onset(&ours, ONSET, 0);
        sb_curve_map(&ours, 1, f->shift, 1, 0);
        status = sb_curve_resample(&ours, 0, REFLECTED_END, STEP, &f->simulated, error);
    }
    sb_curve_free(&ours);
    if (status != SB_OK) forces_free(f);
    return status;
}

static double value_at(const sb_curve *curve, size_t index)
{
    return index == (size_t)-1 ? NONE : curve->y[index];
}

static double time_at(const sb_curve *curve, size_t index)
{
    return index == (size_t)-1 ? NONE : curve->x[index];
}

static sb_status add_set(const forces *f, int k, sb_figures *figures, sb_error *error)
{
    char name[SB_FIGURE_TEXT];
    const sb_curve *measured = &f->measured[k], *ours = &f->simulated;
    size_t top = sb_curve_highest(measured, ZERO, IMPULSE_END);
    size_t our_top = sb_curve_highest(ours, ZERO, IMPULSE_END);
    double peak = value_at(measured, top);
    snprintf(name, sizeof name, "peak force, digitisation %s", sets[k]);
    sb_status status =
        sb_figure_share(figures, name, "N", peak, value_at(ours, our_top), peak, 10, error,
                        "20 ms medians; measured at %.2f s, simulated at %.2f s; clock shifted by %.3f s",
                        time_at(measured, top), time_at(ours, our_top), f->shift);
    double impulse = sb_curve_integral(measured, IMPULSE_BEGIN, IMPULSE_END);
    snprintf(name, sizeof name, "impulse 0.32 to 1.3 s, digitisation %s", sets[k]);
    if (status == SB_OK)
        status = sb_figure_share(figures, name, "N s", impulse, sb_curve_integral(ours, IMPULSE_BEGIN, IMPULSE_END),
                                 impulse, 5, error, "from 20 ms medians");
    snprintf(name, sizeof name, "RMS until 1.3 s, digitisation %s", sets[k]);
    if (status == SB_OK)
        status =
            sb_figure_below(figures, name, "%", 100 / peak * sb_curve_rms_difference(ours, measured, ZERO, IMPULSE_END),
                            10, error, "20 ms medians from %g s; relative to the measured peak", ZERO);
    return status;
}

static sb_status add_reflected(const forces *f, sb_figures *figures, sb_error *error)
{
    size_t low = sb_curve_lowest(&f->simulated, IMPULSE_END, REFLECTED_END);
    sb_status status =
        sb_figure_share(figures, "reflected minimum", "N", -11, value_at(&f->simulated, low), 11, 30, error,
                        "20 ms medians between %g and %g s; digitisations: %.1f and %.1f N", IMPULSE_END, REFLECTED_END,
                        value_at(&f->measured[0], sb_curve_lowest(&f->measured[0], IMPULSE_END, REFLECTED_END)),
                        value_at(&f->measured[1], sb_curve_lowest(&f->measured[1], IMPULSE_END, REFLECTED_END)));
    if (status == SB_OK)
        status = sb_figure_difference(figures, "time of the reflected minimum", "s", 1.57, time_at(&f->simulated, low),
                                      0.1, error, "from 20 ms medians");
    return status;
}

/* Velocity in front of the column after the arrival of the bore, as 50 ms medians. */
static sb_status bore(const sb_case_run *run, sb_curve *velocity, double *arrival, sb_error *error)
{
    sb_curve raw = {0}, after = {0};
    sb_status status = sb_run_curve(run, "probes.csv", "bore", "time_s", "u_m_s", &raw, error);
    *arrival = NONE;
    for (size_t i = 0; status == SB_OK && i < raw.count; i++) {
        if (isnan(*arrival) && raw.y[i] > 1) *arrival = raw.x[i];
        if (!isnan(*arrival) && !isnan(raw.y[i])) status = sb_curve_add(&after, raw.x[i] - *arrival, raw.y[i], error);
    }
    if (status == SB_OK) status = sb_curve_median_filter(&after, 0.05, velocity, error);
    sb_curve_free(&raw);
    sb_curve_free(&after);
    return status;
}

static sb_status add_bore(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_curve velocity = {0}, measured = {0};
    double arrival = NONE;
    sb_status status = bore(run, &velocity, &arrival, error);
    if (status == SB_OK)
        status = sb_reference_curve(run, "column/velocity.csv", NULL, "time_s", "u_m_s", &measured, error);
    if (status == SB_OK)
        status =
            sb_figure_report(figures, "bore velocity, RMS difference", "m/s", NONE,
                             sb_curve_rms_difference(&velocity, &measured, 0, 0.9), error,
                             "50 ms medians over 0.9 s after the arrival of the bore (u > 1 m/s), in the simulation "
                             "at %.3f s",
                             arrival);
    sb_curve_free(&velocity);
    sb_curve_free(&measured);
    return status;
}

static sb_status evaluate(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    forces f;
    sb_status status = load(run, &f, error);
    if (status != SB_OK) return status;
    for (int k = 0; status == SB_OK && k < SETS; k++) status = add_set(&f, k, figures, error);
    if (status == SB_OK) status = add_reflected(&f, figures, error);
    if (status == SB_OK) status = add_bore(run, figures, error);
    forces_free(&f);
    return status;
}

static sb_status draw_forces(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    sb_status status =
        sb_plot_panel(plot, "Force on the column, 20 ms medians", "time [s]", "horizontal force [N]", error);
    sb_plot_range(plot, 0.2, REFLECTED_END, NONE, NONE);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        forces f;
        status = load(&runs[i], &f, error);
        if (status != SB_OK) return status;
        for (int k = 0; status == SB_OK && i == 0 && k < SETS; k++) {
            char label[SB_FIGURE_TEXT];
            snprintf(label, sizeof label, "measured, digitisation %s", sets[k]);
            status = sb_plot_curve(plot, SB_PLOT_POINTS, label, &f.measured[k], error);
        }
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &f.simulated, error);
        forces_free(&f);
    }
    return status;
}

static sb_status draw_bore(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    sb_curve measured = {0};
    sb_status status = sb_plot_panel(plot, "Velocity 86 mm ahead of the column, 50 ms medians",
                                     "time from the bore's arrival [s]", "u [m/s]", error);
    sb_plot_range(plot, 0, 0.95, 0, NONE);
    if (status == SB_OK && count)
        status = sb_reference_curve(&runs[0], "column/velocity.csv", NULL, "time_s", "u_m_s", &measured, error);
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_POINTS, "measured", &measured, error);
    sb_curve_free(&measured);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_curve velocity = {0};
        double arrival;
        status = bore(&runs[i], &velocity, &arrival, error);
        if (status == SB_OK) status = sb_plot_run(plot, &runs[i], &velocity, error);
        sb_curve_free(&velocity);
    }
    return status;
}

static sb_status draw(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    sb_status status = draw_forces(runs, count, plot, error);
    return status == SB_OK ? draw_bore(runs, count, plot, error) : status;
}

static const sb_plan full[] = {{.resolution = 0.02, .paper = true},
                               {.resolution = 0.01, .paper = true, .seeds = 3},
                               {.resolution = 0.005, .judged = true, .seeds = 3},
                               {.resolution = 0}};
static const sb_plan quick[] = {{.resolution = 0.02, .judged = true}, {.resolution = 0}};

const sb_case sb_case_column = {
    .name = "column",
    .title = "Dam-break bore against a square column",
    .targets = "peak, both digitisations: within 10 %; impulse from 0.32 to 1.3 s, both digitisations: within 5 %; RMS "
               "difference until 1.3 s, both digitisations: at most 10 % of the peak; reflected minimum: -11 N within "
               "30 %, at 1.57 s within 0.1 s",
    .method =
        "Reference: Yeh and Petroff, two digitisations (a, b) of the same noisy record. Both sides are running "
        "medians over\n20 ms, every 10 ms. The measured clock is uncertain by 0.1 s. One shift therefore aligns the "
        "simulated force with\nthe mean of the digitisations where they pass 2 N. The first 0.05 s are a zero offset "
        "and are omitted. The velocity of\nthe bore is compared from its arrival, too.",
    .scene = "column/column.yaml",
    .headline = "peak force, digitisation a",
    .full = full,
    .quick = quick,
    .evaluate = evaluate,
    .plot = draw};

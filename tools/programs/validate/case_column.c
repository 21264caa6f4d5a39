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
    const sb_curve *measured[SETS], *simulated;
    double shift; /* s, added to the simulation's time */
} forces;

static forces load(const sb_case_run *run)
{
    forces f;
    double onset = 0;
    const sb_curve *raw = sb_run_curve(run, "forces.csv", "column", "time_s", "Fx_N");
    sb_curve *ours = sb_curve_median_filter(run->made, raw, FILTER);
    for (int k = 0; k < SETS; k++) {
        f.measured[k] = sb_reference_curve(run, FORCES, sets[k], "time_s", "force_N");
        onset += sb_curve_onset(f.measured[k], ONSET, ZERO) / SETS;
    }
    f.shift = onset - sb_curve_onset(ours, ONSET, 0);
    sb_curve_map(ours, 1, f.shift, 1, 0);
    f.simulated = sb_curve_resample(run->made, ours, 0, REFLECTED_END, STEP);
    return f;
}

static void add_set(const forces *f, int k, sb_figures *figures)
{
    char name[SB_FIGURE_TEXT];
    const sb_curve *measured = f->measured[k], *ours = f->simulated;
    size_t top = sb_curve_highest(measured, ZERO, IMPULSE_END);
    size_t our_top = sb_curve_highest(ours, ZERO, IMPULSE_END);
    double peak = sb_curve_y(measured, top);
    snprintf(name, sizeof name, "peak force, digitisation %s", sets[k]);
    sb_figure_share(figures, name, "N", peak, sb_curve_y(ours, our_top), peak, 10,
                    "20 ms medians; measured at %.2f s, simulated at %.2f s; clock shifted by %.3f s",
                    sb_curve_x(measured, top), sb_curve_x(ours, our_top), f->shift);
    double impulse = sb_curve_integral(measured, IMPULSE_BEGIN, IMPULSE_END);
    snprintf(name, sizeof name, "impulse 0.32 to 1.3 s, digitisation %s", sets[k]);
    sb_figure_share(figures, name, "N s", impulse, sb_curve_integral(ours, IMPULSE_BEGIN, IMPULSE_END), impulse, 5,
                    "from 20 ms medians");
    snprintf(name, sizeof name, "RMS until 1.3 s, digitisation %s", sets[k]);
    sb_figure_below(figures, name, "%", 100 / peak * sb_curve_rms_difference(ours, measured, ZERO, IMPULSE_END), 10,
                    "20 ms medians from %g s; relative to the measured peak", ZERO);
}

static double reflected(const sb_curve *curve)
{
    return sb_curve_y(curve, sb_curve_lowest(curve, IMPULSE_END, REFLECTED_END));
}

static void add_reflected(const forces *f, sb_figures *figures)
{
    size_t low = sb_curve_lowest(f->simulated, IMPULSE_END, REFLECTED_END);
    sb_figure_share(figures, "reflected minimum", "N", -11, reflected(f->simulated), 11, 30,
                    "20 ms medians between %g and %g s; digitisations: %.1f and %.1f N", IMPULSE_END, REFLECTED_END,
                    reflected(f->measured[0]), reflected(f->measured[1]));
    sb_figure_difference(figures, "time of the reflected minimum", "s", 1.57, sb_curve_x(f->simulated, low), 0.1,
                         "from 20 ms medians");
}

/* Velocity in front of the column after the arrival of the bore, as 50 ms medians. */
static sb_curve *bore(const sb_case_run *run, double *arrival)
{
    const sb_curve *raw = sb_run_curve(run, "probes.csv", "bore", "time_s", "u_m_s");
    sb_curve *after = sb_curve_new(run->made);
    *arrival = NONE;
    for (size_t i = 0; i < raw->count; i++) {
        if (isnan(*arrival) && raw->y[i] > 1) *arrival = raw->x[i];
        if (!isnan(*arrival) && !isnan(raw->y[i])) sb_curve_add(after, raw->x[i] - *arrival, raw->y[i]);
    }
    return sb_curve_median_filter(run->made, after, 0.05);
}

static sb_curve *measured_bore(const sb_case_run *run)
{
    return sb_reference_curve(run, "column/velocity.csv", NULL, "time_s", "u_m_s");
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    double arrival;
    const forces f = load(run);
    for (int k = 0; k < SETS; k++) add_set(&f, k, figures);
    add_reflected(&f, figures);
    const sb_curve *velocity = bore(run, &arrival);
    sb_figure_report(figures, "bore velocity, RMS difference", "m/s", NONE,
                     sb_curve_rms_difference(velocity, measured_bore(run), 0, 0.9),
                     "50 ms medians over 0.9 s after the arrival of the bore (u > 1 m/s), in the simulation at %.3f s",
                     arrival);
}

static void draw(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    sb_plot_panel(plot, "Force on the column, 20 ms medians", "time [s]", "horizontal force [N]");
    sb_plot_range(plot, 0.2, REFLECTED_END, NONE, NONE);
    for (size_t i = 0; i < count; i++) {
        const forces f = load(&runs[i]);
        for (int k = 0; i == 0 && k < SETS; k++) {
            char label[SB_FIGURE_TEXT];
            snprintf(label, sizeof label, "measured, digitisation %s", sets[k]);
            sb_plot_curve(plot, SB_PLOT_POINTS, label, f.measured[k]);
        }
        sb_plot_run(plot, &runs[i], f.simulated);
    }
    sb_plot_panel(plot, "Velocity 86 mm ahead of the column, 50 ms medians", "time from the bore's arrival [s]",
                  "u [m/s]");
    sb_plot_range(plot, 0, 0.95, 0, NONE);
    sb_plot_curve(plot, SB_PLOT_POINTS, "measured", measured_bore(&runs[0]));
    for (size_t i = 0; i < count; i++) {
        double arrival;
        sb_plot_run(plot, &runs[i], bore(&runs[i], &arrival));
    }
}

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
    .full = {{.resolution = 0.02, .paper = true, .wen = true},
             {.resolution = 0.01, .paper = true, .seeds = 3},
             {.resolution = 0.005, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.02, .judged = true}},
    .evaluate = evaluate,
    .plot = draw};

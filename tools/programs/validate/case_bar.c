/* Regular waves over a submerged bar: harmonics and heights beside the laboratory's. */
#include "cases.h"
#include "wave_fit.h"

#include <math.h>
#include <stdio.h>

enum { WINDOW = 5, JUDGED_HARMONICS = 3 }; /* periods, the last ones of the run */

/* One row of harmonics.csv in m. */
typedef struct laboratory {
    double height, amplitude[SB_FIT_HARMONICS];
} laboratory;

static double measured(const sb_case_run *run, const char *gauge, const char *column)
{
    return 1e-3 * sb_curve_first(sb_reference_curve(run, "bar/harmonics.csv", gauge, "x_m", column));
}

static laboratory read_gauge(const sb_case_run *run, const char *gauge)
{
    laboratory l = {.height = measured(run, gauge, "height_mm")};
    for (int n = 0; n < SB_FIT_HARMONICS; n++) {
        char column[16];
        snprintf(column, sizeof column, "a%d_mm", n + 1);
        l.amplitude[n] = measured(run, gauge, column);
    }
    return l;
}

static void figure_gauge(const sb_case_run *run, const char *gauge, sb_figures *figures)
{
    const laboratory lab = read_gauge(run, gauge);
    const double period = run->scene->wavemakers[0].law.period, last = run->scene->duration,
                 first = last - WINDOW * period;
    const sb_curve *eta = sb_wave_fit_gauge(run, gauge);
    const sb_wave_fit fit = sb_wave_fit_of(eta, period, first, last);
    const double height = sb_wave_fit_height(eta, period, first, last);
    double largest = 0;
    char quantity[SB_FIGURE_TEXT];
    for (int n = 0; n < JUDGED_HARMONICS; n++) largest = fmax(largest, lab.amplitude[n]);
    snprintf(quantity, sizeof quantity, "%s, height", gauge);
    sb_figure_share(figures, quantity, "mm", 1e3 * lab.height, 1e3 * height, 1e3 * lab.height, 10, "%s", "");
    for (int n = 0; n < JUDGED_HARMONICS; n++) {
        snprintf(quantity, sizeof quantity, "%s, harmonic %d", gauge, n + 1);
        sb_figure_share(figures, quantity, "mm", 1e3 * lab.amplitude[n], 1e3 * fit.amplitude[n], 1e3 * largest, 12,
                        "%s", "");
    }
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_measure_settings *measure = &run->scene->measure;
    for (size_t g = 0; g < measure->gauge_count; g++) figure_gauge(run, measure->gauges[g].name, figures);
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const char *const titles[] = {"First harmonic", "Second harmonic", "Third harmonic"};
    for (int n = 0; n < JUDGED_HARMONICS; n++) {
        char column[16];
        snprintf(column, sizeof column, "a%d_mm", n + 1);
        sb_plot_panel(plot, titles[n], "x (m); the bar is from 6 to 17 m", "mm");
        sb_plot_curve(plot, SB_PLOT_POINTS, "laboratory",
                      sb_reference_curve(&runs[0], "bar/harmonics.csv", NULL, "x_m", column));
        for (size_t i = 0; i < count; i++) {
            const sb_measure_settings *measure = &runs[i].scene->measure;
            const double period = runs[i].scene->wavemakers[0].law.period, last = runs[i].scene->duration;
            sb_curve *own = sb_curve_new(runs[i].made);
            for (size_t g = 0; g < measure->gauge_count; g++) {
                const sb_wave_fit fit = sb_wave_fit_of(sb_wave_fit_gauge(&runs[i], measure->gauges[g].name), period,
                                                       last - WINDOW * period, last);
                sb_curve_add(own, measure->gauges[g].x, 1e3 * fit.amplitude[n]);
            }
            sb_plot_run(plot, &runs[i], own);
        }
    }
}

static const char *const plain[] = {"render.interval=0", NULL};
static const char *const shorter[] = {"render.interval=0", "duration=36.4", NULL};

const sb_case sb_case_bar = {
    .name = "bar",
    .title = "Regular waves over a submerged bar",
    .targets = "harmonics 1 to 3: within 12 % of the largest at the gauge; height: within 10 %",
    .method =
        "Reference: laboratory, Beji and Battjes (1993), Luth et al. (1994), case A: H 0.02 m, T 2.02 s, bar of 0.3 m "
        "in 0.4 m "
        "of water. The\namplitudes of the last ten periods of the records are compared with those of the last five of "
        "the run; "
        "no clock is needed, no\nfilter. Heights are crest minus trough of each period. Waves leave through a sponge "
        "from 24 m on.",
    .scene = "../scenes/bar.yaml",
    .headline = "a15, harmonic 2",
    .full = {{.resolution = 0.01, .settings = plain}, {.resolution = 0.005, .judged = true, .settings = plain}},
    .quick = {{.resolution = 0.02, .judged = true, .settings = shorter}},
    .evaluate = evaluate,
    .plot = plot};

/* Regular waves that shoal and plunge on a slope: heights along it, and where they break. */
#include "cases.h"
#include "wave_fit.h"

#include <math.h>

enum { WINDOW = 4 }; /* periods, the last ones of the run */

/* Heights over x. */
static sb_curve *heights_of(const sb_case_run *run)
{
    const sb_measure_settings *measure = &run->scene->measure;
    const double period = run->scene->wavemakers[0].law.period, last = run->scene->duration;
    sb_curve *heights = sb_curve_new(run->made);
    for (size_t g = 0; g < measure->gauge_count; g++)
        sb_curve_add(
            heights, measure->gauges[g].x,
            sb_wave_fit_height(sb_wave_fit_gauge(run, measure->gauges[g].name), period, last - WINDOW * period, last));
    return heights;
}

static sb_curve *laboratory(const sb_case_run *run)
{
    sb_curve *heights = sb_reference_curve(run, "shoaling/heights.csv", NULL, "x_m", "height_mm");
    sb_curve_map(heights, 1, 0, 1e-3, 0);
    return heights;
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_curve *own = heights_of(run), *lab = laboratory(run);
    sb_curve *ratio = sb_curve_new(run->made);
    for (size_t i = 0; i < lab->count; i++) sb_curve_add(ratio, lab->x[i], sb_curve_at(own, lab->x[i]) / lab->y[i] - 1);
    const bool all = sb_curve_shared(own, lab, 0, 10.8) == lab->count; /* a mean without some is none */
    sb_figure_below(figures, "height along the slope, RMS difference", "%",
                    all ? 100 * sb_curve_rms(ratio, 0, 10.8) : (double)NAN, 10,
                    "relative to the measured height, at the %zu places of the laboratory", lab->count);
    const size_t breaks = sb_curve_highest(own, 0, 10.8), measured = sb_curve_highest(lab, 0, 10.8);
    sb_figure_difference(figures, "place of the greatest height", "m", sb_curve_x(lab, measured),
                         sb_curve_x(own, breaks), 0.3, "where the waves break; gauges 0.15 m apart");
    sb_figure_report(figures, "greatest height", "m", sb_curve_y(lab, measured), sb_curve_y(own, breaks),
                     "crest minus trough");
    sb_figure_report(figures, "height at the toe", "m", sb_curve_at(lab, 0.1), sb_curve_at(own, 0.1), "at 0.1 m");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    sb_plot_panel(plot, "Wave height along the slope", "x from the toe (m)", "m");
    sb_plot_curve(plot, SB_PLOT_POINTS, "laboratory", laboratory(&runs[0]));
    for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], heights_of(&runs[i]));
}

static const char *const shorter[] = {"duration=36.6", NULL};

const sb_case sb_case_shoaling = {
    .name = "shoaling",
    .title = "Regular waves that shoal and plunge on a slope 1:34.26",
    .targets = "height along the slope: RMS difference at most 10 %; breaking point: within 0.3 m",
    .method = "Reference: laboratory, Hansen and Svendsen (1979), case 031041: H 0.042 m, T 3.33 s in 0.36 m of water. "
              "Heights are "
              "mean crest minus\nmean trough of the last four periods of the run; no filter. The waves break where "
              "they are highest. "
              "The paddle makes cnoidal\nwaves one wavelength before the toe, and absorbs what the slope returns.",
    .scene = "shoaling/shoaling.yaml",
    .headline = "height along the slope, RMS difference",
    .full = {{.resolution = 0.01}, {.resolution = 0.005, .judged = true}},
    .quick = {{.resolution = 0.02, .judged = true, .settings = shorter}},
    .evaluate = evaluate,
    .plot = plot};

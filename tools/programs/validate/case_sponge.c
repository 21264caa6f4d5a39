/* What a sponge reflects of regular waves, beside what linear theory predicts. */
#include "cases.h"
#include "paddle_case.h"
#include "wave_fit.h"

#include <math.h>

enum { WINDOWS = 3, WINDOW = 3 }; /* windows, the last ones of the run, of so many periods each */

/* Reflected over incident amplitude in % in the window that ends so many windows before the run does. */
static double reflected(const sb_case_run *run, int before)
{
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const double last = run->scene->duration - before * WINDOW * law->period;
    const sb_split split =
        sb_wave_fit_split(run, "a", law->period, sb_wave_fit_number(law), last - WINDOW * law->period, last);
    return 100 * split.reflected / split.incident;
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const double *limit = run->of->what;
    const sb_sponge *sponge = &run->scene->sponges[0];
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const double predicted = 100 * sb_sponge_reflection(sponge->profile, sponge->strength, 2 * M_PI / sponge->period,
                                                        sponge->depth, run->scene->fluid.gravity, sponge->length);
    const double last = run->scene->duration, first = last - WINDOWS * WINDOW * law->period;
    const sb_split split = sb_wave_fit_split(run, "a", law->period, sb_wave_fit_number(law), first, last);
    const double value = 100 * split.reflected / split.incident;
    sb_figure_below(figures, "reflected", "%", value, *limit,
                    "of the amplitude, first harmonic, over nine periods; in "
                    "three windows of three periods %.2g, %.2g and %.2g %%",
                    reflected(run, 2), reflected(run, 1), reflected(run, 0));
    sb_figure_difference(figures, "reflected, beside linear theory", "%", predicted, value, 1,
                         "linear theory as `shorebreak check` prints it; strength %.4g 1/s", sponge->strength);
    sb_figure_report(figures, "incident height over that aimed at", "", 1, 2 * split.incident / law->height,
                     "first harmonic, 1.65 to 2.27 wavelengths from the paddle");
    sb_paddle_drift(run, figures);
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    sb_paddle_plot(runs, count, "Surface at 2.27 wavelengths", "a4", plot);
}

#define METHOD                                                                                                         \
    "Reference: linear theory of the zone in slices (docs/waves.md). kd 1, H/L 0.03; four gauges split the first "     \
    "harmonic by least\nsquares (Mansard and Funke 1980). The paddle absorbs what comes back. The last nine periods "  \
    "count, of 24 (quick: 20)."
static const char *const longer[] = {"domain.max=[450, 22]", "sponges.beach.length=150", NULL};
static const char *const quick_short[] = {"duration=183.4", NULL};
static const char *const quick_long[] = {"domain.max=[450, 22]", "sponges.beach.length=150", "duration=183.4", NULL};
static const double limit_short = 4, limit_long = 2;

const sb_case sb_case_sponge_short = {.name = "sponge-1",
                                      .title = "A sponge of one wavelength",
                                      .targets = "reflected: at most 4 %, and within 1 point of linear theory",
                                      .method = METHOD,
                                      .scene = "sponge/sponge.yaml",
                                      .headline = "reflected",
                                      .what = &limit_short,
                                      .full = {{.resolution = 1}, {.resolution = 0.5, .judged = true, .seeds = 3}},
                                      .quick = {{.resolution = 1, .judged = true, .settings = quick_short}},
                                      .evaluate = evaluate,
                                      .plot = plot};

const sb_case sb_case_sponge_long = {.name = "sponge-1.5",
                                     .title = "A sponge of 1.5 wavelengths",
                                     .targets = "reflected: at most 2 %, and within 1 point of linear theory",
                                     .method = METHOD,
                                     .scene = "sponge/sponge.yaml",
                                     .headline = "reflected",
                                     .what = &limit_long,
                                     .full = {{.resolution = 1, .settings = longer},
                                              {.resolution = 0.5, .judged = true, .seeds = 3, .settings = longer}},
                                     .quick = {{.resolution = 1, .judged = true, .settings = quick_long}},
                                     .evaluate = evaluate,
                                     .plot = plot};

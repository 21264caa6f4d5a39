/* Irregular waves: height, period and spectrum beside those of the same components by linear theory. */
#include "cases.h"
#include "wave_fit.h"

#include <math.h>

enum {
    BEGIN = 15,
    SEGMENT = 30,
    BINS = 76
}; /* peak periods: begin of the record; length of a segment of the plotted spectrum */

/* What linear theory has at the gauge at the times of the record. Empty without memory. */
static sb_curve *linear_record(const sb_case_run *run, const sb_curve *record)
{
    sb_wavemaker_parameters law = run->scene->wavemakers[0].law;
    sb_curve *made = sb_curve_new(run->made);
    sb_paddle paddle;
    law.gravity = run->scene->fluid.gravity;
    if (run->error->status != SB_OK || sb_paddle_create(&law, &paddle, run->error) != SB_OK) return made;
    law.kind->place(paddle.state, run->scene->measure.gauges[0].x);
    for (size_t i = 0; i < record->count; i++)
        sb_curve_add(made, record->x[i], law.kind->surface(paddle.state, record->x[i] - law.start));
    sb_paddle_destroy(&paddle);
    return made;
}

static double window_at(double share)
{
    return 0.5 - 0.5 * cos(2 * M_PI * share);
}

/* Adds the power of one segment at each frequency: a Hann window, then a Fourier sum. */
static void add_segment(const sb_curve *record, double from, double length, sb_curve *spectrum)
{
    double mean = sb_curve_mean(record, from, from + length), weight = 0;
    double step = record->count > 1 ? record->x[1] - record->x[0] : (double)NAN;
    double cosines[BINS] = {0}, sines[BINS] = {0};
    for (size_t i = 0; i < record->count; i++) {
        if (record->x[i] < from || record->x[i] >= from + length) continue;
        const double w = window_at((record->x[i] - from) / length), value = w * (record->y[i] - mean);
        weight += w * w;
        for (size_t k = 0; k < spectrum->count; k++) {
            const double angle = 2 * M_PI * spectrum->x[k] * record->x[i];
            cosines[k] += value * cos(angle);
            sines[k] += value * sin(angle);
        }
    }
    for (size_t k = 0; k < spectrum->count; k++)
        spectrum->y[k] += 2 * step * (cosines[k] * cosines[k] + sines[k] * sines[k]) / weight;
}

/* Density of the energy over the frequency, m^2 s, from 0.5 to 3 peak frequencies: Welch's method with segments that
   overlap by half. */
static sb_curve *spectrum_of(const sb_case_run *run, const sb_curve *record)
{
    const double period = run->scene->wavemakers[0].law.period, last = run->scene->duration, length = SEGMENT * period;
    sb_curve *spectrum = sb_curve_new(run->made);
    int segments = 0;
    for (int k = 0; k < BINS; k++) sb_curve_add(spectrum, (0.5 + 2.5 * k / (BINS - 1)) / period, 0);
    for (double from = BEGIN * period; from + length <= last + 1e-6; from += 0.5 * length, segments++)
        add_segment(record, from, length, spectrum);
    sb_curve_map(spectrum, 1, 0, segments ? 1.0 / segments : (double)NAN, 0);
    return spectrum;
}

/* Of the energy between 0.5 and 3 peak frequencies. */
typedef struct sea {
    double height, period; /* m: 4 sqrt(m0); s: sqrt(m0/m2) */
} sea;

/* Sums over all frequencies of the record that lie in the band: no segments and no window, which would be chosen. */
static sea sea_of(const sb_case_run *run, const sb_curve *record)
{
    const double period = run->scene->wavemakers[0].law.period, first = BEGIN * period,
                 length = run->scene->duration - first;
    double m0 = 0, m2 = 0;
    for (int n = (int)ceil(0.5 * length / period); n <= 3 * length / period; n++) {
        const double frequency = n / length;
        double cosine = 0, sine = 0, count = 0;
        for (size_t i = 0; i < record->count; i++) {
            if (record->x[i] < first || record->x[i] >= first + length) continue;
            cosine += record->y[i] * cos(2 * M_PI * frequency * record->x[i]);
            sine += record->y[i] * sin(2 * M_PI * frequency * record->x[i]);
            count++;
        }
        const double power = 2 * (cosine * cosine + sine * sine) / (count * count);
        m0 += power;
        m2 += power * frequency * frequency;
    }
    return (sea){4 * sqrt(m0), sqrt(m0 / m2)};
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_curve *record = sb_wave_fit_gauge(run, run->scene->measure.gauges[0].name);
    const sea own = sea_of(run, record), linear = sea_of(run, linear_record(run, record));
    sb_figure_share(figures, "significant height", "m", linear.height, own.height, linear.height, 4,
                    "4 sqrt(m0) from 0.5 to 3 peak frequencies; linear theory in the same window; aimed at: %.4g m",
                    run->scene->wavemakers[0].law.height);
    sb_figure_share(figures, "period Tm02", "s", linear.period, own.period, linear.period, 2,
                    "sqrt(m0/m2) in the same band");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const sb_case_run *last = &runs[count - 1];
    sb_curve *record = sb_wave_fit_gauge(last, last->scene->measure.gauges[0].name),
             *linear = linear_record(last, record);
    const double period = last->scene->wavemakers[0].law.period;
    sb_plot_panel(plot, "Spectrum at the gauge", "frequency (1/s)", "m2 s");
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "linear theory", spectrum_of(last, linear));
    for (size_t i = 0; i < count; i++)
        sb_plot_run(plot, &runs[i],
                    spectrum_of(&runs[i], sb_wave_fit_gauge(&runs[i], runs[i].scene->measure.gauges[0].name)));
    sb_plot_panel(plot, "Surface at the gauge, the last twenty peak periods", "time (s)", "m");
    sb_plot_range(plot, last->scene->duration - 20 * period, last->scene->duration, (double)NAN, (double)NAN);
    sb_plot_curve(plot, SB_PLOT_REFERENCE, "linear theory", linear);
    for (size_t i = 0; i < count; i++)
        sb_plot_run(plot, &runs[i], sb_wave_fit_gauge(&runs[i], runs[i].scene->measure.gauges[0].name));
}

static const char *const shorter[] = {"duration=550", NULL};

const sb_case sb_case_jonswap = {
    .name = "jonswap",
    .title = "Irregular waves with a JONSWAP spectrum over 300 peak periods",
    .targets = "significant height: within 4 %; Tm02: within 2 %",
    .method =
        "Reference: the sum of the same 200 components by linear theory at the same place and times, so that nothing "
        "is left to chance.\nThe gauge stands one wavelength of the peak ahead of the paddle; kd is 1 at the peak, Hs "
        "0.024 wavelengths. Moments: sums over all\nfrequencies of both records, from 15 peak periods on, between 0.5 "
        "and 3 peak frequencies, without segments or window. The spectrum of the plot has segments of 30 peak periods "
        "with a Hann window. No filter, no time\nshift. The quick form has 60 peak periods.",
    .scene = "jonswap/jonswap.yaml",
    .headline = "significant height",
    .full = {{.resolution = 0.8}, {.resolution = 0.6, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 1.6, .judged = true, .settings = shorter}},
    .evaluate = evaluate,
    .plot = plot};

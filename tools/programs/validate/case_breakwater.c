/* A breakwater that closes half of a narrow basin: reflection, diffraction and the energy that is left. */
#include "cases.h"
#include "physics/waves/steady_wave.h"
#include "wave_fit.h"

#include <math.h>

enum { WINDOW = 2 }; /* periods, the last ones of the run */

static double first_harmonic(const sb_case_run *run, const char *gauge)
{
    const double period = run->scene->wavemakers[0].law.period, last = run->scene->duration;
    return sb_wave_fit_of(sb_wave_fit_gauge(run, gauge), period, last - WINDOW * period, last).amplitude[0];
}

/* The second harmonic of waves as long as these runs nearly as fast as the first. */
static sb_split split_at(const sb_case_run *run, const char *prefix, int harmonic)
{
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    const double last = run->scene->duration;
    return sb_wave_fit_split(run, prefix, law->period / harmonic, harmonic * sb_wave_fit_number(law),
                             last - WINDOW * law->period, last);
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_split in = split_at(run, "in", 1), out = split_at(run, "out", 1);
    const sb_split in_second = split_at(run, "in", 2), out_second = split_at(run, "out", 2);
    const double reflected = in.reflected / in.incident, passed = out.incident / in.incident;
    const double came = pow(in.incident, 2) + pow(in_second.incident, 2);
    const double went =
        pow(in.reflected, 2) + pow(in_second.reflected, 2) + pow(out.incident, 2) + pow(out_second.incident, 2);
    const sb_wavemaker_parameters *law = &run->scene->wavemakers[0].law;
    sb_steady_wave wave;
    const bool steady = sb_steady_wave_of(law->height, law->period, law->depth, law->gravity, &wave);
    sb_figure_report(figures, "reflected", "", (double)NAN, reflected,
                     "amplitude over the incident one, first harmonic, "
                     "four gauges seaward");
    sb_figure_report(figures, "passed", "", (double)NAN, passed,
                     "amplitude over the incident one, four gauges landward");
    sb_figure_report(figures, "energy that is neither reflected nor passed", "%", (double)NAN, 100 * (1 - went / came),
                     "of the incident energy, first and second harmonic: lost at the edge of the breakwater and on the "
                     "way of the waves, or given to higher harmonics");
    sb_figure_report(figures, "second harmonic over first, incident", "", (double)NAN, in_second.incident / in.incident,
                     "amplitudes");
    sb_figure_report(figures, "second harmonic over first, passed", "", (double)NAN, out_second.incident / out.incident,
                     "amplitudes");
    sb_figure_report(figures, "incident height, first harmonic over aimed", "",
                     steady ? 2 * wave.first / law->height : (double)NAN, 2 * in.incident / law->height,
                     "of the four gauges seaward; reference: a steady wave of the height aimed at");
    sb_figure_report(figures, "before the breakwater, over the incident amplitude", "", (double)NAN,
                     first_harmonic(run, "front") / in.incident, "gauge 0.1 m before its face");
    sb_figure_report(figures, "in the gap, over the incident amplitude", "", (double)NAN,
                     first_harmonic(run, "gap") / in.incident, "first harmonic");
    sb_figure_report(figures, "behind the breakwater, over the incident amplitude", "", (double)NAN,
                     first_harmonic(run, "lee") / in.incident, "gauge 0.16 m behind it");
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const char *const gauges[] = {"front", "gap", "lee"};
    static const char *const titles[] = {"Before the breakwater", "In the gap", "Behind the breakwater"};
    for (int g = 0; g < 3; g++) {
        sb_plot_panel(plot, titles[g], "time (s)", "surface (m)");
        for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], sb_wave_fit_gauge(&runs[i], gauges[g]));
    }
}

static const char *const plain[] = {"render.interval=0", NULL};

const sb_case sb_case_breakwater = {
    .name = "breakwater",
    .title = "Long waves at a breakwater that closes half of a basin",
    .targets = "none: there are no data in numbers to judge by",
    .method = "The set-up of Wen et al., section 5, after Lara et al.: H 0.06 m, T 2 s, 0.25 m of water, a breakwater "
              "of 0.24 by 0.3 m "
              "in a basin\nof 0.585 m, attached to its side. H L^2/d^3 is 34.6: the paddle makes cnoidal waves. The "
              "paper shows the "
              "experiment as curves\nonly: a local increase of the waves before the breakwater, and waves that bend "
              "around its head into "
              "its lee. First harmonics of\nthe last two periods of 17 s; waves are split with the wave number of "
              "steady waves, the second harmonic with twice that, four gauges on each side.",
    .scene = "../scenes/breakwater.yaml",
    .headline = "reflected",
    .full = {{.resolution = 0.02, .settings = plain}, {.resolution = 0.01, .judged = true, .settings = plain}},
    .quick = {{.resolution = 0.045, .judged = true, .settings = plain}},
    .evaluate = evaluate,
    .plot = plot};

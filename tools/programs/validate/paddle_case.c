#include "paddle_case.h"

#include "physics/waves/dispersion.h"
#include "wave_fit.h"

#include <math.h>

enum { DRIFT_PERIODS = 10, DRIFT_AFTER = 100 };

/* %, of the stroke */
static const double DRIFT_LIMIT = 1;

void sb_paddle_plot(const sb_case_run *runs, size_t count, const char *title, const char *gauge, sb_plot *plot)
{
    sb_plot_panel(plot, title, "time (periods)", "over the height aimed at");
    for (size_t i = 0; i < count; i++) {
        const sb_wavemaker_parameters *law = &runs[i].scene->wavemakers[0].law;
        sb_curve *eta = sb_wave_fit_gauge(&runs[i], gauge);
        sb_curve_map(eta, 1 / law->period, 0, 1 / law->height, 0);
        sb_plot_run(plot, &runs[i], eta);
    }
}

void sb_paddle_drift(const sb_case_run *run, sb_figures *figures)
{
    const sb_wavemaker_use *maker = &run->scene->wavemakers[0];
    const sb_wavemaker_parameters *law = &maker->law;
    if (!law->absorb) return;
    const double end = run->scene->duration, kd = law->depth * sb_wave_number(law->period, law->depth, law->gravity);
    const double stroke = law->height / sb_piston_height_over_stroke(kd);
    const sb_curve *offset = sb_run_curve(run, "absorbers.csv", maker->body, "time_s", "offset_m");
    const double drift = 100 * sb_curve_mean(offset, end - DRIFT_PERIODS * law->period, end) / stroke;
    static const char note[] = "mean displacement from the law over the last %d periods, over the stroke; largest in "
                               "any such ten before %.2g %%";
    double most = 0;
    for (double to = end; to >= DRIFT_PERIODS * law->period; to -= DRIFT_PERIODS * law->period)
        most = fmax(most, fabs(sb_curve_mean(offset, to - DRIFT_PERIODS * law->period, to)));
    most *= 100 / stroke;
    if (end >= (DRIFT_AFTER - 0.1) * law->period)
        sb_figure_below(figures, "drift of the paddle", "%", fabs(drift), DRIFT_LIMIT, note, DRIFT_PERIODS, most);
    else
        sb_figure_report(figures, "drift of the paddle", "%", 0, drift, note, DRIFT_PERIODS, most);
}

/* Stress cases of shallow water: a flume of 1000 to 1, films of two particles. */
#include "stresses.h"

#include <math.h>
#include <string.h>

static void plan_flume(sb_trials *trials, bool quick)
{
    sb_trial *t = sb_trial_add(trials, "flume.yaml", quick ? "20 m" : "100 m");
    if (!quick) return;
    sb_trial_set(t, "duration=0.5");
    sb_trial_set(t, "domain.max=[20, 0.3]");
    sb_trial_set(t, "water.seed=[10, 0.05]");
    sb_trial_set(t, "measure.gauges=[{name: near, x: 0.5}, {name: quarter, x: 5}, {name: middle, x: 10}, "
                    "{name: far, x: 19.5}]");
}

/* Largest deviation from the level at one gauge. */
static double gauge_error(const sb_judged *j, const char *gauge, double level)
{
    sb_curve curve = {0};
    double worst = (double)NAN;
    if (sb_outcome_curve(&j->outcome, "gauges.csv", gauge, "time_s", "z_m", &curve, NULL) == SB_OK)
        for (size_t i = 0; i < curve.count; i++) {
            const double off = fabs(curve.y[i] - level);
            if (i == 0 || !(off <= worst)) worst = off;
        }
    sb_curve_free(&curve);
    return worst;
}

static void judge_flume(sb_judged *j)
{
    static const char *const gauges[] = {"near", "quarter", "middle", "far"};
    double worst = 0;
    for (int g = 0; g < 4; g++) {
        const double off = gauge_error(j, gauges[g], 0.1);
        if (!(off <= worst)) worst = off;
    }
    sb_note(j, "largest deviation of the surface %.3f δr", worst / 0.025);
    sb_require(j, worst < 0.5 * 0.025, "the surface is not level");
}

const sb_stress sb_stress_flume = {
    .name = "flume",
    .title = "A flume of 1000 to 1",
    .rules = "The surface stays within half a spacing of the level at both ends, at a quarter of the length and in the "
             "middle",
    .plan = plan_flume,
    .judge = judge_flume,
};

static void plan_film(sb_trials *trials, bool quick)
{
    sb_trial *t = sb_trial_add(trials, "film.yaml", "slice");
    if (quick) sb_trial_set(t, "duration=4");
    sb_trial_drive(t, &sb_drive_plain, 0);
    sb_trial_drive(sb_trial_add(trials, "film-slope.yaml", "slope-3d"), &sb_drive_plain, 0);
}

static void judge_film(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    const double peak = sb_outcome_number(o, "energy_peak_J") / sb_energy_of(j, false);
    const double speed = sb_outcome_number(o, "late_rms_speed") / sb_outcome_number(o, "wave_speed");
    sb_note(j, "highest energy %.5f of the initial energy", peak);
    sb_note(j, "mean speed %.2g of √(gD)", speed);
    sb_require(j, peak < 1.01, "the energy increases");
    if (strcmp(j->trial->name, "slice") == 0) sb_require(j, speed < 0.01, "the film does not come to rest");
}

const sb_stress sb_stress_film = {
    .name = "film",
    .title = "A film of two particles",
    .rules = "The mean speed on a level floor stays below 1 % of √(gD); the energy never rises by more than 1 %",
    .plan = plan_film,
    .judge = judge_film,
};

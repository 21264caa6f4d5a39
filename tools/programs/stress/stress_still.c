/* Stress case: still water for ten thousand steps. */
#include "stresses.h"

#include <math.h>

/* Duration of so many default time steps, time_step_factor h/sqrt(g D). */
static double duration(int dimensions, double spacing, double depth, double steps)
{
    const double factor = sb_trial_default(dimensions, "time_step_factor"),
                 support = sb_trial_default(dimensions, "support");
    return steps * factor * support * spacing / sqrt(9.81 * depth);
}

static void add(sb_trials *trials, const char *scene, int dimensions, const char *name, double spacing, double depth,
                double steps)
{
    sb_trial *t = sb_trial_add(trials, scene, "%s", name);
    sb_trial_set(t, "resolution=%g", spacing);
    sb_trial_set(t, "duration=%g", duration(dimensions, spacing, depth, steps));
    sb_trial_drive(t, &sb_drive_plain, steps);
}

static void plan(sb_trials *trials, bool quick)
{
    if (quick) {
        add(trials, "still.yaml", 2, "slice-0.1", 0.1, 0.5, 1000);
        return;
    }
    add(trials, "still.yaml", 2, "slice-0.1", 0.1, 0.5, 10000);
    add(trials, "still.yaml", 2, "slice-0.05", 0.05, 0.5, 10000);
    add(trials, "still.yaml", 2, "slice-0.025", 0.025, 0.5, 10000);
    add(trials, "basin.yaml", 3, "basin-0.1", 0.1, 0.6, 10000);
}

static void judge(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    const double speed = sb_outcome_number(o, "late_rms_speed") / sb_outcome_number(o, "wave_speed");
    const double weight = sb_outcome_number(o, "mass_kg") * sb_outcome_number(o, "gravity");
    const double rise = (sb_outcome_number_in(o, "energy_end", "potential_J") -
                         sb_outcome_number_in(o, "energy_start", "potential_J")) /
                        (weight * sb_outcome_number(o, "resolution_m"));
    sb_note(j, "mean speed %.2g of √(gD)", speed);
    sb_note(j, "centre of mass moved %+.2g δr", rise);
    sb_require(j, speed < 0.01, "the water does not come to rest");
    sb_require(j, fabs(rise) < 0.1, "the centre of mass has moved");
    sb_require(j, sb_outcome_number(o, "steps") >= 0.99 * j->trial->number, "fewer steps than requested");
}

const sb_stress sb_stress_still = {
    .name = "still-water",
    .title = "Still water for 10 000 steps",
    .rules = "The root mean square speed stays below 1 % of √(gD) in the second half; the centre of mass moves by less "
             "than a "
             "tenth of a spacing",
    .plan = plan,
    .judge = judge,
};

/* Stress cases of impacts: a dropped column, a jet on a corner. */
#include "stresses.h"

#include <math.h>

/* The energy must not rise above the initial energy. */
static void judge(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    const double peak = sb_outcome_number(o, "energy_peak_J") / sb_energy_of(j, false);
    sb_note(j, "highest energy %.5f of the initial energy", peak);
    sb_note(j, "energy at the end %.2f", sb_energy_of(j, true) / sb_energy_of(j, false));
    sb_note(j, "top speed %.3g m/s", sb_outcome_number(o, "top_speed"));
    sb_require(j, peak < 1.005, "the energy increases");
}

static void plan_drop(sb_trials *trials, bool quick)
{
    sb_trial_drive(sb_trial_add(trials, "drop.yaml", "slice"), &sb_drive_plain, 0);
    if (quick) return;
    sb_trial *t = sb_trial_add(trials, "drop.yaml", "slice-paper");
    sb_trial_set(t, "numerics.preset=paper");
    sb_trial_drive(t, &sb_drive_plain, 0);
    sb_trial_drive(sb_trial_add(trials, "drop-3d.yaml", "3d"), &sb_drive_plain, 0);
}

const sb_stress sb_stress_drop = {
    .name = "drop",
    .title = "A column 50 spacings high dropped",
    .rules =
        "The energy, with potential energy counted from the floor, never exceeds the initial energy by more than 0.5 %",
    .plan = plan_drop,
    .judge = judge,
};

/* Gives the block a velocity of ten times sqrt(g D), D being its depth, in the direction (x, y, z). */
static void aim(sb_trials *trials, const char *scene, const char *name, double depth, sb_vec3 towards, bool flat)
{
    sb_trial *t = sb_trial_add(trials, scene, "%s", name);
    const sb_vec3 v = sb_scale(sb_normalize(towards), 10 * sqrt(9.81 * depth));
    if (flat)
        sb_trial_set(t, "water.boxes[0].velocity=[%.9g, %.9g]", v.x, v.z);
    else
        sb_trial_set(t, "water.boxes[0].velocity=[%.9g, %.9g, %.9g]", v.x, v.y, v.z);
    sb_trial_drive(t, &sb_drive_plain, 0);
}

static void plan_jet(sb_trials *trials, bool quick)
{
    /* Into the corner between side and lid, and onto the upper edge of the block. */
    aim(trials, "jet.yaml", "slice-into-corner", 0.2, sb_vec(-0.2, 0, 0.3), true);
    aim(trials, "jet.yaml", "slice-onto-edge", 0.2, sb_vec(0.3, 0, -0.3), true);
    if (quick) return;
    aim(trials, "jet-3d.yaml", "3d-into-corner", 0.2, sb_vec(-0.18, -0.18, 0.3), false);
    aim(trials, "jet-3d.yaml", "3d-onto-corner", 0.2, sb_vec(0.3, 0.3, -0.3), false);
}

const sb_stress sb_stress_jet = {
    .name = "jet",
    .title = "A jet at 10 √(gD) on a corner",
    .rules =
        "The energy, with potential energy counted from the floor, never exceeds the initial energy by more than 0.5 %",
    .plan = plan_jet,
    .judge = judge,
};

/* Stress case: plates thinner than the support radius, with water on one side or different levels on both. */
#include "stresses.h"

#include <math.h>
#include <string.h>

static const double spacing = 0.025, level = 0.5, other = 0.25; /* m */

/* kept: impulse and time when the second half began, particles on the far side at the start, a flag. */
enum { IMPULSE, BEGAN, FAR, HAS_BEGUN };

static size_t plate_of(const sb_driven *d)
{
    for (size_t b = 0; b < d->model.body_count; b++)
        if (strcmp(d->model.bodies[b].name, "plate") == 0) return b;
    return 0;
}

/* Number of particles to the right of the middle of the plate (number). */
static double beyond(const sb_driven *d)
{
    double count = 0;
    for (size_t i = 0; i < sb_sim_report(d->sim)->fluid_count; i++)
        count += sb_sim_particle(d->sim, i).position.x > d->number;
    return count;
}

static sb_status note_start(sb_driven *d, sb_error *error)
{
    (void)error;
    for (size_t i = 0; i < d->model.fluid_count; i++) d->kept[FAR] += d->model.fluid_position[i].x > d->number;
    return SB_OK;
}

static void watch(sb_driven *d)
{
    if (d->kept[HAS_BEGUN] > 0 || sb_sim_report(d->sim)->time < 0.5 * d->scene.duration) return;
    d->kept[HAS_BEGUN] = 1;
    d->kept[BEGAN] = sb_sim_report(d->sim)->time;
    d->kept[IMPULSE] = sb_sim_impulse(d->sim, plate_of(d))->pressure.x;
}

static void finish(sb_driven *d, sb_json *figures)
{
    const double time = sb_sim_report(d->sim)->time - d->kept[BEGAN];
    sb_json_number(figures, "crossed", beyond(d) - d->kept[FAR]);
    sb_json_number(figures, "force", (sb_sim_impulse(d->sim, plate_of(d))->pressure.x - d->kept[IMPULSE]) / time);
}

static const sb_drive drive = {.alter = note_start, .watch = watch, .close = finish};

static void add(sb_trials *trials, double thickness, bool both)
{
    sb_trial *t = sb_trial_add(trials, "plate.yaml", "%g-dr-%s", thickness, both ? "two-levels" : "one-side");
    const double right = 1 + thickness * spacing;
    sb_trial_set(t, "bodies.plate.max=[%.9g, 0.8]", right);
    if (both) sb_trial_set(t, "water.boxes=[{min: [%.9g, 0], max: [2, %g]}]", right, other);
    if (thickness < 0.5) t->ends |= SB_ENDS_REFUSED;
    sb_trial_drive(t, &drive, 1 + 0.5 * thickness * spacing);
}

static void plan(sb_trials *trials, bool quick)
{
    static const double thickness[] = {2, 1, 4, 0.5, 0.25, 0.05};
    for (size_t i = 0; i < (quick ? 2 : sizeof thickness / sizeof *thickness); i++) {
        add(trials, thickness[i], false);
        if (!quick) add(trials, thickness[i], true);
    }
    for (int n = 4; n >= 1 && !quick; n /= 2) {
        sb_trial *t = sb_trial_add(trials, "plate-3d.yaml", "%d-dr-trough", n);
        sb_trial_set(t, "bodies.plate.max=[%g, 0.6, 0.7]", 0.7 + 0.05 * n);
        sb_trial_drive(t, &drive, 0.7 + 0.025 * n);
    }
}

static void judge(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    if (o->how == SB_ENDS_REFUSED) {
        sb_note(j, "refused: %.180s", o->last_line);
        return;
    }
    const bool both = strstr(j->trial->name, "two-levels"), trough = strstr(j->trial->name, "trough");
    const double held = level * level - (both ? other * other : 0);
    const double exact = 0.5 * 1000 * 9.81 * held * (trough ? 0.4 : 1);
    const double share = sb_outcome_number(o, "force") / exact, crossed = sb_outcome_number(o, "crossed");
    sb_note(j, "force %.3f of ½ρgD²", share);
    sb_note(j, "%g particles crossed", crossed);
    sb_require(j, crossed == 0, "water crosses the plate");
    sb_require(j, fabs(share - 1) < 0.1, "the force differs from the hydrostatic force");
}

const sb_stress sb_stress_plates = {
    .name = "plates",
    .title = "Plates of one and two spacings, and thinner",
    .rules =
        "No particle crosses the plate; the mean force over the second half is within 10 % of the hydrostatic force; a "
        "plate thinner than half a spacing may be refused with the reason instead",
    .plan = plan,
    .judge = judge,
};

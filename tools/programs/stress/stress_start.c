/* Stress cases of irregular starts: jittered, overlapping and coincident particles, one particle, spray. */
#include "stresses.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

/* Index of the particle nearest to particle i. */
static size_t nearest_to(const sb_model *m, size_t i)
{
    size_t found = i;
    double least = HUGE_VAL;
    for (size_t k = 0; k < m->fluid_count; k++) {
        const double r = sb_norm(sb_sub(m->fluid_position[k], m->fluid_position[i]));
        if (k == i || r >= least) continue;
        least = r;
        found = k;
    }
    return found;
}

/* Puts one particle in `number` a tenth of a spacing from its nearest neighbour. */
static sb_status overlap(sb_driven *d, sb_error *error)
{
    (void)error;
    sb_model *m = &d->model;
    for (size_t i = 0; i < m->fluid_count; i += (size_t)d->number) {
        const sb_vec3 beside = m->fluid_position[nearest_to(m, i)];
        const sb_vec3 apart = sb_normalize(sb_sub(m->fluid_position[i], beside));
        m->fluid_position[i] = sb_madd(beside, 0.1 * m->spacing, apart);
    }
    return SB_OK;
}

/* Puts two particles into exactly the same place, in the middle of the water. */
static sb_status coincide(sb_driven *d, sb_error *error)
{
    (void)error;
    sb_model *m = &d->model;
    const size_t i = m->fluid_count / 2;
    m->fluid_position[i] = m->fluid_position[nearest_to(m, i)];
    return SB_OK;
}

/* Puts `number` particles at random places with random velocities of up to 5 m/s along each axis. */
static sb_status scatter(sb_driven *d, sb_error *error)
{
    sb_model *m = &d->model;
    const size_t count = (size_t)d->number;
    const sb_vec3 size = sb_sub(m->max, m->min);
    sb_free(m->fluid_position);
    sb_free(m->fluid_velocity);
    sb_free(m->fluid_pressure);
    m->fluid_count = count;
    m->fluid_position = sb_alloc(count, sizeof *m->fluid_position);
    m->fluid_velocity = sb_alloc(count, sizeof *m->fluid_velocity);
    m->fluid_pressure = sb_alloc(count, sizeof *m->fluid_pressure);
    if (!m->fluid_position || !m->fluid_velocity || !m->fluid_pressure) return sb_fail_memory(error, "spray");
    for (size_t i = 0; i < count; i++) {
        double u[6];
        for (size_t k = 0; k < 6; k++) u[k] = sb_random(1, 6 * i + k);
        m->fluid_position[i] = sb_add(m->min, sb_vec(u[0] * size.x, u[1] * size.y, u[2] * size.z));
        m->fluid_velocity[i] = sb_vec(10 * u[3] - 5, 10 * u[4] - 5, 10 * u[5] - 5);
    }
    return SB_OK;
}

/* kept: start of the particle, longest time step, largest distance from the exact parabola. */
enum { X0, Y0, Z0, LONGEST, OFF_EXACT };

static sb_status throw_one(sb_driven *d, sb_error *error)
{
    (void)error;
    const sb_vec3 at = d->model.fluid_position[0];
    d->model.fluid_count = 1;
    d->kept[Z0] = at.z;
    d->kept[X0] = at.x;
    d->kept[Y0] = at.y;
    return SB_OK;
}

static void follow(sb_driven *d)
{
    const sb_step_report *r = sb_sim_report(d->sim);
    const sb_vec3 v = d->model.fluid_velocity[0], at = sb_sim_particle(d->sim, 0).position;
    const double x = d->kept[X0] + v.x * r->time, y = d->kept[Y0] + v.y * r->time;
    const double exact = d->kept[Z0] + v.z * r->time - 0.5 * 9.81 * r->time * r->time;
    d->kept[LONGEST] = fmax(d->kept[LONGEST], r->time_step);
    d->kept[OFF_EXACT] = fmax(d->kept[OFF_EXACT], sb_norm(sb_sub(at, sb_vec(x, y, exact))));
}

static void finish(sb_driven *d, sb_json *figures)
{
    sb_json_number(figures, "off_exact", d->kept[OFF_EXACT] / d->model.spacing);
    sb_json_number(figures, "first_order", 0.5 * 9.81 * d->kept[LONGEST] * d->scene.duration / d->model.spacing);
}

static const sb_drive overlapping = {.alter = overlap}, coincident = {.alter = coincide}, spray = {.alter = scatter};
static const sb_drive thrown = {.alter = throw_one, .watch = follow, .close = finish};

static sb_trial *at_rest(sb_trials *trials, const char *name, bool settles)
{
    sb_trial *t = sb_trial_add(trials, "still.yaml", "%s%s", name, settles ? "" : "-unsettled");
    sb_trial_set(t, "resolution=0.05");
    sb_trial_set(t, "duration=10");
    if (!settles) sb_trial_set(t, "numerics.settle_steps=0");
    return t;
}

static void plan(sb_trials *trials, bool quick)
{
    static const char *const jitters[] = {"0", "0.1", "0.2", "0.3"};
    for (int k = 0; k < 4; k++) {
        if (quick && k != 3) continue;
        char name[32] = "jitter-";
        strncat(name, jitters[k], 8);
        sb_trial *t = at_rest(trials, name, true);
        sb_trial_set(t, "numerics.jitter=%s", jitters[k]);
        sb_trial_drive(t, &sb_drive_plain, 0);
    }
    for (int settles = 1; settles >= 0; settles--) {
        if (quick && settles) continue;
        sb_trial_drive(at_rest(trials, "overlap-5-percent", settles), &overlapping, 20);
        sb_trial_drive(at_rest(trials, "two-coincident", settles), &coincident, 0);
    }
    sb_trial_drive(sb_trial_add(trials, "air.yaml", "alone"), &thrown, 0);
    sb_trial *t = sb_trial_add(trials, "air.yaml", "spray");
    sb_trial_set(t, "duration=%g", quick ? 1.0 : 4.0);
    sb_trial_drive(t, &spray, 3000);
}

static void judge(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    const bool alone = strcmp(j->trial->name, "alone") == 0, flies = strcmp(j->trial->name, "spray") == 0;
    const double peak = sb_outcome_number(o, "energy_peak_J") / sb_energy_of(j, false);
    const double speed = sb_outcome_number(o, "late_rms_speed") / sb_outcome_number(o, "wave_speed");
    if (alone) {
        const double exact = sb_outcome_number(o, "off_exact");
        sb_note(j, "distance from the exact parabola %.1e δr", exact);
        sb_note(j, "g dt t/2 is %.2f δr", sb_outcome_number(o, "first_order"));
        sb_require(j, exact < 1e-3, "the particle is off the exact parabola");
        return;
    }
    sb_note(j, "highest energy %.4f of the initial energy", peak);
    if (!flies) sb_note(j, "mean speed %.2g of √(gD) in the second half", speed);
    /* Overlapping particles that do not settle are under pressure, which releases more than the initial kinetic
     * energy. */
    sb_require(j, peak < (strstr(j->trial->name, "unsettled") ? 1.1 : 1.005), "the energy increases");
    if (!flies) sb_require(j, speed < 0.02, "the water does not come to rest");
}

const sb_stress sb_stress_start = {
    .name = "start",
    .title = "Jittered, overlapping, coincident particles; one alone; all spray",
    .rules =
        "The mean speed of water falls below 2 % of √(gD) in the second half of 5 s; the energy, also of spray, never "
        "exceeds the initial energy by more than 0.5 %, or 10 % for overlapping particles without settling; a single "
        "particle stays within 0.001 δr of its parabola",
    .plan = plan,
    .judge = judge,
};

/* Samples walls at `number` times the spacing, with the boundary particles at the same depth. */
static sb_status resample(sb_driven *d, sb_error *error)
{
    sb_scene other = d->scene;
    sb_model model = {0};
    other.resolution *= d->number;
    other.numerics.wall_offset /= d->number;
    other.numerics.support /= d->number;
    sb_status status = sb_model_build(&other, &model, error);
    if (status != SB_OK) return status;
    sb_vec3 *position = d->model.wall_position, *normal = d->model.wall_normal;
    d->model.wall_count = model.wall_count;
    d->model.wall_position = model.wall_position;
    d->model.wall_normal = model.wall_normal;
    model.wall_position = position;
    model.wall_normal = normal;
    for (size_t b = 0; b < d->model.body_count; b++) {
        d->model.bodies[b].begin = model.bodies[b].begin;
        d->model.bodies[b].count = model.bodies[b].count;
    }
    sb_model_free(&model);
    return SB_OK;
}

static const sb_drive resampled = {.alter = resample};

static void plan_sampling(sb_trials *trials, bool quick)
{
    static const double times[] = {0.5, 1, 2, 4};
    for (int k = 0; k < 4; k++) {
        sb_trial *t = sb_trial_add(trials, "still.yaml", "slice-x%g", times[k]);
        sb_trial_set(t, "resolution=0.05");
        sb_trial_set(t, "duration=%g", quick ? 2.0 : 5.0);
        sb_trial_drive(t, &resampled, 1 / times[k]);
        if (quick) continue;
        t = sb_trial_add(trials, "basin.yaml", "basin-x%g", times[k]);
        sb_trial_set(t, "duration=4");
        sb_trial_drive(t, &resampled, 1 / times[k]);
        if (times[k] == 4) t->ends |= SB_ENDS_FAILED; /* sixteen times as many boundary particles */
    }
}

static void judge_sampling(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    if (o->how == SB_ENDS_FAILED && (j->trial->ends & SB_ENDS_FAILED)) {
        sb_note(j, "failed: %.180s", o->last_line);
        sb_require(j, strstr(o->last_line, "step 0: more than"), "it fails for another reason");
        return;
    }
    const double speed = sb_outcome_number(o, "late_rms_speed") / sb_outcome_number(o, "wave_speed");
    const double weight = sb_outcome_number(o, "mass_kg") * sb_outcome_number(o, "gravity");
    const double height = sb_outcome_number_in(o, "energy_end", "potential_J") / weight;
    const double spacing = sb_outcome_number(o, "resolution_m");
    sb_note(j, "mean speed %.2g of √(gD)", speed);
    sb_require(j, speed < 0.02, "the water does not come to rest");
    const bool slice = strncmp(j->trial->name, "slice", 5) == 0;
    const sb_judged *usual = sb_judged_find(j, slice ? "slice-x1" : "basin-x1");
    const double usual_height =
        usual ? sb_outcome_number_in(&usual->outcome, "energy_end", "potential_J") / weight : (double)NAN;
    sb_note(j, "centre of mass %+.3f δr from that of the usual sampling", (height - usual_height) / spacing);
    sb_require(j, fabs(height - usual_height) < 0.25 * spacing, "the centre of mass differs");
}

const sb_stress sb_stress_sampling = {
    .name = "sampling",
    .title = "Walls sampled at half, twice and four times the usual number per length",
    .rules =
        "The mean speed of still water stays below 2 % of √(gD) in the second half; its centre of mass is within a "
        "quarter of a spacing of that with the usual sampling; more boundary particles around a place than the lists "
        "can hold are reported in the first step",
    .plan = plan_sampling,
    .judge = judge_sampling,
};

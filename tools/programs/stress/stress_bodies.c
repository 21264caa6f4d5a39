/* Stress cases of bodies: defective meshes, bodies under water at the start, fast paddles. */
#include "stresses.h"

#include <math.h>
#include <string.h>

enum { SEEDS = 5 };

static void plan_meshes(sb_trials *trials, bool quick)
{
    static const char *const meshes[] = {"inverted", "flipped",         "hole",   "open-below", "gaps",
                                         "doubled",  "doubled-against", "slivers"};
    for (int s = 1; s <= SEEDS; s++)
        sb_trial_set(sb_trial_add(trials, "bore-mesh.yaml", "clean-seed-%d", s), "numerics.seed=%d", s);
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        if (quick && i != 1 && i != 2 && i != 7) continue;
        sb_trial *t = sb_trial_add(trials, "bore-mesh.yaml", "%s", meshes[i]);
        sb_trial_set(t, "bodies.column.file=meshes/%s.obj", meshes[i]);
        t->ends |= SB_ENDS_REFUSED;
    }
}

static double along(const sb_judged *j)
{
    return sb_outcome_vector(&j->outcome, "column", "impulse_vector_Ns").x;
}

static void judge_meshes(sb_judged *j)
{
    if (j->outcome.how == SB_ENDS_REFUSED) {
        sb_note(j, "refused: %.180s", j->outcome.last_line);
        return;
    }
    const sb_spread sound = sb_judged_spread(j, "clean", along);
    sb_note(j, "impulse %.2f N s", along(j));
    if (strncmp(j->trial->name, "clean", 5) == 0) return;
    sb_note(j, "sound mesh, five seeds: %.2f to %.2f", sound.low, sound.high);
    sb_require(j, sound.count == SEEDS, "the seeds have not run");
    sb_require(j, fabs(along(j) - sound.mean) <= sound.high - sound.low,
               "differs by more than the spread of the seeds");
}

const sb_stress sb_stress_meshes = {
    .name = "meshes",
    .title = "Wall meshes with turned faces, gaps, doubled faces, slivers",
    .rules =
        "The mesh is refused, or the impulse on the column differs from the mean of five start seeds with the sound "
        "mesh by at most their spread (largest minus smallest)",
    .plan = plan_meshes,
    .judge = judge_meshes,
};

/* kept: impulse (z) and time when the second half began. */
enum { IMPULSE, BEGAN, HAS_BEGUN };

static void watch(sb_driven *d)
{
    if (d->kept[HAS_BEGUN] > 0 || sb_sim_report(d->sim)->time < 0.5 * d->scene.duration) return;
    d->kept[HAS_BEGUN] = 1;
    d->kept[BEGAN] = sb_sim_report(d->sim)->time;
    d->kept[IMPULSE] = sb_sim_impulse(d->sim, 0)->pressure.z;
}

static void finish(sb_driven *d, sb_json *figures)
{
    const double time = sb_sim_report(d->sim)->time - d->kept[BEGAN];
    sb_json_number(figures, "lift_N", (sb_sim_impulse(d->sim, 0)->pressure.z - d->kept[IMPULSE]) / time);
}

static const sb_drive lifted = {.watch = watch, .close = finish};

/* volume: m^3 of water that the body displaces; 0: its lift is not judged. */
static const struct {
    const char *name, *body;
    double volume;
} immersed[] = {
    {"block", "{name: body, shape: box, min: [0.25, 0.25, 0.2], max: [0.55, 0.55, 0.5]}", 0.027},
    {"cylinder", "{name: body, shape: cylinder, center: [0.4, 0.4, 0.2], radius: 0.15, height: 0.3}", 0.0212058},
    {"half-way", "{name: body, shape: box, min: [0.25, 0.25, 0.6], max: [0.55, 0.55, 1]}", 0.018},
    {"turned",
     "{name: body, shape: box, min: [-0.15, -0.15, -0.15], max: [0.15, 0.15, 0.15], rotate: [45, 30, 20], "
     "translate: [0.4, 0.4, 0.4]}",
     0.027},
    {"two-overlapping",
     "{name: body, shape: box, min: [0.2, 0.2, 0.2], max: [0.5, 0.5, 0.5]}, "
     "{name: other, shape: box, min: [0.35, 0.35, 0.35], max: [0.65, 0.65, 0.65]}",
     0},
    {"one-spacing-off-the-floor", "{name: body, shape: box, min: [0.2, 0.2, 0.05], max: [0.6, 0.6, 0.3]}", 0},
    {"half-a-spacing-off-the-side", "{name: body, shape: box, min: [0.025, 0.2, 0.2], max: [0.3, 0.6, 0.5]}", 0},
    {"beyond-the-domain", "{name: body, shape: box, min: [0.5, -1, 0.2], max: [1.7, 0.4, 2]}", 0},
};

static void plan_immersed(sb_trials *trials, bool quick)
{
    for (size_t i = 0; i < sizeof immersed / sizeof *immersed && !quick; i++) {
        sb_trial *t = sb_trial_add(trials, "immersed.yaml", "%s", immersed[i].name);
        sb_trial_set(t, "bodies=[%s]", immersed[i].body);
        sb_trial_drive(t, &lifted, immersed[i].volume);
    }
    sb_trial *t = sb_trial_add(trials, "immersed.yaml", "driven-from-rest");
    sb_trial_set(t, "wavemakers=[{name: push, body: body, kind: stroke, stroke: 0.2, speed: 1, after: return, "
                    "return_time: 0.3}]");
    sb_trial_set(t, "duration=1");
    if (quick) sb_trial_set(t, "resolution=0.1");
    sb_trial_drive(t, &sb_drive_plain, 0);
}

static void judge_immersed(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    if (j->trial->drive == &sb_drive_plain) return;
    const double speed = sb_outcome_number(o, "late_rms_speed") / sb_outcome_number(o, "wave_speed");
    sb_note(j, "mean speed %.2g of √(gD)", speed);
    sb_require(j, speed < 0.02, "the water does not come to rest");
    if (!(j->trial->number > 0)) return;
    const double share = sb_outcome_number(o, "lift_N") / (1000 * 9.81 * j->trial->number);
    sb_note(j, "lift %.3f of ρgV", share);
    sb_require(j, fabs(share - 1) < 0.1, "the lift differs from the weight of the displaced water");
}

const sb_stress sb_stress_immersed = {
    .name = "immersed",
    .title = "Bodies under water at t = 0",
    .rules =
        "The mean speed of still water stays below 2 % of √(gD) in the second half; the lift of a free-standing body "
        "is within 10 % of ρgV",
    .plan = plan_immersed,
    .judge = judge_immersed,
};

/* Twice the speed above which the CFL bound, and not the longest time step, limits the step. */
static double twice_cfl(double depth)
{
    return 2 * sb_trial_default(2, "cfl") / sb_trial_default(2, "time_step_factor") * sqrt(9.81 * depth);
}

static void plan_paddles(sb_trials *trials, bool quick)
{
    const double speed = twice_cfl(0.4), stroke = 0.6;
    sb_trial *t = sb_trial_add(trials, "paddle.yaml", "twice-cfl");
    sb_trial_set(t, "wavemakers.push.speed=%.9g", speed);
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "twice-cfl-and-back");
    sb_trial_set(t,
                 "wavemakers=[{name: push, body: paddle, kind: stroke, stroke: %g, speed: %.9g, after: return, "
                 "return_time: %.9g}]",
                 stroke, speed, 1.5 * stroke / speed);
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "to-and-fro");
    sb_trial_set(t, "wavemakers=[{name: push, body: paddle, kind: file, file: meshes/to-and-fro.txt}]");
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "gate-drawn-at-twice-cfl");
    sb_trial_set(t, "water.boxes[0].max=[1, 0.6]");
    sb_trial_set(t, "bodies=[{name: paddle, shape: box, min: [1, -0.2], max: [1.2, 1.8]}]");
    sb_trial_set(t, "wavemakers=[{name: push, body: paddle, kind: gate, stroke: 3, speed: %.9g, direction: [0, 1]}]",
                 twice_cfl(0.6));
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "dry-bed");
    sb_trial_set(t, "water.boxes[0].min=[1.5, 0]");
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "dry-bed-goring");
    sb_trial_set(t, "water.boxes[0].min=[2.5, 0]");
    sb_trial_set(t, "wavemakers=[{name: push, body: paddle, kind: goring, height: 0.2, depth: 0.4}]");
    sb_trial_drive(t, &sb_drive_plain, 0);
    if (quick) return;
    t = sb_trial_add(trials, "paddle.yaml", "against-the-wall");
    sb_trial_set(t, "water.boxes[0].min=[2.4, 0]");
    sb_trial_set(t, "wavemakers=[{name: push, body: paddle, kind: stroke, stroke: 2.9, speed: 3}]");
    sb_trial_drive(t, &sb_drive_plain, 0);
    t = sb_trial_add(trials, "paddle.yaml", "away-from-the-water");
    sb_trial_set(t, "wavemakers=[{name: push, body: paddle, kind: stroke, stroke: 0.4, speed: 5, direction: [-1, 0]}]");
    sb_trial_drive(t, &sb_drive_plain, 0);
}

static void judge_paddles(sb_judged *j)
{
    const double off = sb_outcome_number(&j->outcome, "momentum_imbalance");
    sb_note(j, "top speed %.3g m/s", sb_outcome_number(&j->outcome, "top_speed"));
    sb_note(j, "momentum balances within %.1e", off);
    sb_require(j, off < 1e-4, "momentum does not balance");
}

const sb_stress sb_stress_paddles = {
    .name = "paddles",
    .title = "Paddles at twice the CFL speed, reversing, against a dry bed",
    .rules =
        "Forces on bodies, gravity and the water's acceleration balance within 1e-4 of the change of momentum in every "
        "step",
    .plan = plan_paddles,
    .judge = judge_paddles,
};

static void plan_leaving(sb_trials *trials, bool quick)
{
    sb_trial_add(trials, "leaving.yaml", "over-an-edge");
    sb_trial *t = sb_trial_add(trials, "leaving.yaml", "all-sides-open");
    sb_trial_set(t, "domain.sides={x_min: open, x_max: open, y_min: open, y_max: open, z_min: open, z_max: open}");
    t = sb_trial_add(trials, "leaving.yaml", "all-of-it");
    sb_trial_set(t, "bodies=[]");
    t->ends = SB_ENDS_FAILED;
    if (quick) return;
    t = sb_trial_add(trials, "leaving.yaml", "thrown-out-at-once");
    sb_trial_set(t, "water.boxes[0].velocity=[300, 0, 0]");
    t->ends |= SB_ENDS_FAILED;
    t = sb_trial_add(trials, "leaving.yaml", "with-everything-measured");
    sb_trial_set(t, "measure={interval: 0.01, gauges: [{name: edge, x: 1.49, y: 0.2}], probes: [{name: out, at: "
                    "[1.5, 0.4, -0.5]}], map: {}}");
    sb_trial_set(t, "output.particle_interval=0.1");
}

static void judge_leaving(sb_judged *j)
{
    if (j->outcome.how == SB_ENDS_FAILED && j->trial->ends != SB_ENDS_FAILED) {
        sb_note(j, "%.200s", j->outcome.last_line); /* the program refuses speeds that are too high */
        return;
    }
    const double left = sb_outcome_number(&j->outcome, "left_domain");
    double placed = 0;
    for (int side = 0; side < SB_SIDES; side++)
        placed += sb_outcome_number_in(&j->outcome, "left_by_side", sb_side_names[side]);
    sb_require(j, left > 0, "no particle is counted as having left");
    sb_require(j, placed == left, "%g particles are counted by side", placed);
    if (j->trial->ends == SB_ENDS_FAILED)
        sb_require(j, strstr(j->outcome.last_line, "all water has left the domain"), "the run does not report it");
}

const sb_stress sb_stress_leaving = {
    .name = "leaving",
    .title = "Water leaving the domain",
    .rules =
        "Particles that leave are counted, in total and by side; when all water has left, the run reports it and ends",
    .plan = plan_leaving,
    .judge = judge_leaving,
};

/* Stress case: the same bore in a moved, rotated or mirrored scene, where forces must be the same. */
#include "stresses.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEEDS = 5, TRIALS_OF_FRAME = 3 };

/* An isometry of the plan view: x' = xx x + xy y + x0, y' likewise. Rotations are by 90 degrees, so that boxes stay
 * boxes. */
typedef struct frame {
    const char *name;
    double xx, xy, yx, yy, x0, y0, z0;
} frame;

static const frame frames[] = {
    {"moved-1e3", 1, 0, 0, 1, 1e3, -1e3, 50},
    {"moved-1e5", 1, 0, 0, 1, 1e5, 1e5, -50},
    {"moved-1e6", 1, 0, 0, 1, -1e6, 1e6, 1000},
    {"turned-90", 0, -1, 1, 0, 0, 0, 0},
    {"turned-180", -1, 0, 0, -1, 0, 0, 0},
    {"turned-270", 0, 1, -1, 0, 0, 0, 0},
    {"mirrored-x", -1, 0, 0, 1, 0, 0, 0},
    {"mirrored-y", 1, 0, 0, -1, 0, 0, 0},
    {"turned-90-moved-1e6", 0, -1, 1, 0, 1e6, 1e6, 0},
};
enum { FRAMES = sizeof frames / sizeof *frames };

static sb_vec3 transform(const frame *f, sb_vec3 at)
{
    return sb_vec(f->xx * at.x + f->xy * at.y + f->x0, f->yx * at.x + f->yy * at.y + f->y0, at.z + f->z0);
}

/* Transforms a force back to the frame of the scene. */
static sb_vec3 transform_back(const frame *f, sb_vec3 v)
{
    return sb_vec(f->xx * v.x + f->yx * v.y, f->xy * v.x + f->yy * v.y, v.z);
}

static void set_box(sb_trial *t, const frame *f, const char *key, sb_vec3 min, sb_vec3 max)
{
    const sb_vec3 a = transform(f, min), b = transform(f, max), low = sb_min(a, b), high = sb_max(a, b);
    sb_trial_set(t, "%s.min=[%.12g, %.12g, %.12g]", key, low.x, low.y, low.z);
    sb_trial_set(t, "%s.max=[%.12g, %.12g, %.12g]", key, high.x, high.y, high.z);
}

static void plan(sb_trials *trials, bool quick)
{
    for (int s = 1; s <= SEEDS; s++)
        sb_trial_set(sb_trial_add(trials, "bore.yaml", "seed-%d", s), "numerics.seed=%d", s);
    for (int i = 0; i < FRAMES; i++) {
        if (quick && i != 2 && i != 3 && i != 6) continue;
        for (int s = 1; s <= TRIALS_OF_FRAME; s++) {
            sb_trial *t = sb_trial_add(trials, "bore.yaml", "%s-seed-%d", frames[i].name, s);
            sb_trial_set(t, "numerics.seed=%d", s);
            set_box(t, &frames[i], "domain", sb_vec(0, 0, 0), sb_vec(1.6, 0.6, 0.75));
            set_box(t, &frames[i], "water.boxes[0]", sb_vec(0, 0, 0), sb_vec(0.4, 0.6, 0.3));
            set_box(t, &frames[i], "bodies.column", sb_vec(0.9, 0.2, 0), sb_vec(1.1, 0.4, 0.75));
        }
    }
}

/* How the names of all trials in the frame of this one begin. */
static void start_of_names(const sb_judged *j, char start[SB_TRIAL_NAME])
{
    const char *seed = strstr(j->trial->name, "seed-");
    snprintf(start, SB_TRIAL_NAME, "%.*sseed-", (int)(seed - j->trial->name), j->trial->name);
}

static sb_vec3 impulse_of(const sb_judged *j)
{
    const sb_vec3 impulse = sb_outcome_vector(&j->outcome, "column", "impulse_vector_Ns");
    char start[SB_TRIAL_NAME], own[SB_TRIAL_NAME];
    start_of_names(j, own);
    for (int i = 0; i < FRAMES; i++) {
        snprintf(start, sizeof start, "%s-seed-", frames[i].name);
        if (strcmp(start, own) == 0) return transform_back(&frames[i], impulse);
    }
    return impulse;
}

static double along(const sb_judged *j)
{
    return impulse_of(j).x;
}

static double across(const sb_judged *j)
{
    return fabs(impulse_of(j).y);
}

static void judge(sb_judged *j)
{
    const sb_vec3 impulse = impulse_of(j);
    const sb_spread seeds = sb_judged_spread(j, "seed-", along), side = sb_judged_spread(j, "seed-", across);
    const double spread = seeds.high - seeds.low;
    sb_note(j, "impulse %.2f N s along the bore, %+.2f across", impulse.x, impulse.y);
    if (strncmp(j->trial->name, "seed-", 5) == 0) return;
    char start[SB_TRIAL_NAME];
    start_of_names(j, start);
    const sb_spread ours = sb_judged_spread(j, start, along);
    sb_note(j, "mean of the frame %.2f; five seeds %.2f, from %.2f to %.2f", ours.mean, seeds.mean, seeds.low,
            seeds.high);
    sb_require(j, seeds.count == SEEDS && ours.count == TRIALS_OF_FRAME, "the seeds have not run");
    sb_require(j, fabs(ours.mean - seeds.mean) <= spread, "the mean differs by more than the spread of the seeds");
    sb_require(j, fabs(impulse.y) <= side.high + spread,
               "the transverse impulse differs by more than the spread of the seeds");
}

const sb_stress sb_stress_frame = {
    .name = "frame",
    .title = "The scene moved, turned and mirrored",
    .rules = "The mean impulse of three start seeds on the column differs from that of the five start seeds of the "
             "scene as it is by at most the spread of these (largest minus smallest)",
    .plan = plan,
    .judge = judge,
};

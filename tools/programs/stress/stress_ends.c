/* Stress case: ground with holes, or ground that ends before the sides of the domain. */
#include "stresses.h"

static const struct {
    const char *name, *change;
} ground[] = {
    {"whole", "title=whole"},
    {"hole", "bodies.ground.file=meshes/hole.asc"},
    {"short", "bodies.ground.translate=[-1, 0, 0]"},
    {"island", "bodies=[{name: ground, shape: plane, role: terrain, center: [1.5, 1, 0.2], normal: [0, 0.1, 1], "
               "width: 1.1, length: 0.9}]"},
    {"strips", "bodies=[{name: ground, shape: mesh, role: terrain, file: meshes/strips.obj}]"},
    {"crack", "bodies=[{name: ground, shape: mesh, role: terrain, file: meshes/crack.obj}]"},
    {"turned", "bodies.ground.rotate=[0, 0, 30]"},
};

static void plan(sb_trials *trials, bool quick)
{
    for (size_t i = 0; i < sizeof ground / sizeof *ground; i++) {
        if (quick && i != 1 && i != 2) continue;
        sb_trial *t = sb_trial_add(trials, "ends.yaml", "%s", ground[i].name);
        sb_trial_set(t, "%s", ground[i].change);
        if (quick) sb_trial_set(t, "duration=0.2");
    }
    sb_trial *t = sb_trial_add(trials, "ends.yaml", "bore-over-the-rim");
    sb_trial_set(t, "bodies.ground.translate=[-1, 0, 0]");
    sb_trial_set(t, "water={boxes: [{min: [0, 0, 0.2], max: [0.8, 2, 1.1]}]}");
    sb_trial_set(t, "duration=%g", quick ? 0.6 : 2.5);
    t = sb_trial_add(trials, "ends.yaml", "slice");
    sb_trial_set(t, "dimensions=2");
    sb_trial_set(t, "resolution=0.05");
    sb_trial_set(t, "domain={min: [0, -0.4], max: [3, 1.2]}");
    sb_trial_set(t, "water={level: 0.5, seed: [0.3, 0.45]}");
    sb_trial_set(t, "bodies.ground.translate=[-1, 0]");
}

const sb_stress sb_stress_ends = {
    .name = "ends",
    .title = "Ground that ends within the domain",
    .rules = "Only the common rules: no particle is lost beside the ground, and none enters the ground from the side",
    .plan = plan,
    .judge = NULL,
};

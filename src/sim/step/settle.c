/* Settling: damped steps before t = 0 in which the initial lattice comes to rest (docs/method.md, section 10). Without
   settling the lattice would rearrange itself during the run, and its noise would hide a wave. */
#include "sim/step/settle.h"
#include "base/memory.h"
#include "base/stop.h"
#include "physics/waves/wave_theory.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/report/report.h"
#include "sim/simulation.h"

#include <math.h>

/* Settling begins with creeping steps: a lattice that is too dense at a wall would otherwise be thrown off it. Boxes of
   water have unsupported sides: they creep for a few steps more and have no further stage. CALM_STEPS: calm steps in a
   row that end settling; a single one may be a reversal of the motion. */
enum { CREEP_FIRST = 40, CREEP_BOXES = 50, CALM_STEPS = 10 };

static const double CALM = 0.002; /* highest speed of calm water, over sqrt(g D) */

/* Water over rough ground always keeps some residual motion. When TRIAL_STEPS steps have reduced its kinetic energy by
   less than three tenths, further steps have little effect. */
enum { TRIAL_STEPS = 60 };
static const double STILL_FALLING = 0.7;

/* Highest mean speed of a group of cells with at least FLOW_PARTICLES particles in water at rest, over
   sqrt(g D). */
enum { FLOW_PARTICLES = 16 };
static const double FLOW = 0.003;

bool sb_sim_settles(const sb_scene *scene)
{
    return scene->numerics.settle_steps > 0;
}

int sb_sim_settle_most(const sb_scene *scene)
{
    const int steps = scene->numerics.settle_steps;
    return scene->box_count > 0 && steps > CREEP_BOXES ? CREEP_BOXES : steps;
}

/* A sea is judged every TRIAL_STEPS. Of the scenes of assets/scenes at 13 spacings, 2 to 20 particles deep, two were
   over at the second trial, four at the third, six at the fourth, one at the fifth. */
enum { TRIALS_EXPECTED = 4 };

int sb_sim_settle_expected(const sb_scene *scene)
{
    const int most = sb_sim_settle_most(scene), sea = CREEP_FIRST + TRIALS_EXPECTED * TRIAL_STEPS;
    return scene->box_count > 0 || most < sea ? most : sea;
}

bool sb_settle_over(const sb_settle *settle)
{
    return settle->done >= settle->most || settle->calm >= CALM_STEPS;
}

float sb_settle_wave_acceleration(const sb_sim *sim, sb_record at)
{
    const sb_initial_wave *wave = &sim->scene->wave;
    const double gravity = sim->scene->fluid.gravity, step = 1e-4 * wave->depth;
    if (wave->kind == SB_INITIAL_NONE || !sim->policy->holds_wave) return 0;
    const double x = sb_space_position(&sim->space, at).x - wave->position;
    const double ahead = sb_initial_elevation(wave, gravity, x + step);
    const double behind = sb_initial_elevation(wave, gravity, x - step);
    return (float)(gravity * (ahead - behind) / (2 * step));
}

/* Sets a velocity; the pressure in the last lane does not change. */
static void set_velocity(sb_sim *sim, size_t i, sb_f4 v)
{
    v[3] = sim->state.velocity[i][3];
    sim->state.velocity[i] = v;
    sim->state.max_speed = fmax(sim->state.max_speed, sqrt((double)sb_sum3(v * v)));
}

/* Sets the velocities of the scene. */
static void set_scene_velocities(sb_sim *sim)
{
    sim->state.max_speed = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        set_velocity(sim, i, sim->state.start_velocity ? sim->state.start_velocity[i] : (sb_f4){0});
    sim->state.max_speed = sim->exchange->largest(sim, sim->state.max_speed);
    sb_free(sim->state.start_velocity);
    sim->state.start_velocity = NULL;
}

/* Sets the velocities of water that starts from rest to minus half of the velocity change of one step. Particles move
   with the velocity at the end of a step, so that velocities belong to times half a step before the positions, as in a
   leapfrog scheme. Otherwise all motion would begin half a step early (docs/decisions/0021). Calm water stays at rest,
   and so does a particle without neighbours, which moves with the mean of the velocities before and after a step. */
static sb_status set_half_step_back(sb_sim *sim, sb_error *error)
{
    const float least = (float)CALM * sim->constant.wave_speed;
    sim->policy = &sb_policy_start_trial;
    const sb_status status = sb_sim_step(sim, error);
    sim->policy = &sb_policy_run;
    sim->state.max_speed = 0;
    for (size_t i = 0; status == SB_OK && i < sim->state.n; i++) {
        const sb_f4 change = sim->state.velocity[i];
        const bool begins = sim->work.diagonal[i] > 0 && sb_sum3(change * change) > least * least;
        set_velocity(sim, i, change * sb_splat(begins ? -0.5f : 0));
    }
    sim->state.max_speed = sim->exchange->largest(sim, sim->state.max_speed);
    return status;
}

sb_rest sb_sim_rest(const sb_sim *sim)
{
    const sb_settle *settle = &sim->state.settle;
    const char *ended = settle->calm >= CALM_STEPS                      ? "calm"
                        : settle->most < sb_sim_settle_most(sim->scene) ? "further steps would change little"
                                                                        : "largest number of steps done";
    return (sb_rest){settle->done, settle->speed, ended};
}

bool sb_sim_settling(const sb_sim *sim, int *done)
{
    *done = sim->state.settle.done;
    return sim->state.settle.under_way;
}

sb_status sb_sim_settle(sb_sim *sim, sb_error *error)
{
    return sb_sim_settle_watched(sim, NULL, NULL, error);
}

static void begin(sb_sim *sim)
{
    sim->state.settle =
        (sb_settle){.under_way = true, .most = sb_sim_settle_most(sim->scene), .kinetic = (double)INFINITY};
    for (size_t i = 0; i < sim->state.n; i++) sim->state.velocity[i] = (sb_f4){0, 0, 0, sim->state.velocity[i][3]};
    sim->state.max_speed = 0;
    sb_report_update(sim);
}

/* Speed of a group's mean motion, m/s; 0 for a group of few particles, whose mean is that of their own motion. */
static double flow_of(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    (void)terms;
    const size_t n = group->end - group->first;
    sb_f4 sum = {0};
    for (size_t i = group->first; i < group->end; i++) sum += sim->state.velocity[i];
    return n < FLOW_PARTICLES ? 0 : sqrt((double)sb_sum3(sum * sum)) / (double)n;
}

/* Ends settling if further damped steps would change little. The flow between basins must have ceased as well: its
 * energy is small beside that of the motion of single particles. */
static void judge_trial(sb_sim *sim)
{
    sb_settle *settle = &sim->state.settle;
    if ((settle->done - CREEP_FIRST) % TRIAL_STEPS != 0) return;
    const double kinetic = sb_sim_energy(sim).kinetic;
    const double flow = sb_sum_groups(sim, 0, flow_of, NULL);
    const bool flows = flow > FLOW * (double)sim->constant.wave_speed;
    if (kinetic > STILL_FALLING * settle->kinetic && !flows) settle->most = settle->done;
    settle->kinetic = kinetic;
}

static sb_status one_step(sb_sim *sim, sb_error *error)
{
    sb_settle *settle = &sim->state.settle;
    const double calm = CALM * (double)sim->constant.wave_speed;
    const bool creeps = sim->scene->box_count > 0 || settle->done < CREEP_FIRST;
    sim->policy = creeps ? &sb_policy_creep : &sb_policy_damp;
    const sb_status status = sb_sim_step(sim, error);
    if (status != SB_OK) return status;
    settle->done++;
    settle->speed = sim->state.max_speed;
    settle->calm = settle->speed < calm ? settle->calm + 1 : 0;
    if (!creeps) judge_trial(sim);
    return SB_OK;
}

/* Gives the settled water the velocities of the scene. */
static sb_status finish(sb_sim *sim, sb_error *error)
{
    sb_status status = SB_OK;
    sim->state.settle.under_way = false;
    set_scene_velocities(sim);
    if ((sim->scene->box_count > 0 || sim->scene->wave.kind != SB_INITIAL_NONE) && sim->state.max_speed == 0)
        status = set_half_step_back(sim, error);
    sim->state.time_step = 0; /* nothing has moved with these velocities: passes that look back find no motion */
    sb_report_update(sim);
    return status;
}

sb_status sb_sim_settle_watched(sb_sim *sim, sb_settle_watch *watch, void *context, sb_error *error)
{
    sb_settle *settle = &sim->state.settle;
    if (!sim->needs.settling) return SB_OK;
    sb_status status = SB_OK;
    if (!settle->under_way) begin(sim);
    while (status == SB_OK && !sb_settle_over(settle) && !sb_stop_signal()) {
        status = one_step(sim, error);
        const bool between = status == SB_OK && !sb_settle_over(settle);
        if (watch && between) watch(context, settle->done, settle->most, settle->speed);
    }
    sim->policy = &sb_policy_run;
    if (status == SB_OK && !sb_settle_over(settle))
        status = sb_stop_fail(error, "while the water came to rest: nothing is computed yet");
    return status == SB_OK ? finish(sim, error) : status;
}

/* The choice of the time step [S16, eqs. 10-12] (docs/method.md, section 8). */
#include "physics/absorption/sponge.h"
#include "sim/simulation.h"
#include "sim/step/stages.h"
#include "sim/walls/absorber.h"
#include "sim/wcsph/wcsph.h"

#include <math.h>

/* The CFL limit. Water at rest starts to move by gravity, which then determines the limit [S16, eq. 11]. */
static double cfl_step(const sb_numerics *n, const sb_constants *c, double speed)
{
    double h = (double)c->support, g = (double)c->gravity;
    double rest = g > 0 ? sqrt(n->cfl * h / g) : (double)INFINITY;
    return fmin(n->cfl * h / speed, rest);
}

/* The largest speed that the law of a wave maker gives a body with this share of its motion, or with absorption. */
static double top_speed_of(const sb_sim *sim, const sb_moving_law *law, double probe)
{
    double speed = 0;
    if (!law->paddle.kind) return 0;
    const double moved = sb_paddle_displacement(&law->paddle, sim->state.time + probe) -
                         sb_paddle_displacement(&law->paddle, sim->state.time);
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        const sb_moving_body *moving = &sim->walls.moving[m];
        const double back = moving->absorber ? fabs(moving->absorber->state.speed) : 0;
        if (moving->law == law) speed = fmax(speed, fabs(moving->share * moved) / probe + back);
    }
    return speed;
}

static double top_speed(const sb_sim *sim)
{
    double speed = sim->state.max_speed;
    const double probe = 1e-3 * (double)sim->constant.spacing / (double)sim->constant.wave_speed;
    for (size_t w = 0; w < sim->scene->wavemaker_count && sim->policy->runs; w++)
        speed = fmax(speed, top_speed_of(sim, &sim->walls.laws[w], probe));
    return speed;
}

/* Largest viscosity times dt, in spacings^2: half of the stability limit of an explicit step for the stiffest mode of a
   full lattice. At that limit, 0.14, energy still grew by 2 % in 200 steps. */
static const double VISCOUS_STEP = 0.07;

/* Speed in sqrt(g D) that must be able to move water in one step. In a step in which such water moves by less than half
   a quantum it never moves. */
static const double SLOWEST = 1e-3;

/* Of all viscous sponges, which may overlap; m2/s. */
static double sponge_viscosity(const sb_scene *scene, const sb_constants *c)
{
    double alpha = 0;
    for (size_t k = 0; k < scene->sponge_count; k++)
        if (scene->sponges[k].kind == SB_SPONGE_VISCOUS) alpha += scene->sponges[k].alpha;
    return sb_sponge_viscosity(alpha, (double)c->support, (double)c->sound_speed, c->dimension);
}

/* The longest step that is stable for the constant viscosities. sigma damps a pair at a wall by half as much as the
   same alpha would [S16, eqs. 14, 33]. */
static double viscous_step(const sb_scene *scene, const sb_constants *c)
{
    const sb_numerics *n = &scene->numerics;
    const double artificial = (n->artificial_viscosity + 0.5 * n->wall_friction) * (double)c->support *
                              (double)c->sound_speed / (2 * (c->dimension + 2));
    const double nu = artificial + (double)c->viscosity + sponge_viscosity(scene, c), spacing = (double)c->spacing;
    return nu > 0 ? VISCOUS_STEP * spacing * spacing / nu : (double)INFINITY;
}

/* In this step the shortest capillary wave, two spacings long, does not pass half a spacing [Brackbill, Kothe, Zemach
   1992], with air that has no mass. */
static double capillary_step(const sb_constants *c)
{
    const double dr = (double)c->spacing;
    return sqrt((double)c->rest_density * dr * dr * dr / (4 * M_PI * (double)c->surface_tension));
}

/* The time step: the smallest of the limits by waves (times `stretched`), speed, viscosity and the scene. */
static double longest_step(const sb_scene *scene, const sb_constants *c, double speed, double stretched)
{
    const sb_numerics *n = &scene->numerics;
    double h = (double)c->support, g = (double)c->gravity;
    double bound = n->time_step_rule == SB_TIME_STEP_PAPER ? n->time_step_factor * h / g
                                                           : n->time_step_factor * h / (double)c->wave_speed;
    double dt = n->solver == SB_SOLVER_WCSPH ? sb_wcsph_longest_step(n, c, speed)
                                             : fmin(cfl_step(n, c, speed), bound * stretched);
    dt = fmin(dt, viscous_step(scene, c));
    if (c->surface_tension > 0) dt = fmin(dt, capillary_step(c));
    return n->time_step_max > 0 ? fmin(dt, n->time_step_max) : dt;
}

double sb_sim_sound_speed(const sb_scene *scene, const sb_model *model)
{
    return (double)sb_constants_of(scene, model).sound_speed;
}

double sb_sim_longest_step(const sb_scene *scene, const sb_model *model, double speed)
{
    const sb_constants constants = sb_constants_of(scene, model);
    return longest_step(scene, &constants, speed, 1);
}

static double step_of(const sb_sim *sim)
{
    return longest_step(sim->scene, &sim->constant, top_speed(sim), sim->policy->step_factor);
}

static double least_step(const sb_constants *c, double quantum)
{
    return 0.5 * quantum / (SLOWEST * (double)c->wave_speed);
}

static sb_status check_step(const sb_scene *scene, const sb_constants *c, double quantum, double dt, sb_error *error)
{
    const double least = least_step(c, quantum);
    if (dt >= least && isfinite(dt)) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s: the first time step would be %g s, expected at least %.3g s: numerics.time_step_max, cfl or "
        "time_step_factor is too small, or gravity, a viscosity, surface_tension or the speed of sound is too large",
        scene->path ? scene->path : "the scene", dt, least);
}

sb_status sb_sim_check_start(const sb_sim *sim, sb_error *error)
{
    return check_step(sim->scene, &sim->constant, sim->space.quantum, step_of(sim), error);
}

sb_status sb_sim_foresee_start(const sb_scene *scene, const sb_model *model, double speed, sb_error *error)
{
    const sb_constants constants = sb_constants_of(scene, model);
    sb_space space;
    const sb_status status = sb_space_create(model->min, model->max, (double)constants.support, &space, error);
    if (status != SB_OK) return status;
    return check_step(scene, &constants, space.quantum, longest_step(scene, &constants, speed, 1), error);
}

sb_status sb_stage_time_step(sb_sim *sim, sb_error *error)
{
    const double dt = step_of(sim), least = least_step(&sim->constant, sim->space.quantum);
    if (!(dt > 0) || !isfinite(dt))
        return sb_fail(error, SB_FAILED, "step %llu, t = %g s: time step is %g s: the run has diverged",
                       (unsigned long long)sim->state.step, sim->state.time, dt);
    if (dt < least)
        return sb_fail(error, SB_FAILED,
                       "step %llu, t = %g s: time step is %g s, expected at least %.3g s: the run has diverged, or a "
                       "key of numerics limits the step too much",
                       (unsigned long long)sim->state.step, sim->state.time, dt, least);
    const double crossing = (double)sim->constant.spacing / (double)sim->constant.wave_speed;
    sim->state.time_step = fmin(dt, sim->policy->longest_step * crossing);
    return SB_OK;
}

#include "app/check/pace.h"

#include "base/clock.h"
#include "geometry/model/model.h"
#include "sim/sim.h"

enum { SWEEPS = 8, WARM_UP = 3, STEPS = 10 };

/* A closed tank with water at rest. Everything that is not set here is the scene's. */
static sb_scene make_tank(const sb_scene *scene)
{
    const bool flat = scene->dimensions == 2;
    const double length = flat ? 400 : 40, width = 30, height = flat ? 30 : 18, depth = flat ? 25 : 14; /* spacings */
    const double spacing = scene->resolution;
    sb_scene tank = *scene;
    tank.domain.min = (sb_vec3){0, tank.domain.min.y, 0};
    tank.domain.max = (sb_vec3){length * spacing, tank.domain.max.y, height * spacing};
    if (!flat) {
        tank.domain.min.y = 0;
        tank.domain.max.y = width * spacing;
    }
    for (int side = 0; side < SB_SIDES; side++) tank.domain.side[side] = side == SB_Z_MAX ? SB_SIDE_OPEN : SB_SIDE_WALL;
    tank.sea = (sb_sea){
        .present = true, .level = depth * spacing, .seed = {2.5 * spacing, flat ? 0 : 2.5 * spacing, 2.5 * spacing}};
    tank.wave = (sb_initial_wave){.kind = SB_INITIAL_NONE};
    tank.box_count = tank.body_count = tank.wavemaker_count = 0;
    tank.numerics.settle_steps = 0;
    if (tank.numerics.min_iterations < SWEEPS) tank.numerics.min_iterations = SWEEPS;
    if (tank.numerics.max_iterations < SWEEPS) tank.numerics.max_iterations = SWEEPS;
    return tank;
}

static sb_status time_steps(sb_sim *sim, size_t particles, double *seconds, sb_error *error)
{
    sb_status status = SB_OK;
    for (int step = 0; step < WARM_UP && status == SB_OK; step++) status = sb_sim_step(sim, error);
    const double begin = sb_clock();
    for (int step = 0; step < STEPS && status == SB_OK; step++) status = sb_sim_step(sim, error);
    *seconds = (sb_clock() - begin) / (STEPS * (double)particles);
    return status;
}

sb_status sb_pace_measure(const sb_scene *scene, double *seconds, sb_error *error)
{
    const sb_scene tank = make_tank(scene);
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_status status = sb_model_build(&tank, &model, error);
    if (status == SB_OK) status = sb_sim_create(&tank, &model, NULL, &sim, error);
    if (status == SB_OK) status = time_steps(sim, model.fluid_count, seconds, error);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    return status;
}

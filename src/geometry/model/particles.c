/* Places the boundary particles of surfaces and the fluid particles of the water. */
#include "base/memory.h"
#include "geometry/filling/fill.h"
#include "geometry/model/walls.h"

/* The bodies that have a surface. */
sb_status sb_model_surfaces_create(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                                   sb_model_surfaces *surfaces, sb_error *error)
{
    surfaces->settings = (sb_sample_settings){
        .spacing = scene->numerics.wall_spacing * scene->resolution,
        .offset = scene->numerics.wall_offset * scene->resolution,
        .support = scene->numerics.support * scene->resolution,
        .dimensions = scene->dimensions,
        .min = scene->domain.min,
        .max = scene->domain.max,
        .repeats = {sb_scene_repeats(scene, 0), sb_scene_repeats(scene, 1), sb_scene_repeats(scene, 2)}};
    surfaces->sources = sb_alloc(space->count, sizeof *surfaces->sources);
    if (!surfaces->sources) return sb_fail_memory(error, "surfaces");
    const sb_status status = sb_wholes_create(scene, model, &surfaces->wholes, error);
    for (size_t i = 0; i < space->count && status == SB_OK; ++i) {
        sb_sample_source *source = &surfaces->sources[surfaces->count];
        if (!space->solid[i]) continue;
        *source =
            (sb_sample_source){space->mesh[i], space->solid[i], model->bodies[i].role, model->bodies[i].wavemaker >= 0};
        surfaces->count += sb_wholes_source(surfaces->wholes, model, i, source);
    }
    return status;
}

void sb_model_surfaces_free(sb_model_surfaces *surfaces)
{
    sb_wholes_destroy(surfaces->wholes);
    sb_free(surfaces->sources);
    *surfaces = (sb_model_surfaces){.count = 0};
}

sb_status sb_model_take_samples(const sb_scene *scene, const sb_model_space *space, sb_samples *samples,
                                sb_model *model, sb_error *error)
{
    size_t count = 0;
    sb_status status = SB_OK;
    for (size_t i = 0; i < space->count; ++i) {
        sb_model_body *body = model->bodies + i;
        body->begin = samples->begin[count];
        if (space->solid[i] && body->plate == 0) body->count = samples->begin[++count] - body->begin;
    }
    model->wall_count = samples->count;
    model->wall_position = samples->position;
    model->wall_normal = samples->normal;
    sb_free(samples->begin);
    for (size_t i = 0; i < space->count && status == SB_OK; ++i)
        if (model->bodies[i].plate == 0 && sb_model_share_plates(scene, model, i) != 0)
            status = sb_fail_memory(error, "plates");
    return status;
}

sb_status sb_model_sample(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_model_surfaces surfaces = {.count = 0};
    sb_samples samples = {.count = 0};
    sb_status status = sb_model_surfaces_create(scene, space, model, &surfaces, error);
    if (status == SB_OK)
        status = sb_sample_surfaces(&surfaces.settings, surfaces.sources, surfaces.count, &samples, error);
    sb_model_surfaces_free(&surfaces);
    return status == SB_OK ? sb_model_take_samples(scene, space, &samples, model, error) : status;
}

/* Warns of boxes that are probably not as intended. */
static sb_status check_boxes(const sb_scene *scene, const sb_fluid *fluid, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < scene->box_count && status == SB_OK; ++i) {
        const sb_box_share *share = &fluid->boxes[i];
        if (share->room == 0)
            status = sb_model_warn(model, error,
                                   "water.boxes[%zu] has no room for water: solids fill it, or it is thinner than a "
                                   "spacing",
                                   i);
        else if (share->received == 0 || (share->received < share->room && sb_norm(scene->boxes[i].velocity) > 0))
            status = sb_model_warn(model, error,
                                   "water.boxes[%zu]: %zu of its %zu particles lie in water that comes earlier "
                                   "in the scene, and have the level and velocity of that water",
                                   i, share->room - share->received, share->room);
    }
    return status;
}

sb_status sb_model_fill(const sb_scene *scene, const sb_fill_share *share, sb_model_space *space, sb_model *model,
                        sb_error *error)
{
    sb_fill_solid *solids = sb_alloc(space->count, sizeof *solids);
    if (!solids) return sb_fail_memory(error, "solids");
    size_t count = 0;
    /* Without the domain's own walls: the columns end there in any case. */
    for (size_t i = 0; i < space->count; ++i)
        if (space->solid[i] && model->bodies[i].mesh.triangle_count > 0)
            solids[count++] = (sb_fill_solid){space->solid[i], model->bodies[i].name};
    sb_fluid fluid = {.count = 0};
    sb_status status = sb_fill_water(scene, solids, count, share, &fluid, error);
    sb_free(solids);
    if (status != SB_OK) return status;
    model->fluid_count = fluid.count;
    model->fluid_position = fluid.position;
    model->fluid_velocity = fluid.velocity;
    model->fluid_pressure = fluid.pressure;
    model->still_depth = fluid.still_depth;
    space->water = fluid.source;
    if (space->water) model->part = (sb_model_part){.divided = true, .from = fluid.from, .here = fluid.here};
    status = check_boxes(scene, &fluid, model, error);
    if (status == SB_OK) status = sb_model_warn_wave(scene, &fluid.wave, model, error);
    sb_free(fluid.boxes);
    return status;
}

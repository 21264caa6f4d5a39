#include "geometry/model.h"

#include "base/memory.h"
#include "base/stop.h"
#include "geometry/fill.h"
#include "geometry/model_parts.h"
#include "geometry/sample.h"

#include <stdarg.h>
#include <stdio.h>

void sb_model_free(sb_model *model)
{
    if (!model) return;
    for (size_t i = 0; i < model->body_count; ++i) sb_mesh_free(&model->bodies[i].mesh);
    for (size_t i = 0; i < model->warning_count; ++i) sb_free(model->warnings[i]);
    sb_free(model->bodies);
    sb_free(model->warnings);
    sb_free(model->fluid_position);
    sb_free(model->fluid_velocity);
    sb_free(model->fluid_pressure);
    sb_free(model->wall_position);
    sb_free(model->wall_normal);
    *model = (sb_model){.dimensions = 0};
}

void sb_model_forget_start(sb_model *model)
{
    bool still = true;
    for (size_t i = 0; model->fluid_velocity && i < model->fluid_count && still; i++)
        still = sb_norm(model->fluid_velocity[i]) == 0;
    sb_free(model->fluid_position);
    sb_free(model->fluid_pressure);
    model->fluid_position = NULL;
    model->fluid_pressure = NULL;
    if (!still) return;
    sb_free(model->fluid_velocity);
    model->fluid_velocity = NULL;
}

sb_status sb_model_warn(sb_model *model, sb_error *error, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    size_t capacity = model->warning_count;
    char *copy = sb_strdup(line);
    if (!copy || sb_grow((void **)&model->warnings, &capacity, model->warning_count + 1,
                         sizeof *model->warnings)) {
        sb_free(copy);
        return sb_fail_memory(error, "warnings");
    }
    model->warnings[model->warning_count++] = copy;
    return SB_OK;
}

/* All bodies' particles, those of the bodies that have a surface at all. */
sb_status sb_model_sample(const sb_scene *scene, const sb_model_space *space, sb_model *model,
                          sb_error *error)
{
    const sb_sample_settings settings = {.spacing = scene->resolution,
                                         .offset = scene->numerics.wall_offset * scene->resolution,
                                         .support = scene->numerics.support * scene->resolution,
                                         .dimensions = scene->dimensions,
                                         .min = scene->domain.min,
                                         .max = scene->domain.max,
                                         .repeats = {sb_scene_repeats(scene, 0),
                                                     sb_scene_repeats(scene, 1),
                                                     sb_scene_repeats(scene, 2)}};
    sb_sample_source *sources = sb_alloc(space->count, sizeof *sources);
    if (!sources) return sb_fail_memory(error, "surfaces");
    size_t count = 0;
    for (size_t i = 0; i < space->count; ++i)
        if (space->solid[i])
            sources[count++] =
                (sb_sample_source){space->mesh[i], space->solid[i], model->bodies[i].role,
                                   model->bodies[i].wavemaker >= 0};
    sb_samples samples = {.count = 0};
    sb_status status = sb_sample_surfaces(&settings, sources, count, &samples, error);
    sb_free(sources);
    if (status != SB_OK) return status;
    count = 0;
    for (size_t i = 0; i < space->count; ++i) {
        sb_model_body *body = model->bodies + i;
        body->begin = samples.begin[count];
        if (space->solid[i]) body->count = samples.begin[++count] - body->begin;
    }
    model->wall_count = samples.count;
    model->wall_position = samples.position;
    model->wall_normal = samples.normal;
    sb_free(samples.begin);
    return SB_OK;
}

sb_status sb_model_fill(const sb_scene *scene, const sb_model_space *space, sb_model *model,
                        sb_error *error)
{
    sb_fill_solid *solids = sb_alloc(space->count, sizeof *solids);
    if (!solids) return sb_fail_memory(error, "solids");
    size_t count = 0;
    /* Not the domain's own walls: columns end there anyway. */
    for (size_t i = 0; i < space->count; ++i)
        if (space->solid[i] && model->bodies[i].mesh.triangle_count > 0)
            solids[count++] = (sb_fill_solid){space->solid[i], model->bodies[i].name};
    sb_fluid fluid = {.count = 0};
    sb_status status = sb_fill_water(scene, solids, count, &fluid, error);
    sb_free(solids);
    if (status != SB_OK) return status;
    model->fluid_count = fluid.count;
    model->fluid_position = fluid.position;
    model->fluid_velocity = fluid.velocity;
    model->fluid_pressure = fluid.pressure;
    model->still_depth = fluid.still_depth;
    return SB_OK;
}

sb_status sb_model_build(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_model made = {.dimensions = 0};
    sb_model_space space = {.count = 0};
    sb_status status = sb_model_import_bodies(scene, &made, error);
    if (status == SB_OK) status = sb_model_room(scene, &made, error);
    if (status == SB_OK) status = sb_model_space_create(&made, scene, &space, error);
    /* The sea first: a scene whose sea escapes need not wait for its walls. */
    if (status == SB_OK) status = sb_model_fill(scene, &space, &made, error);
    if (status == SB_OK) status = sb_model_sample(scene, &space, &made, error);
    if (status == SB_OK) status = sb_model_check_sides(scene, &space, &made, error);
    if (status == SB_OK) status = sb_model_check(scene, &space, &made, error);
    sb_model_space_free(&space);
    if (status != SB_OK) {
        sb_model_free(&made);
        /* Whatever a stage made of it. */
        return sb_stop_signal() ? sb_stop_fail(error, "while the model was built: nothing is computed yet") : status;
    }
    *model = made;
    return SB_OK;
}

/* Frees models and their parts, and adds warnings. */
#include "base/memory.h"
#include "geometry/model/parts.h"

#include <stdarg.h>
#include <stdio.h>

void sb_model_free(sb_model *model)
{
    if (!model) return;
    for (size_t i = 0; i < model->body_count; ++i) sb_mesh_free(&model->bodies[i].mesh);
    for (size_t i = 0; i < model->warning_count; ++i) sb_free(model->warnings[i]);
    for (int side = 0; side < 4; side++) sb_free(model->sea[side].bed);
    sb_offshore_start_free(&model->grid);
    sb_free(model->facets.facets);
    sb_free(model->facets.edges);
    sb_free(model->bodies);
    sb_free(model->shallow);
    sb_free(model->warnings);
    sb_model_free_particles(model);
    *model = (sb_model){.dimensions = 0};
}

void sb_model_free_start(sb_model *model)
{
    const bool still = sb_model_start_speed(model) == 0;
    sb_free(model->fluid_position);
    sb_free(model->fluid_pressure);
    sb_offshore_start_free(&model->grid);
    model->fluid_position = NULL;
    model->fluid_pressure = NULL;
    if (!still) return;
    sb_free(model->fluid_velocity);
    model->fluid_velocity = NULL;
}

void sb_model_free_walls(sb_model *model)
{
    sb_free(model->wall_position);
    sb_free(model->wall_normal);
    sb_free(model->walls.of);
    model->wall_position = model->wall_normal = NULL;
    model->walls.of = NULL;
}

void sb_model_free_particles(sb_model *model)
{
    sb_free(model->fluid_position);
    sb_free(model->fluid_velocity);
    sb_free(model->fluid_pressure);
    sb_model_free_walls(model);
    model->fluid_position = model->fluid_velocity = NULL;
    model->fluid_pressure = NULL;
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
    if (!copy || sb_grow((void **)&model->warnings, &capacity, model->warning_count + 1, sizeof *model->warnings)) {
        sb_free(copy);
        return sb_fail_memory(error, "warnings");
    }
    model->warnings[model->warning_count++] = copy;
    return SB_OK;
}

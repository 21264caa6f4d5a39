/* Whether there is memory for a model, before much of it is taken. */
#include "base/memory.h"
#include "geometry/model_parts.h"

/* Bytes of a model's fluid particle: position, velocity, pressure; and of a boundary particle while it is sampled: the
   particle twice, and its place in the search for neighbours. */
static const double fluid_bytes = 56, wall_bytes = 160;

/* Cells of the coarse look. */
static const double look_cells = 1e5;

typedef struct counts {
    double fluid, walls;
} counts;

/* A model of few particles, each of which stands for ratio^d of water or ratio^(d-1) of wall. */
static sb_status look(const sb_scene *scene, const sb_model *bodies, double ratio, counts *found)
{
    sb_scene coarse = *scene;
    sb_model model = *bodies; /* its bodies are shared, and sampled anew afterwards; warnings are its own */
    model.warnings = NULL;
    model.warning_count = 0;
    sb_model_space space = {.count = 0};
    coarse.resolution *= ratio;
    sb_status status = sb_model_space_create(bodies, &coarse, &space, NULL);
    if (status == SB_OK) status = sb_model_fill(&coarse, &space, &model, NULL);
    if (status == SB_OK) status = sb_model_sample(&coarse, &space, &model, NULL);
    sb_model_space_free(&space);
    *found = (counts){(double)model.fluid_count * pow(ratio, scene->dimensions),
                      (double)model.wall_count * pow(ratio, scene->dimensions - 1)};
    for (size_t i = 0; i < model.warning_count; ++i) sb_free(model.warnings[i]);
    sb_free(model.warnings);
    sb_free(model.fluid_position);
    sb_free(model.fluid_velocity);
    sb_free(model.fluid_pressure);
    sb_free(model.wall_position);
    sb_free(model.wall_normal);
    return status;
}

sb_status sb_model_room(const sb_scene *scene, const sb_model *bodies, sb_error *error)
{
    const double spacing = scene->resolution;
    const sb_vec3 size = sb_sub(scene->domain.max, scene->domain.min);
    const double cells =
        ceil(size.x / spacing) * ceil(size.z / spacing) * (scene->dimensions == 3 ? ceil(size.y / spacing) : 1);
    const double free_bytes = (double)sb_memory_available();
    if (!(free_bytes > 0) || cells * (fluid_bytes + wall_bytes) < free_bytes) return SB_OK;
    /* Most scenes are less full: the question is worth a coarse look. One that fails there, as a sea may that leaks
       through what is thin, is left to say so itself. */
    counts found;
    const double ratio = fmax(1, pow(cells / look_cells, 1.0 / scene->dimensions));
    if (look(scene, bodies, ratio, &found) != SB_OK) return SB_OK;
    const double bytes = found.fluid * fluid_bytes + found.walls * wall_bytes;
    if (bytes < free_bytes) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "resolution: %g m makes about %.2g particles of water and %.2g of walls: to place them takes %.3g GB "
        "of memory, and %.3g GB are free; expected a larger spacing or a smaller domain",
        spacing, found.fluid, found.walls, bytes / 1e9, free_bytes / 1e9);
}

/* Checks that there is enough memory for a model, before most of it is allocated. */
#include "base/memory.h"
#include "geometry/model/parts.h"

/* Bytes per fluid particle of a model (position, velocity, pressure), per column of water while columns are cut into
   runs, and per boundary particle while it is sampled (two copies, and its entry in the neighbour search, which
   grows by doubling; up to 205 were measured). */
static const double fluid_bytes = 56, column_bytes = 100, wall_bytes = 220;

/* Number of cells of the coarse model. */
static const double coarse_cells = 1e5;

typedef struct counts {
    double fluid, walls, columns;
} counts;

/* Counts the particles by a coarse model, in which each particle represents ratio^d fluid particles or ratio^(d-1)
   boundary particles. */
static sb_status count_coarsely(const sb_scene *scene, const sb_model *bodies, double ratio, counts *found)
{
    sb_scene coarse = *scene;
    sb_model model = *bodies; /* the bodies are shared and sampled again later; the warnings are not shared */
    model.warnings = NULL;
    model.warning_count = 0;
    sb_model_space space = {.count = 0};
    coarse.resolution *= ratio;
    sb_status status = sb_model_space_create(bodies, &coarse, &space, NULL);
    if (status == SB_OK) status = sb_model_fill(&coarse, &(sb_fill_share){0, 1}, &space, &model, NULL);
    if (status == SB_OK) status = sb_model_sample(&coarse, &space, &model, NULL);
    sb_model_space_free(&space);
    *found = (counts){(double)model.fluid_count * pow(ratio, scene->dimensions),
                      (double)model.wall_count * pow(ratio, scene->dimensions - 1), 0};
    for (size_t i = 0; i < model.warning_count; ++i) sb_free(model.warnings[i]);
    sb_free(model.warnings);
    sb_free(model.fluid_position);
    sb_free(model.fluid_velocity);
    sb_free(model.fluid_pressure);
    sb_free(model.wall_position);
    sb_free(model.wall_normal);
    return status;
}

static double columns_of(const sb_scene *scene, sb_vec3 min, sb_vec3 max)
{
    const double spacing = scene->resolution;
    return ceil((max.x - min.x) / spacing) * (scene->dimensions == 3 ? ceil((max.y - min.y) / spacing) : 1);
}

/* Returns upper bounds: one particle of each kind per cell, and for the sea and each box one column of water per
   column of the domain. */
static counts at_most(const sb_scene *scene)
{
    const sb_vec3 min = scene->domain.min, max = scene->domain.max;
    const double columns = columns_of(scene, min, max);
    const double cells = columns * ceil((max.z - min.z) / scene->resolution);
    return (counts){cells, cells, columns * (double)(scene->box_count + 1)};
}

static double count_columns(const sb_scene *scene)
{
    double count = scene->sea.present ? columns_of(scene, scene->domain.min, scene->domain.max) : 0;
    for (size_t b = 0; b < scene->box_count; ++b) count += columns_of(scene, scene->boxes[b].min, scene->boxes[b].max);
    return count;
}

/* Returns the bytes for placing the particles (twice those of the fluid if the sea and boxes are joined by a copy),
   or those that the caller needs, whichever are more. */
static double bytes_of(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, counts n)
{
    const double waters = (double)scene->box_count + scene->sea.present > 1 ? 2 : 1;
    const double placing = n.fluid * fluid_bytes * waters + n.columns * column_bytes + n.walls * wall_bytes;
    sb_model full = *bodies;
    full.fluid_count = (size_t)fmin(n.fluid, 1e18);
    full.wall_count = (size_t)fmin(n.walls, 1e18);
    full.min = scene->domain.min;
    full.max = scene->domain.max;
    return need ? fmax(placing, need(scene, &full)) : placing;
}

/* Returns the spacing at which the particles fit into memory, rounded up to two digits. */
static double fitting_spacing(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, counts n, double room)
{
    sb_scene other = *scene;
    const int d = scene->dimensions;
    for (double ratio = 1.02; ratio < 1e6; ratio *= 1.02) {
        other.resolution = scene->resolution * ratio;
        const counts fewer = {n.fluid / pow(ratio, d), n.walls / pow(ratio, d - 1), n.columns / pow(ratio, d - 1)};
        if (bytes_of(&other, bodies, need, fewer) <= room) break;
    }
    const double digit = pow(10, floor(log10(other.resolution)) - 1);
    return ceil(other.resolution / digit) * digit;
}

sb_status sb_model_room(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, sb_error *error)
{
    const double there = (double)sb_memory_available(), room = (1 - SB_MEMORY_SPARE) * there;
    const counts most = at_most(scene);
    if (!(there > 0) || bytes_of(scene, bodies, need, most) < room) return SB_OK;
    /* Most scenes fill less than all cells, so a coarse model gives a better estimate. If building it fails, for
       example because the sea leaks through a thin wall, the actual model reports that. */
    counts found;
    const double ratio = fmax(1, pow(most.fluid / coarse_cells, 1.0 / scene->dimensions));
    if (count_coarsely(scene, bodies, ratio, &found) != SB_OK) return SB_OK;
    found.columns = count_columns(scene);
    const double bytes = bytes_of(scene, bodies, need, found);
    if (bytes < room) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.300s: resolution: %g m makes about %.2g fluid and %.2g boundary particles: %s takes about %.3g GB "
        "of memory, and %.3g GB are available, of which a fifth is left free; expected %g m or more",
        scene->path ? scene->path : "the scene", scene->resolution, found.fluid, found.walls,
        need ? "a run" : "placing them", bytes / 1e9, there / 1e9, fitting_spacing(scene, bodies, need, found, room));
}

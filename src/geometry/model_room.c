/* Whether there is memory for a model, before much of it is taken. */
#include "base/memory.h"
#include "geometry/model_parts.h"

/* Bytes of a model's fluid particle: position, velocity, pressure; of a column of water while it is cut into runs; and
   of a boundary particle while it is sampled: the particle twice, and its place in the search for neighbours, which
   grows by doubling (up to 205 were measured). */
static const double fluid_bytes = 56, column_bytes = 100, wall_bytes = 220;

/* Cells of the coarse look. */
static const double look_cells = 1e5;

typedef struct counts {
    double fluid, walls, columns;
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

/* At most so many particles of each kind as there are cells, and a column of water for each of the domain's. */
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

/* To place them, where several waters are joined by a copy; or what the caller goes on to take. */
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

/* The spacing at which they fit, rounded up to two digits. */
static double fitting(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, counts n, double room)
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
    /* Most scenes are less full: the question is worth a coarse look. One that fails there, as a sea may that leaks
       through what is thin, is left to say so itself. */
    counts found;
    const double ratio = fmax(1, pow(most.fluid / look_cells, 1.0 / scene->dimensions));
    if (look(scene, bodies, ratio, &found) != SB_OK) return SB_OK;
    found.columns = count_columns(scene);
    const double bytes = bytes_of(scene, bodies, need, found);
    if (bytes < room) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.300s: resolution: %g m makes about %.2g fluid and %.2g boundary particles: %s takes about %.3g GB "
        "of memory, and %.3g GB are available, of which a fifth is left free; expected %g m or more",
        scene->path ? scene->path : "the scene", scene->resolution, found.fluid, found.walls,
        need ? "a run" : "placing them", bytes / 1e9, there / 1e9, fitting(scene, bodies, need, found, room));
}

#include "measure/floors.h"

#include "base/memory.h"

#include <stdlib.h>

/* Search radius in wall spacings. At least one boundary particle of a surface below the gauge is within it. A surface
   that ends at the gauge is not found: its nearest boundary particle is wall_offset spacings away, by default more. */
static const double NEAR = 0.72;

/* Spacings: two floors with a smaller vertical distance count as one. */
static const double STOREY = 1.5;

double sb_floors_radius(const sb_scene *scene)
{
    return NEAR * scene->numerics.wall_spacing * scene->resolution;
}

void sb_floors_free(sb_floors *floors)
{
    sb_free(floors->z);
    *floors = (sb_floors){0};
}

static int from_the_top(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a < b) - (a > b);
}

sb_status sb_floors_find(const sb_scene *scene, const sb_model *model, double x, double y, sb_floors *floors,
                         sb_error *error)
{
    const double radius = sb_floors_radius(scene);
    const double offset = scene->numerics.wall_offset * scene->resolution;
    for (size_t b = 0; b < model->body_count && model->wall_normal; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            const sb_vec3 at = model->wall_position[i], normal = model->wall_normal[i];
            if (!(normal.z > 0.5) || hypot(at.x - x, at.y - y) > radius) continue;
            if (sb_grow((void **)&floors->z, &floors->capacity, floors->count + 1, sizeof *floors->z) != 0)
                return sb_fail_memory(error, "floors under a gauge");
            floors->z[floors->count++] = at.z + offset;
        }
    }
    if (floors->count < 2) return SB_OK;
    qsort(floors->z, floors->count, sizeof *floors->z, from_the_top);
    size_t kept = 1;
    for (size_t i = 1; i < floors->count; i++)
        if (floors->z[kept - 1] - floors->z[i] > STOREY * scene->resolution) floors->z[kept++] = floors->z[i];
    floors->count = kept;
    return SB_OK;
}

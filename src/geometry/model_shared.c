/* Moving faces that stand before a wall, or in its plane: as long as both are within a support radius of the water,
   both bear it. */
#include "geometry/model_parts.h"
#include "geometry/sample_set.h"

/* Looking the same way: the cosine between two normals. BESIDE: in spacings, along the face. */
static const double SAME_WAY = 0.9, BESIDE = 0.75;

/* One in so many of a body's particles in front of a wall are no matter of an edge. */
enum { OF_EACH = 20 };

/* Static particles near a box. */
static int gather(const sb_model *model, sb_vec3 min, sb_vec3 max, sb_sample_set *near)
{
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            const sb_vec3 at = model->wall_position[i];
            if (at.x < min.x || at.y < min.y || at.z < min.z || at.x > max.x || at.y > max.y || at.z > max.z) continue;
            const sb_sample one = {.at = at, .normal = model->wall_normal[i], .source = (uint32_t)b};
            if (sb_sample_set_add(near, &one) != 0) return -1;
        }
    }
    return 0;
}

/* The static body whose face is behind this particle; SIZE_MAX: none within reach. */
static size_t behind(const sb_sample_set *near, sb_vec3 at, sb_vec3 normal, double spacing, double reach)
{
    for (double depth = 0; near->sample && depth <= reach; depth += spacing) {
        size_t index = 0;
        const sb_vec3 there = sb_madd(at, -depth, normal);
        if (!(sb_sample_set_nearest(near, there, BESIDE * spacing, &index) < BESIDE * spacing)) continue;
        const sb_sample *wall = &near->sample[index];
        if (sb_dot(wall->normal, normal) > SAME_WAY) return wall->source;
    }
    return SIZE_MAX;
}

static sb_status look(const sb_scene *scene, sb_model *model, const sb_model_body *body, sb_sample_set *near,
                      sb_error *error)
{
    const double reach = scene->numerics.support * model->spacing;
    sb_vec3 min = model->wall_position[body->begin], max = min, first = min;
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        min = sb_min(min, model->wall_position[i]);
        max = sb_max(max, model->wall_position[i]);
    }
    const sb_vec3 margin = sb_vec(2 * reach, 2 * reach, 2 * reach);
    near->origin = sb_sub(min, margin);
    if (gather(model, near->origin, sb_add(max, margin), near) != 0) return sb_fail_memory(error, "walls behind walls");
    size_t count = 0, wall = SIZE_MAX;
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        const size_t found = behind(near, model->wall_position[i], model->wall_normal[i], model->spacing, reach);
        if (found == SIZE_MAX) continue;
        if (count++ > 0) continue;
        wall = found;
        first = model->wall_position[i];
    }
    if (OF_EACH * count < body->count || wall == SIZE_MAX) return SB_OK;
    return sb_model_warn(
        model, error,
        "body \"%s\" moves, and near (%g, %g, %g) its face stands in front of \"%s\", which looks the same "
        "way, or in its plane: until they are %g m apart both bear the water, and the force on the "
        "moving one is told too small; expected a wall %g m or more behind the face",
        body->name, first.x, first.y, first.z, model->bodies[wall].name, reach, reach);
}

sb_status sb_model_warn_of_shared(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t b = 0; b < model->body_count && status == SB_OK; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker < 0 || body->count == 0) continue;
        sb_sample_set near = {.cell = model->spacing};
        status = look(scene, model, body, &near, error);
        sb_sample_set_free(&near);
    }
    return status;
}

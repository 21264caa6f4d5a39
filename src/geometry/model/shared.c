/* Warns of moving faces in front of a wall or in its plane: while both are within the support radius of the water,
   both carry its load. */
#include "geometry/model/parts.h"
#include "geometry/sampling/set.h"

/* SAME_WAY: cosine between two normals that point the same way. BESIDE: distance along the face, in spacings. */
static const double SAME_WAY = 0.9, BESIDE = 0.75;

/* A body is reported if at least one in OF_EACH of its particles is in front of a wall. Fewer occur at edges. */
enum { OF_EACH = 20 };

/* Collects the static particles near a box. */
static int gather(const sb_model *model, sb_vec3 min, sb_vec3 max, sb_sample_set *near)
{
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            const sb_vec3 at = model->wall_position[i];
            if (!sb_box_contains(min, max, at)) continue;
            const sb_sample one = {.at = at, .normal = model->wall_normal[i], .source = (uint32_t)b};
            if (sb_sample_set_add(near, &one) != 0) return -1;
        }
    }
    return 0;
}

/* Returns the static body with a face behind this particle within the depth `limit`; SIZE_MAX: none. */
static size_t behind(const sb_sample_set *near, sb_vec3 at, sb_vec3 normal, double spacing, double limit)
{
    for (double depth = 0; near->sample && depth <= limit; depth += spacing) {
        size_t index = 0;
        const sb_vec3 there = sb_madd(at, -depth, normal);
        if (!(sb_sample_set_nearest(near, there, BESIDE * spacing, &index) < BESIDE * spacing)) continue;
        const sb_sample *wall = &near->sample[index];
        if (sb_dot(wall->normal, normal) > SAME_WAY) return wall->source;
    }
    return SIZE_MAX;
}

void sb_model_shared_box(const sb_scene *scene, const sb_model *model, const sb_model_body *body, sb_vec3 *min,
                         sb_vec3 *max)
{
    const double support = scene->numerics.support * model->spacing;
    const sb_vec3 margin = sb_vec(2 * support, 2 * support, 2 * support);
    *min = *max = model->wall_position[body->begin];
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        *min = sb_min(*min, model->wall_position[i]);
        *max = sb_max(*max, model->wall_position[i]);
    }
    *min = sb_sub(*min, margin);
    *max = sb_add(*max, margin);
}

static sb_status check_body(const sb_scene *scene, sb_model *model, const sb_model_body *body, sb_sample_set *near,
                            sb_error *error)
{
    const double support = scene->numerics.support * model->spacing;
    sb_vec3 first = model->wall_position[body->begin], max;
    sb_model_shared_box(scene, model, body, &near->origin, &max);
    if (gather(model, near->origin, max, near) != 0) return sb_fail_memory(error, "walls behind walls");
    size_t count = 0, wall = SIZE_MAX;
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        const size_t found = behind(near, model->wall_position[i], model->wall_normal[i], model->spacing, support);
        if (found == SIZE_MAX) continue;
        if (count++ > 0) continue;
        wall = found;
        first = model->wall_position[i];
    }
    if (OF_EACH * count < body->count || wall == SIZE_MAX) return SB_OK;
    return sb_model_warn(
        model, error,
        "body \"%s\" moves, and near (%g, %g, %g) its face is in front of \"%s\" or in its plane, and both face the "
        "same "
        "way: until they are %g m apart both carry the load of the water, and the moving body's force is "
        "underestimated; expected a wall %g m or more behind the face",
        body->name, first.x, first.y, first.z, model->bodies[wall].name, support, support);
}

sb_status sb_model_warn_shared(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t b = 0; b < model->body_count && status == SB_OK; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker < 0 || body->count == 0) continue;
        sb_sample_set near = {.cell = model->spacing};
        status = check_body(scene, model, body, &near, error);
        sb_sample_set_free(&near);
    }
    return status;
}

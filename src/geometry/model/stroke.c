/* Warns of strokes that are faster than waves in their water, and of strokes that run into other bodies. */
#include "geometry/model/parts.h"
#include "physics/wavemakers/paddle_way.h"

#include <math.h>

/* Multiple of the speed of long waves that no paddle needs. A faster one most likely has wrong units. */
static const double FAST = 3;

/* AHEAD: cosine from which a particle's normal points along the motion. A body is reported if one in OF_EACH of
   these particles enters another body; fewer occur at edges. DEEP: depth in spacings that sampling does not explain. */
static const double AHEAD = 0.9, DEEP = 1;
enum { OF_EACH = 20, PLACES = 16 };

static sb_status check_speed(const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle_way *way,
                             sb_model *model, sb_error *error)
{
    const double waves = sqrt(scene->fluid.gravity * model->still_depth);
    if (!(waves > 0) || way->fastest <= FAST * waves) return SB_OK;
    return sb_model_warn(
        model, error,
        "wave maker \"%s\" moves at %.3g m/s at t = %.3g s, %.2g times as fast as long waves in its water: are "
        "its units m and s?",
        maker->name, way->fastest, way->when, way->fastest / waves);
}

static bool beyond_walls(const sb_domain *domain, int dimensions, sb_vec3 at, double depth)
{
    const double beyond[SB_SIDES] = {domain->min.x - at.x, at.x - domain->max.x, domain->min.y - at.y,
                                     at.y - domain->max.y, domain->min.z - at.z, at.z - domain->max.z};
    for (int side = 0; side < SB_SIDES; side++) {
        const bool flat = dimensions == 2 && (side == SB_Y_MIN || side == SB_Y_MAX);
        if (!flat && domain->side[side] == SB_SIDE_WALL && beyond[side] > depth) return true;
    }
    return false;
}

/* Returns the static body that contains the point by `depth` or more; SIZE_MAX: none. */
static size_t containing_body(const sb_scene *scene, const sb_model *model, const sb_model_space *space, sb_vec3 at,
                              double depth)
{
    if (model->dimensions == 2) at.y = 0;
    for (size_t b = 0; b < space->count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) continue;
        if (body->mesh.triangle_count == 0 ? beyond_walls(&scene->domain, scene->dimensions, at, depth)
                                           : space->solid[b] && sb_solid_contains(space->solid[b], at) &&
                                                 sb_solid_distance(space->solid[b], at, depth, NULL, NULL) >= depth)
            return b;
    }
    return SIZE_MAX;
}

/* Counts the particles of a body's leading face that are inside other bodies once it has moved by `shift`, and were
   not at the start. */
static size_t count_inside(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                           const sb_model_body *body, sb_vec3 shift, size_t *leading, size_t *other)
{
    const double depth = DEEP * model->spacing, offset = scene->numerics.wall_offset * model->spacing;
    const sb_vec3 way = sb_normalize(shift);
    size_t inside = 0, lead = 0, least = SIZE_MAX;
#pragma omp parallel for schedule(dynamic, 256) reduction(+ : inside, lead) reduction(min : least)
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        const sb_vec3 face = sb_madd(model->wall_position[i], offset, model->wall_normal[i]);
        if (sb_dot(model->wall_normal[i], way) < AHEAD || containing_body(scene, model, space, face, 0) != SIZE_MAX)
            continue;
        lead++;
        const size_t found = containing_body(scene, model, space, sb_add(face, shift), depth);
        inside += found != SIZE_MAX;
        least = found < least ? found : least;
    }
    *leading = lead;
    *other = least;
    return inside;
}

static sb_status check_way(const sb_scene *scene, const sb_model_space *space, const sb_model_body *body,
                           sb_vec3 direction, double travel, sb_model *model, sb_error *error)
{
    for (int k = 1; k <= PLACES; k++) {
        const double displacement = travel * k / PLACES;
        size_t leading, other;
        const size_t inside =
            count_inside(scene, space, model, body, sb_scale(direction, displacement), &leading, &other);
        if (inside == 0 || OF_EACH * inside < leading) continue;
        return sb_model_warn(
            model, error,
            "body \"%s\" runs into \"%s\": after %.3g m of its travel of %.3g m, part of its face is inside "
            "that body, and the water between them cannot escape",
            body->name, model->bodies[other].name, displacement, travel);
    }
    return SB_OK;
}

sb_status sb_model_warn_strokes(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t w = 0; w < scene->wavemaker_count && status == SB_OK; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        sb_paddle paddle;
        status = sb_paddle_create(&maker->law, &paddle, error);
        if (status != SB_OK) return status;
        const sb_paddle_way whole = sb_paddle_way_until(&paddle, scene->duration);
        sb_paddle_destroy(&paddle);
        status = check_speed(scene, maker, &whole, model, error);
        for (size_t b = 0; b < model->body_count && status == SB_OK; b++) {
            const sb_model_body *body = &model->bodies[b];
            if (body->wavemaker != (int)w) continue;
            const double share = 1 - body->held, travel[2] = {share * whole.most, share * whole.least};
            for (int way = 0; way < 2 && status == SB_OK; way++)
                if (fabs(travel[way]) > model->spacing)
                    status = check_way(scene, space, body, maker->direction, travel[way], model, error);
        }
    }
    return status;
}

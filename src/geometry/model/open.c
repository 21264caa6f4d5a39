/* Warns of water that stands at an open side at the start. A sea there is refused; a box of water flows out. */
#include "geometry/model/parts.h"

#include <stdio.h>

/* In spacings: beside a particle this near to a side, the next column lies beyond that side. */
static const double BESIDE = 0.75;

static const sb_vec3 outwards[SB_SIDES] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

/* Returns the distance of a point within the domain from a side. */
static double distance_to(const sb_model *model, int side, sb_vec3 at)
{
    const sb_vec3 low = sb_sub(at, model->min), high = sb_sub(model->max, at);
    const double distances[SB_SIDES] = {low.x, high.x, low.y, high.y, low.z, high.z};
    return distances[side];
}

static bool is_clear(const sb_model *model, const sb_model_space *space, sb_vec3 from, int side, double distance)
{
    for (size_t b = 0; b < space->count; ++b)
        if (space->solid[b] && model->bodies[b].mesh.triangle_count > 0 &&
            sb_solid_raycast(space->solid[b], from, outwards[side], distance) > 0)
            return false;
    return true;
}

/* Returns the box of water that contains the point, or the number of boxes. */
static size_t box_of(const sb_scene *scene, sb_vec3 at)
{
    size_t i = 0;
    for (; i < scene->box_count; ++i) {
        const sb_fluid_box *box = &scene->boxes[i];
        const bool flat = scene->dimensions == 2;
        if (at.x > box->min.x && at.x < box->max.x && at.z > box->min.z && at.z < box->max.z &&
            (flat || (at.y > box->min.y && at.y < box->max.y)))
            break;
    }
    return i;
}

/* The water that stands at a side. */
typedef struct standing {
    const sb_model_space *space;
    const sb_model *model;
    int side;
    sb_vec3 first;
    double low, high; /* m, of its particles */
} standing;

static void find_standing(void *context, const sb_water_piece *piece)
{
    standing *s = context;
    for (size_t i = 0; i < piece->count; ++i) {
        const sb_vec3 at = piece->position[i];
        const double distance = distance_to(s->model, s->side, at);
        if (distance >= BESIDE * s->model->spacing || !is_clear(s->model, s->space, at, s->side, distance)) continue;
        if (s->low > s->high) s->first = at;
        s->low = fmin(s->low, at.z);
        s->high = fmax(s->high, at.z);
    }
}

static sb_status check_side(const sb_scene *scene, const sb_model_space *space, int side, sb_model *model,
                            sb_error *error)
{
    standing s = {space, model, side, {0, 0, 0}, (double)INFINITY, -(double)INFINITY};
    char name[48] = "water";
    const sb_status status = sb_model_visit_water(space, model, find_standing, &s, error);
    if (status != SB_OK || s.low > s.high) return status;
    const sb_vec3 first = s.first;
    const size_t box = box_of(scene, first);
    if (box < scene->box_count) snprintf(name, sizeof name, "water.boxes[%zu]", box);
    return sb_model_warn(
        model, error,
        "%s: its water stands at the open side %s, near (%.4g, %.4g, %.4g) and %.2g m high, and leaves "
        "the domain there from the start; expected a wall at that side, or a body that holds the water",
        name, sb_side_names[side], first.x, first.y, first.z, s.high - s.low + model->spacing);
}

sb_status sb_model_warn_open(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (int side = 0; side < SB_Z_MAX && status == SB_OK; ++side) {
        const bool flat = scene->dimensions == 2 && (side == SB_Y_MIN || side == SB_Y_MAX);
        if (!flat && scene->domain.side[side] == SB_SIDE_OPEN) status = check_side(scene, space, side, model, error);
    }
    return status;
}

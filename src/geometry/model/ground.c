/* Warns of ground at an unintended depth: missing heights that the file does not mark, and ground below the domain's
   floor. */
#include "geometry/grid/missing.h"
#include "geometry/model/parts.h"

/* *lowest: the lowest height that is not taken for a missing one. */
static sb_status check_heights(const sb_scene *scene, const sb_model_body *body, double *lowest, sb_model *model,
                               sb_error *error)
{
    sb_vec3 min = scene->domain.min, max = scene->domain.max;
    sb_missing found;
    char text[600];
    if (scene->dimensions == 2) min.y = max.y = 0;
    const sb_status status = sb_missing_find(&body->mesh, min, max, &found, error);
    if (status != SB_OK || found.count == 0) return status;
    *lowest = found.low;
    sb_missing_tell(&found, &body->mesh, "domain", text, sizeof text);
    return sb_model_warn(model, error, "body \"%s\": %s", body->name, text);
}

/* PLACES_MAX: largest number of places at which ground below the domain's floor is looked for. In spacings: water
   within ON_FLOOR of the floor stands on it; ground less than BELOW below the floor is ignored. */
enum { PLACES_MAX = 20000 };
static const double ON_FLOOR = 1, BELOW = 0.25;

/* A search below the water on the domain's floor for the deepest ground between `bottom` and `lowest`. */
typedef struct search {
    const sb_solid *solid;
    double floor, top, reach, lowest; /* m; top: of the water that stands on the floor */
    size_t places, step, place;       /* such water in all; one of `step` is looked at; the next one's number */
    bool found;
    sb_vec3 deepest;
} search;

static void count_places(void *context, const sb_water_piece *piece)
{
    search *s = context;
    for (size_t i = 0; i < piece->count; ++i) s->places += piece->position[i].z < s->top;
}

static void look_below(void *context, const sb_water_piece *piece)
{
    search *s = context;
    for (size_t i = 0; i < piece->count; ++i) {
        sb_vec3 at = piece->position[i];
        if (at.z >= s->top || s->place++ % s->step != 0) continue;
        at.z = s->floor;
        const double depth = sb_solid_raycast(s->solid, at, sb_vec(0, 0, -1), s->reach);
        if (!(depth > 0) || s->floor - depth < s->lowest || s->floor - depth >= s->deepest.z) continue;
        s->deepest = sb_vec(at.x, at.y, s->floor - depth);
        s->found = true;
    }
}

/* Searches vertically below the water on the domain's floor. *deepest is unchanged if no ground lies below it. */
static sb_status find_deepest(const sb_model_space *space, const sb_model *model, const sb_solid *solid, double bottom,
                              double lowest, bool *found, sb_vec3 *deepest, sb_error *error)
{
    const double floor = model->min.z;
    search s = {.solid = solid,
                .floor = floor,
                .top = floor + ON_FLOOR * model->spacing,
                .reach = floor - bottom + model->spacing,
                .lowest = lowest,
                .deepest = *deepest};
    sb_status status = sb_model_visit_water(space, model, count_places, &s, error);
    s.step = s.places / PLACES_MAX + 1;
    if (status == SB_OK) status = sb_model_visit_water(space, model, look_below, &s, error);
    *found = s.found;
    *deepest = s.deepest;
    return status;
}

static sb_status check_floor(const sb_model_space *space, size_t index, double lowest, sb_model *model, sb_error *error)
{
    const sb_model_body *body = &model->bodies[index];
    const sb_mesh *mesh = space->mesh[index];
    const sb_solid *solid = space->solid[index];
    const double floor = model->min.z;
    double bottom = floor;
    sb_vec3 deepest = {0, 0, floor - BELOW * model->spacing};
    for (size_t i = 0; i < mesh->vertex_count; ++i) bottom = fmin(bottom, mesh->vertices[i].z);
    if (!solid || !(bottom < deepest.z)) return SB_OK;
    bool found = false;
    const sb_status status = find_deepest(space, model, solid, bottom, lowest, &found, &deepest, error);
    if (status != SB_OK || !found) return status;
    /* A corner of the ground may lie between the places. The lower edge of an added wall does not count. */
    for (size_t i = 0; i < mesh->vertex_count && body->mesh.ends == 0; ++i) {
        const sb_vec3 at = mesh->vertices[i];
        const bool within = at.x >= model->min.x && at.x <= model->max.x &&
                            (model->dimensions == 2 || (at.y >= model->min.y && at.y <= model->max.y));
        if (within && at.z >= lowest && at.z < deepest.z) deepest = at;
    }
    return sb_model_warn(model, error,
                         "body \"%s\": its ground below the water is as low as z = %.4g m, near (%.4g, %.4g), but the "
                         "domain's floor is at %g m: the water stands on that floor and is %.3g m shallower; expected "
                         "domain.min with z = %.4g m or lower",
                         body->name, deepest.z, deepest.x, model->dimensions == 2 ? 0 : deepest.y, floor,
                         floor - deepest.z, deepest.z);
}

sb_status sb_model_warn_ground(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t b = 0; b < model->body_count && status == SB_OK; ++b) {
        const sb_model_body *body = &model->bodies[b];
        double lowest = -(double)INFINITY;
        if (body->role != SB_ROLE_TERRAIN || body->mesh.triangle_count == 0) continue;
        if (body->mesh.node_count > 0) status = check_heights(scene, body, &lowest, model, error);
        if (status == SB_OK) status = check_floor(space, b, lowest, model, error);
    }
    return status;
}

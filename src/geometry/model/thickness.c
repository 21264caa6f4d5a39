/* Finds bodies so thin that the water on one side interacts with the water on the other side, or passes through. */
#include "geometry/model/parts.h"

#include <stdio.h>

enum { RAYS_MAX = 4000, BINS = 64 };

/* thin_share: fraction of a body's surface that must be thin for a plate. opposite: cosine between its two faces
   there, which excludes sharp edges. */
static const double thin_share = 0.05, opposite = -0.8;

/* In spacings: a plate of half a spacing holds water, one of a quarter lets it pass (docs/stability.md). A plate is
   at least a spacing wide along its faces, over more than half of its surface. Water flows around a slender column
   in any case, and a body with a few thin parts is not a plate. */
static const double thin_limit = 0.499, plate_width = 1, bulk_share = 0.5;

/* Areas in m², by what rays straight behind a body's faces meet. */
typedef struct thickness {
    double area, thin[BINS]; /* by depth up to the support radius */
    double leaky;            /* thinner than the limit, with room for water on both sides */
    double leaky_depth;      /* mean depth of that area times the area */
    double limit;            /* m */
} thickness;

/* Whether water can be at the point: inside the domain and outside of all solids. */
static bool is_open(const sb_model *model, const sb_model_space *space, sb_vec3 at)
{
    if (model->dimensions == 2) at.y = 0;
    if (!(at.x > model->min.x && at.x < model->max.x && at.z > model->min.z && at.z < model->max.z)) return false;
    if (model->dimensions == 3 && !(at.y > model->min.y && at.y < model->max.y)) return false;
    for (size_t b = 0; b < space->count; ++b)
        if (space->solid[b] && model->bodies[b].mesh.triangle_count > 0 && sb_solid_contains(space->solid[b], at))
            return false;
    return true;
}

/* Whether the body is a plate around a point inside it with the faces' normal: wide in all directions perpendicular
   to the normal. */
static bool is_wide(const sb_model *model, const sb_solid *solid, sb_vec3 at, sb_vec3 normal)
{
    enum { DIRECTIONS = 4 };
    const double limit = plate_width * model->spacing;
    const sb_vec3 aside = fabs(normal.y) < 0.7 ? sb_vec(0, 1, 0) : sb_vec(1, 0, 0);
    const sb_vec3 u = sb_normalize(sb_cross(normal, aside)), v = sb_cross(normal, u);
    for (int k = 0; k < DIRECTIONS; ++k) {
        if (model->dimensions == 2 && k > 0) return true;
        const double turn = M_PI * k / DIRECTIONS;
        const sb_vec3 along = sb_madd(sb_scale(u, cos(turn)), sin(turn), v);
        const double ahead = sb_solid_raycast(solid, at, along, limit);
        const double behind = sb_solid_raycast(solid, at, sb_scale(along, -1), limit);
        if (ahead >= 0 && behind >= 0 && ahead + behind < limit) return false;
    }
    return true;
}

/* Casts a ray straight behind the middle of one triangle and adds the triangle's area. */
static void look_behind(const sb_model *model, const sb_model_space *space, const sb_solid *solid,
                        const sb_vec3 corner[3], thickness *found)
{
    sb_vec3 normal = sb_cross(sb_sub(corner[1], corner[0]), sb_sub(corner[2], corner[0]));
    double size = sb_norm(normal), skin = 1e-6 * model->spacing;
    sb_vec3 back = sb_scale(sb_normalize(normal), -1);
    if (!(size > 0) || (model->dimensions == 2 && fabs(back.y) > 0.5)) return;
    sb_vec3 at = sb_scale(sb_add(corner[0], sb_add(corner[1], corner[2])), 1.0 / 3);
    double depth = sb_solid_raycast(solid, sb_madd(at, skin, back), back, found->limit);
    found->area += size;
    if (!(depth > 0 && depth < found->limit)) return;
    sb_vec3 far_face = sb_scale(back, -1), end = sb_madd(at, depth + skin, back);
    sb_solid_distance(solid, end, skin, NULL, &far_face);
    if (sb_dot(far_face, back) <= -opposite) return;
    found->thin[(int)(BINS * depth / found->limit)] += size;
    const double room = 0.5 * model->spacing;
    if (depth < thin_limit * model->spacing && is_wide(model, solid, sb_madd(at, 0.5 * depth, back), back) &&
        is_open(model, space, sb_madd(at, -room, back)) && is_open(model, space, sb_madd(end, room, back))) {
        found->leaky += size;
        found->leaky_depth += size * depth;
    }
}

static void find_thickness(const sb_model *model, const sb_model_space *space, const sb_mesh *mesh,
                           const sb_solid *solid, thickness *found)
{
    size_t step = mesh->triangle_count / RAYS_MAX + 1;
    for (size_t t = 0; t < mesh->triangle_count; t += step) {
        const uint32_t *of = mesh->triangles[t];
        const sb_vec3 corner[3] = {mesh->vertices[of[0]], mesh->vertices[of[1]], mesh->vertices[of[2]]};
        look_behind(model, space, solid, corner, found);
    }
}

/* Returns the depth below which the fraction thin_share of the area lies, at most the limit. */
static double plate_thickness(const thickness *found)
{
    double sum = 0;
    for (int i = 0; i < BINS; ++i) {
        sum += found->thin[i];
        if (sum > thin_share * found->area) return found->limit * (i + 1) / BINS;
    }
    return found->limit;
}

static double support_radius(const sb_scene *scene) /* m */
{
    return scene->numerics.support * scene->resolution;
}

static sb_status refuse(const sb_scene *scene, const char *name, double thick, sb_error *error)
{
    return sb_fail(error, SB_BAD_INPUT,
                   "%.300s: body \"%s\": about %.3g m thick over most of its surface, and water passes a plate thinner "
                   "than half the spacing (%.3g m), expected a thicker body, or a resolution of %.3g m or less",
                   scene->path ? scene->path : "the scene", name, thick, 0.5 * scene->resolution, 2 * thick);
}

sb_status sb_model_check_thickness(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                                   sb_model_body *body, sb_error *error)
{
    sb_plate_row row = {0};
    if (body->plates > 0 && sb_scene_plates(scene, &scene->wavemakers[body->wavemaker], &row) > 0 && row.axis == 2)
        return SB_OK; /* a row of a flap */
    if (body->role != SB_ROLE_SOLID || body->mesh.open_surface || body->mesh.triangle_count == 0) return SB_OK;
    thickness found = {.limit = support_radius(scene)};
    sb_solid *solid = NULL;
    sb_status status = sb_solid_create(&body->mesh, body->role, &solid, error);
    if (status != SB_OK) return status;
    find_thickness(model, space, &body->mesh, solid, &found);
    sb_solid_destroy(solid);
    if (found.leaky > bulk_share * found.area) return refuse(scene, body->name, found.leaky_depth / found.leaky, error);
    double thick = plate_thickness(&found);
    body->thin = thick < found.limit ? thick : 0;
    return SB_OK;
}

/* Returns the thinnest of the thin bodies; NULL: none. count: number of thin bodies. */
static const sb_model_body *find_thinnest(const sb_model *model, size_t *count)
{
    const sb_model_body *thinnest = NULL;
    *count = 0;
    for (size_t i = 0; i < model->body_count; ++i) {
        const sb_model_body *body = model->bodies + i;
        if (!(body->thin > 0)) continue;
        ++*count;
        if (!thinnest || body->thin < thinnest->thin) thinnest = body;
    }
    return thinnest;
}

sb_status sb_model_warn_thin(const sb_scene *scene, sb_model *model, sb_error *error)
{
    size_t left, length = 0;
    const sb_model_body *thinnest = find_thinnest(model, &left);
    char others[700] = "";
    if (!thinnest) return SB_OK;
    left--;
    for (size_t i = 0; i < model->body_count && length + sizeof thinnest->name + 32 < sizeof others; ++i) {
        const sb_model_body *body = model->bodies + i;
        if (!(body->thin > 0) || body == thinnest) continue;
        length += (size_t)snprintf(others + length, sizeof others - length, "%s \"%s\" %.2g m",
                                   length == 0 ? "; likewise" : ",", body->name, body->thin);
        left--;
    }
    if (left > 0) snprintf(others + length, sizeof others - length, " and %zu more", left);
    return sb_model_warn(model, error,
                         "body \"%s\" is about %.2g m thick, less than the support radius of %.3g m: water "
                         "on one side exerts forces on water on the other side%s",
                         thinnest->name, thinnest->thin, support_radius(scene), others);
}

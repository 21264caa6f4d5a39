/* Ground at another depth than was meant: missing heights whose value the file does not give, and ground below the
   domain's floor. */
#include "base/memory.h"
#include "geometry/model_parts.h"

#include <stdlib.h>
#include <string.h>

/* A height is taken for missing where it is farther from all others than so many times their range and than so many
   times the domain's height. */
static const double FAR_OFF = 10;

/* Heights of a grid's nodes within the domain, ascending; owned. */
typedef struct heights {
    double *z;
    size_t count, first, end; /* [first, end): those that belong to the domain's ground */
} heights;

/* Nodes outside of the domain count as well where a triangle of theirs is partly within. */
static bool is_within(const sb_scene *scene, const sb_mesh *mesh, size_t triangle)
{
    const uint32_t *of = mesh->triangles[triangle];
    sb_vec3 min = mesh->vertices[of[0]], max = min;
    for (int k = 1; k < 3; ++k) {
        min = sb_min(min, mesh->vertices[of[k]]);
        max = sb_max(max, mesh->vertices[of[k]]);
    }
    const bool flat = scene->dimensions == 2;
    const double south = flat ? 0 : scene->domain.min.y, north = flat ? 0 : scene->domain.max.y;
    return max.x >= scene->domain.min.x && min.x <= scene->domain.max.x && max.y >= south && min.y <= north;
}

static int compare_numbers(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Of the groups of heights with wide gaps between them, the one within the domain with most nodes. */
static void find_ground(const sb_domain *domain, heights *all)
{
    const double gap = FAR_OFF * (domain->max.z - domain->min.z);
    for (size_t i = 0, end; i < all->count; i = end) {
        for (end = i + 1; end < all->count && all->z[end] - all->z[end - 1] <= gap;) ++end;
        if (all->z[i] > domain->max.z || all->z[end - 1] < domain->min.z || end - i <= all->end - all->first) continue;
        all->first = i;
        all->end = end;
    }
}

static sb_status sort_heights(const sb_scene *scene, const sb_mesh *mesh, uint8_t **within, heights *all,
                              sb_error *error)
{
    *within = sb_alloc(mesh->vertex_count, 1);
    if (!*within) return sb_fail_memory(error, "the heights of a grid");
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        for (int k = 0; k < 3 && is_within(scene, mesh, t); ++k) (*within)[mesh->triangles[t][k]] = 1;
    memset(*within + mesh->node_count, 0, mesh->vertex_count - mesh->node_count);
    for (size_t i = 0; i < mesh->node_count; ++i) all->count += (*within)[i];
    all->z = sb_alloc_untouched(all->count, sizeof *all->z);
    if (!all->z) return sb_fail_memory(error, "the heights of a grid");
    for (size_t i = 0, next = 0; i < mesh->node_count; ++i)
        if ((*within)[i]) all->z[next++] = mesh->vertices[i].z;
    qsort(all->z, all->count, sizeof *all->z, compare_numbers);
    find_ground(&scene->domain, all);
    return SB_OK;
}

/* *lowest: of the heights that are trusted. */
static sb_status check_heights(const sb_scene *scene, const sb_model_body *body, double *lowest, sb_model *model,
                               sb_error *error)
{
    const sb_mesh *mesh = &body->mesh;
    uint8_t *within = NULL;
    heights all = {.count = 0};
    sb_status status = sort_heights(scene, mesh, &within, &all, error);
    if (status == SB_OK && all.end > all.first) {
        const double low = all.z[all.first], high = all.z[all.end - 1];
        const double far = FAR_OFF * fmax(scene->domain.max.z - scene->domain.min.z, high - low);
        size_t count = 0, first = SIZE_MAX;
        double least = (double)INFINITY, most = -(double)INFINITY;
        for (size_t i = mesh->node_count; i-- > 0;) {
            const double z = mesh->vertices[i].z;
            if (!within[i] || (z >= low - far && z <= high + far)) continue;
            ++count;
            first = i;
            least = fmin(least, z);
            most = fmax(most, z);
        }
        *lowest = count > 0 ? low : *lowest;
        if (count > 0)
            status = sb_model_warn(
                model, error,
                "body \"%s\": %zu of its grid's nodes within the domain %s at z = %g m%s, far %s all others, which are "
                "from %g to %g m; the first is at (%g, %g): most likely missing heights (nodata) whose value the file "
                "does not give; expected their NODATA_value in the header, or no lines for them in an .xyz file",
                body->name, count, count > 1 ? "are" : "is", least, most > least ? " and more" : "",
                most < low     ? "below"
                : least > high ? "above"
                               : "from",
                low, high, mesh->vertices[first].x, mesh->vertices[first].y);
    }
    sb_free(within);
    sb_free(all.z);
    return status;
}

/* Most places at which the ground below the domain's floor is looked for. In spacings: water so near to the floor
   stands on it; ground that is no farther below the floor is no matter. */
enum { PLACES_MAX = 20000 };
static const double ON_FLOOR = 1, BELOW = 0.25;

/* Straight down from the water on the domain's floor to the ground, which is no deeper than `bottom`: the deepest
   place, of those above `lowest`; false: there is none below *deepest. */
static bool sound(const sb_model *model, const sb_solid *solid, double bottom, double lowest, sb_vec3 *deepest)
{
    const double floor = model->min.z, top = floor + ON_FLOOR * model->spacing;
    size_t places = 0, place = 0;
    bool found = false;
    for (size_t i = 0; i < model->fluid_count; ++i) places += model->fluid_position[i].z < top;
    const size_t step = places / PLACES_MAX + 1;
    for (size_t i = 0; i < model->fluid_count; ++i) {
        sb_vec3 at = model->fluid_position[i];
        if (at.z >= top || place++ % step != 0) continue;
        at.z = floor;
        const double depth = sb_solid_raycast(solid, at, sb_vec(0, 0, -1), floor - bottom + model->spacing);
        if (!(depth > 0) || floor - depth < lowest || floor - depth >= deepest->z) continue;
        *deepest = sb_vec(at.x, at.y, floor - depth);
        found = true;
    }
    return found;
}

static sb_status check_floor(const sb_model_body *body, const sb_mesh *mesh, const sb_solid *solid, double lowest,
                             sb_model *model, sb_error *error)
{
    const double floor = model->min.z;
    double bottom = floor;
    sb_vec3 deepest = {0, 0, floor - BELOW * model->spacing};
    for (size_t i = 0; i < mesh->vertex_count; ++i) bottom = fmin(bottom, mesh->vertices[i].z);
    if (!solid || !(bottom < deepest.z) || !sound(model, solid, bottom, lowest, &deepest)) return SB_OK;
    /* A corner of the ground may be between the places; but not the foot of a wall at its end. */
    for (size_t i = 0; i < mesh->vertex_count && body->mesh.ends == 0; ++i) {
        const sb_vec3 at = mesh->vertices[i];
        const bool within = at.x >= model->min.x && at.x <= model->max.x &&
                            (model->dimensions == 2 || (at.y >= model->min.y && at.y <= model->max.y));
        if (within && at.z >= lowest && at.z < deepest.z) deepest = at;
    }
    return sb_model_warn(model, error,
                         "body \"%s\": its ground under the water is as low as z = %.4g m, near (%.4g, %.4g), and the "
                         "domain's floor is at %g m: the water stands on that floor and is %.3g m less deep; expected "
                         "domain.min of z = %.4g m or lower",
                         body->name, deepest.z, deepest.x, model->dimensions == 2 ? 0 : deepest.y, floor,
                         floor - deepest.z, deepest.z);
}

sb_status sb_model_warn_of_ground(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t b = 0; b < model->body_count && status == SB_OK; ++b) {
        const sb_model_body *body = &model->bodies[b];
        double lowest = -(double)INFINITY;
        if (body->role != SB_ROLE_TERRAIN || body->mesh.triangle_count == 0) continue;
        if (body->mesh.node_count > 0) status = check_heights(scene, body, &lowest, model, error);
        if (status == SB_OK) status = check_floor(body, space->mesh[b], space->solid[b], lowest, model, error);
    }
    return status;
}

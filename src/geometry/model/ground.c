/* Warns of ground at an unintended depth: missing heights that the file does not mark, and ground below the domain's
   floor. */
#include "base/memory.h"
#include "geometry/model/parts.h"

#include <stdlib.h>
#include <string.h>

/* A height counts as missing if it is farther from all others than this many times their range and than this many
   times the domain's height. */
static const double FAR_OFF = 10;

/* Heights of a grid's nodes within the domain, in ascending order. Owned. */
typedef struct heights {
    double *z;
    size_t count, first, end; /* [first, end): those of the domain's ground */
} heights;

/* Whether a triangle is partly within the domain. Nodes outside of the domain count, too, if one of their triangles
   is. */
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

/* Selects the domain's ground: of the groups of heights that are separated by wide gaps, the one within the domain's
   range with the most nodes. */
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

/* *lowest: the lowest height that is not taken for a missing one. */
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
                "does not state; expected their NODATA_value in the header, or no lines for them in an .xyz file",
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

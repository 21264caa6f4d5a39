/* Adds walls where terrain ends within the domain, and warns of them. The ground below a terrain is solid. Without a
   wall at its border, water would enter from the side and leave through the floor, which has no boundary particles
   below solids. */
#include "geometry/model/parts.h"

#include "base/memory.h"

#include <stdio.h>

/* In spacings: a solid is looked for ASIDE outwards from the border and BELOW it. A gap narrower than that lets no
   water in, and a step lower than that needs no wall, because the boundary surfaces of both sides cover it. */
static const double ASIDE = 0.05, BELOW = 0.5;
/* In spacings, added to the support radius: depth to which the walls continue below the domain's floor or the
   border, whichever is lower. */
static const double FARTHER = 4;
enum { PROBES_MAX = 10000, LEVELS_MAX = 1000 };

/* The static bodies. Their solids are created when the first border within the domain is found. */
typedef struct ground {
    const sb_scene *scene;
    const sb_model *model;
    sb_solid **solid; /* per body, NULL: it moves or has no mesh */
    bool made;
    sb_status status;
    sb_error *error;
} ground;

static bool stays(const sb_model_body *body)
{
    return body->wavemaker < 0 && body->mesh.triangle_count > 0;
}

static void make_solids(ground *g)
{
    g->made = true;
    for (size_t b = 0; b < g->model->body_count && g->status == SB_OK; ++b) {
        const sb_model_body *body = g->model->bodies + b;
        if (stays(body)) g->status = sb_solid_create(&body->mesh, body->role, g->solid + b, g->error);
    }
}

/* Whether the point lies inside a static solid. *terrain: it lies below a terrain, so everything below it is solid,
   too. */
static bool in_solid(ground *g, sb_vec3 at, bool *terrain)
{
    bool found = *terrain = false;
    if (!g->made) make_solids(g);
    for (size_t b = 0; b < g->model->body_count && !*terrain; ++b) {
        if (!g->solid[b] || !sb_solid_contains(g->solid[b], at)) continue;
        *terrain = g->model->bodies[b].role == SB_ROLE_TERRAIN;
        found = found || *terrain || !sb_solid_beside(g->solid[b], at);
    }
    return found;
}

/* Reduces [*low, *high] to the range of t for which from + t way lies within the domain along one axis. */
static void cut(double from, double way, double min, double max, double *low, double *high)
{
    if (way == 0) {
        if (from < min || from > max) *high = -1;
        return;
    }
    const double a = (min - from) / way, b = (max - from) / way;
    *low = fmax(*low, fmin(a, b));
    *high = fmin(*high, fmax(a, b));
}

/* Whether water can stand beside the border here, at any height below it: the point is within the domain, and no
   solid continues there. */
static bool is_open(ground *g, sb_vec3 at, sb_vec3 outwards)
{
    const sb_scene *s = g->scene;
    const sb_vec3 min = s->domain.min, max = s->domain.max;
    sb_vec3 probe = sb_madd(at, ASIDE * s->resolution, outwards);
    if (s->dimensions == 2) probe.y = 0;
    probe.z = fmin(at.z, max.z) - BELOW * s->resolution;
    if (!(probe.x > min.x && probe.x < max.x)) return false;
    if (s->dimensions == 3 && !(probe.y > min.y && probe.y < max.y)) return false;
    bool terrain = false;
    for (int k = 0; k < LEVELS_MAX && probe.z > min.z && !terrain; ++k, probe.z -= s->resolution)
        if (!in_solid(g, probe, &terrain)) return true;
    return false;
}

/* sb_mesh_ends: whether water can stand beside the edge anywhere within the domain. */
static bool ends_here(void *context, sb_vec3 from, sb_vec3 to)
{
    ground *g = context;
    const sb_scene *s = g->scene;
    const sb_vec3 min = s->domain.min, max = s->domain.max, way = sb_sub(to, from);
    double low = 0, high = 1;
    sb_vec3 outwards = sb_normalize(sb_vec(way.y, -way.x, 0));
    if (g->status != SB_OK || (way.x == 0 && way.y == 0)) return false;
    if (s->dimensions == 2) {
        if ((from.y >= 0) == (to.y >= 0)) return false;
        low = high = from.y / (from.y - to.y);
        outwards = sb_vec(way.y > 0 ? 1 : -1, 0, 0);
    } else {
        cut(from.y, way.y, min.y, max.y, &low, &high);
    }
    cut(from.x, way.x, min.x, max.x, &low, &high);
    if (!(low <= high)) return false;
    const double length = (high - low) * sqrt(way.x * way.x + way.y * way.y);
    const int probes = (int)fmin(ceil(length / s->resolution) + 1, PROBES_MAX);
    for (int k = 0; k < probes; ++k)
        if (is_open(g, sb_madd(from, low + (high - low) * (k + 0.5) / probes, way), outwards)) return true;
    return false;
}

sb_status sb_model_end_terrain(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const double depth = (scene->numerics.support + FARTHER) * scene->resolution;
    ground g = {.scene = scene, .model = model, .error = error};
    g.solid = sb_alloc(model->body_count + 1, sizeof(void *));
    if (!g.solid) return sb_fail_memory(error, "the ends of terrains");
    for (size_t b = 0; b < model->body_count && g.status == SB_OK; ++b) {
        if (!stays(model->bodies + b) || model->bodies[b].role != SB_ROLE_TERRAIN) continue;
        sb_status status = sb_mesh_skirt(&model->bodies[b].mesh, ends_here, &g, scene->domain.min.z, depth, error);
        if (g.status == SB_OK) g.status = status;
    }
    for (size_t b = 0; b < model->body_count; ++b) sb_solid_destroy(g.solid[b]);
    sb_free(g.solid);
    return g.status;
}

/* Describes the missing heights of a grid within the domain, as the end of a warning; empty if there are none. */
static void describe_holes(const sb_scene *scene, const sb_mesh *mesh, char *text, size_t size)
{
    const sb_vec3 min = scene->domain.min, max = scene->domain.max;
    size_t count = 0, first = 0;
    text[0] = 0;
    for (size_t i = mesh->hole_count; i-- > 0;) {
        const sb_vec3 at = mesh->holes[i];
        if (!(at.x >= min.x && at.x <= max.x)) continue;
        if (scene->dimensions == 3 && !(at.y >= min.y && at.y <= max.y)) continue;
        ++count;
        first = i;
    }
    if (count > 0)
        snprintf(text, size, "; within the domain its grid has no height (nodata) at %zu node%s, the first at (%g, %g)",
                 count, count > 1 ? "s" : "", mesh->holes[first].x, mesh->holes[first].y);
}

sb_status sb_model_warn_ends(const sb_scene *scene, const sb_model_body *body, sb_model *model, sb_error *error)
{
    const sb_mesh *mesh = &body->mesh;
    char holes[160];
    if (mesh->ends == 0) return SB_OK;
    describe_holes(scene, mesh, holes, sizeof holes);
    return sb_model_warn(
        model, error,
        "body \"%s\": the ground ends within the domain, at %zu open edge%s, the first at (%g, %g, "
        "%g): a wall is added below each, and the water beside that wall extends down to the domain's floor%s",
        body->name, mesh->ends, mesh->ends > 1 ? "s" : "", mesh->first_end.x, mesh->first_end.y, mesh->first_end.z,
        holes);
}

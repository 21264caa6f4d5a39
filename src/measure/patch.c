/* Pressure on a wall: the force of the water on a part of it, divided by area.

   The simulation reports each force on a wall with its place (sb_sim_pushes). A patch takes their parts along its
   normal with the weight

       W(x, c) = w(|x - c|) / (a(x) a(c)),   w(r) = (1 - r^2 / R^2)^2,

   x the place on the face and c the probe. The function a is found such that the integral of W over the face is 1 for
   each x and for each c (Sinkhorn, Knopp 1967). Therefore a uniform pressure is read as it is, also at edges, and
   the pressures of probes all over a face sum to the force on it, whatever the shape of the face and the pressure. */
#include "measure/patch.h"

#include "base/memory.h"
#include "measure/patch_region.h"

/* How a boundary particle near the probe is related to the patch. */
enum wall_part {
    SURFACE,  /* of the boundary surface under the probe */
    EDGE,     /* of the row at an edge of that surface */
    CROSSING, /* of a wall that crosses the surface */
    UNRELATED
};

typedef struct patch_wall {
    sb_vec3 position, normal;
    size_t body;
    enum wall_part part;
} patch_wall;

enum { BODIES_MAX = 4 }; /* that share the surface under a probe */

struct sb_patch {
    bool on_wall, flat;            /* flat: in 2D */
    double spacing, first_layer;   /* m */
    double offset;                 /* m, from a boundary surface to the physical surface */
    double radius, behind, before; /* m; greatest distances behind and before the surface at which water counts */
    double period[2];              /* m, along x and y; 0: not periodic */
    sb_vec3 normal, center;        /* of the disk, which lies in the boundary surface */
    sb_vec3 wetness_point;
    size_t body_count, body[BODIES_MAX];
    sb_patch_region region;
    size_t count, capacity;
    patch_wall *walls;
};

/* A fluid particle within wall_offset plus this many spacings of a boundary particle is in the first layer. That layer
   rests half a spacing in front of the physical surface, the next one 1.5 spacings. */
#define FIRST_LAYER 1.0

#define PATCH_RADIUS 2.0 /* spacings, when the probe has no radius */

void sb_patch_destroy(sb_patch *patch)
{
    if (!patch) return;
    sb_patch_region_free(&patch->region);
    sb_free(patch->walls);
    sb_free(patch);
}

size_t sb_patch_bytes(const sb_patch *patch)
{
    return sizeof *patch + patch->capacity * sizeof *patch->walls + sb_patch_region_bytes(&patch->region);
}

bool sb_patch_on_wall(const sb_patch *patch)
{
    return patch->on_wall;
}

sb_vec3 sb_patch_wetness_point(const sb_patch *patch)
{
    return patch->wetness_point;
}

bool sb_patch_first_layer(const sb_patch *patch, sb_vec3 position)
{
    double limit = patch->first_layer;
    for (size_t i = 0; i < patch->count; i++) {
        sb_vec3 d = sb_sub(position, patch->walls[i].position);
        if (sb_dot(d, d) < limit * limit) return true;
    }
    return false;
}

static sb_status add_wall(sb_patch *patch, size_t body, sb_vec3 position, sb_vec3 normal, sb_error *error)
{
    if (sb_grow((void **)&patch->walls, &patch->capacity, patch->count + 1, sizeof *patch->walls) != 0)
        return sb_fail_memory(error, "wall around a probe");
    patch->walls[patch->count++] = (patch_wall){.position = position, .normal = normal, .body = body};
    return SB_OK;
}

/* Adds a boundary particle and its periodic images, as far as they are within the range. */
static sb_status add_near(sb_patch *patch, size_t body, sb_vec3 position, sb_vec3 normal, sb_vec3 at, double range,
                          sb_error *error)
{
    const double *length = patch->period;
    int most[2];
    for (int axis = 0; axis < 2; axis++) most[axis] = length[axis] > 0 ? 1 + (int)ceil(range / length[axis]) : 0;
    for (int j = -most[1]; j <= most[1]; j++)
        for (int i = -most[0]; i <= most[0]; i++) {
            sb_vec3 image = sb_add(position, sb_vec(i * length[0], j * length[1], 0));
            sb_vec3 d = sb_sub(image, at);
            if (sb_dot(d, d) >= range * range) continue;
            sb_status status = add_wall(patch, body, image, normal, error);
            if (status != SB_OK) return status;
        }
    return SB_OK;
}

static sb_status collect(sb_patch *patch, const sb_model *model, sb_vec3 at, double range, sb_error *error)
{
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) /* it moves away from the probe */
            continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            sb_vec3 normal = model->wall_normal ? model->wall_normal[i] : sb_vec(0, 0, 0);
            sb_status status = add_near(patch, b, model->wall_position[i], normal, at, range, error);
            if (status != SB_OK) return status;
        }
    }
    return SB_OK;
}

/* Whether two boundary particles lie near each other in one plane. */
static bool coplanar(const patch_wall *a, const patch_wall *b, double spacing)
{
    const sb_vec3 d = sb_sub(b->position, a->position);
    return sb_norm(d) < 2.5 * spacing && fabs(sb_dot(d, a->normal)) < 0.3 * spacing &&
           sb_dot(b->normal, a->normal) > 0.98;
}

/* Number of boundary particles near one that lie in the same plane. */
static size_t count_coplanar(const sb_patch *patch, const patch_wall *wall)
{
    size_t count = 0;
    for (size_t k = 0; k < patch->count; k++) count += coplanar(wall, &patch->walls[k], patch->spacing);
    return count;
}

/* Whether those particles lie on one line: an edge of a body in 3D. */
static bool is_row(const sb_patch *patch, const patch_wall *wall)
{
    sb_vec3 along = {0};
    double aside = 0;
    for (size_t k = 0; k < patch->count; k++) {
        const sb_vec3 d = sb_sub(patch->walls[k].position, wall->position);
        if (coplanar(wall, &patch->walls[k], patch->spacing) && sb_norm(d) > sb_norm(along)) along = d;
    }
    if (sb_norm(along) == 0) return true;
    for (size_t k = 0; k < patch->count; k++)
        if (coplanar(wall, &patch->walls[k], patch->spacing))
            aside = fmax(aside, sb_norm(sb_cross(sb_sub(patch->walls[k].position, wall->position), along)));
    return aside < 0.3 * patch->spacing * sb_norm(along);
}

/* The nearest boundary particle; if that one belongs to a rounded edge, one of the plane face beside the edge. */
static const patch_wall *nearest_wall(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL, *plane = NULL;
    for (size_t i = 0; i < patch->count; i++)
        if (!best || sb_norm(sb_sub(patch->walls[i].position, at)) < sb_norm(sb_sub(best->position, at)))
            best = &patch->walls[i];
    if (!best) return NULL;
    const double range = sb_norm(sb_sub(best->position, at)) + patch->spacing;
    const bool at_edge = !patch->flat && is_row(patch, best);
    size_t most = at_edge ? 0 : 2 * count_coplanar(patch, best);
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        const sb_vec3 d = sb_sub(at, wall->position);
        if (sb_norm(d) > range || fabs(sb_dot(d, wall->normal) - patch->offset) > 0.25 * patch->spacing) continue;
        if (count_coplanar(patch, wall) <= most || (at_edge && is_row(patch, wall))) continue;
        most = count_coplanar(patch, wall);
        plane = wall;
    }
    return plane ? plane : best;
}

/* ---- the face under the probe ---- */

static double height_over_surface(const sb_patch *patch, sb_vec3 at)
{
    return sb_dot(sb_sub(at, patch->center), patch->normal);
}

/* Whether the surface of a boundary particle protrudes from the patch's surface: others in the particle's plane lie in
   front of it. On stairs, the riser at the back of a tread protrudes, the riser at its front does not. */
static bool protrudes(const sb_patch *patch, const patch_wall *wall)
{
    for (size_t k = 0; k < patch->count; k++) {
        const patch_wall *other = &patch->walls[k];
        if (sb_dot(other->normal, wall->normal) > 0.9 &&
            height_over_surface(patch, other->position) > 0.25 * patch->spacing &&
            fabs(sb_dot(sb_sub(other->position, wall->position), wall->normal)) < 0.5 * patch->spacing)
            return true;
    }
    return false;
}

/* Depth of a point on the face within a crossing wall, m; 0 or less: in front of it, where water can be. */
static double depth_within(const sb_patch *patch, const patch_wall *crossing, sb_vec3 at)
{
    return patch->offset - sb_dot(sb_sub(at, crossing->position), crossing->normal);
}

/* The point of the physical surface above a point of the boundary surface. */
static sb_vec3 onto_face(const sb_patch *patch, sb_vec3 at)
{
    return sb_madd(at, patch->offset, patch->normal);
}

/* A crossing wall has the probe in front of it; the opposite wall of a narrow channel does not count. */
static enum wall_part part_of(const sb_patch *patch, const patch_wall *wall)
{
    const double height = height_over_surface(patch, wall->position), s = patch->spacing;
    const double cosine = sb_dot(wall->normal, patch->normal);
    if (cosine > 0.9) return fabs(height) < 0.3 * s ? SURFACE : UNRELATED;
    if (sb_norm(wall->normal) < 0.5) return UNRELATED;
    if (protrudes(patch, wall)) {
        const bool in_front = depth_within(patch, wall, onto_face(patch, patch->center)) < 0.25 * s;
        return in_front && cosine > -0.9 ? CROSSING : UNRELATED;
    }
    return cosine > 0.05 && fabs(height) < 0.3 * s ? EDGE : UNRELATED;
}

/* The boundary particle of a crossing wall that is nearest to a point on the face, within 2.5 spacings; NULL: none. */
static const patch_wall *nearest_crossing(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL;
    double nearest = 2.5 * patch->spacing;
    for (size_t k = 0; k < patch->count; k++) {
        const double distance = sb_norm(sb_sub(patch->walls[k].position, at));
        if (patch->walls[k].part != CROSSING || distance >= nearest) continue;
        best = &patch->walls[k];
        nearest = distance;
    }
    return best;
}

/* Moves a point along the face until it is at least `off` in front of all crossing walls. Returns the point itself if
   that is so already. Several turns are needed in a corner of two walls. */
static sb_vec3 out_of_walls(const sb_patch *patch, sb_vec3 at, double off)
{
    for (int turn = 0; turn < 3; turn++) {
        const patch_wall *crossing = nearest_crossing(patch, at);
        const double depth = crossing ? depth_within(patch, crossing, at) + off : 0;
        if (!(depth > 1e-6 * patch->spacing)) return at;
        const sb_vec3 n = crossing->normal, along = sb_madd(n, -sb_dot(n, patch->normal), patch->normal);
        at = sb_madd(at, depth / sb_dot(along, along), along);
    }
    return at;
}

/* Whether a point of the disk's plane is on the face, in front of crossing walls. */
static bool on_face(const void *context, sb_vec3 at)
{
    const sb_patch *patch = context;
    const double limit = fmax(patch->offset, 0.75 * patch->spacing) * (1 + 1e-6);
    bool covered = false;
    for (size_t k = 0; k < patch->count && !covered; k++)
        covered = patch->walls[k].part <= EDGE && sb_norm(sb_sub(patch->walls[k].position, at)) < limit;
    if (!covered) return false;
    const patch_wall *crossing = nearest_crossing(patch, onto_face(patch, at));
    return !crossing || depth_within(patch, crossing, onto_face(patch, at)) < 0;
}

/* Adds the bodies that the surface belongs to. */
static void add_bodies(sb_patch *patch)
{
    for (size_t k = 0; k < patch->count; k++) {
        size_t known = 0;
        if (patch->walls[k].part != SURFACE) continue;
        while (known < patch->body_count && patch->body[known] != patch->walls[k].body) known++;
        if (known == patch->body_count && known < BODIES_MAX) patch->body[patch->body_count++] = patch->walls[k].body;
    }
}

/* Chooses the face and its bodies. The disk lies in the boundary surface. */
static sb_status choose_face(sb_patch *patch, const sb_scene *scene, const sb_model *model, sb_vec3 at, sb_error *error)
{
    const patch_wall *nearest = nearest_wall(patch, at);
    double s = patch->spacing, limit = patch->offset + 0.5 * s;
    if (!nearest || sb_norm(nearest->normal) < 0.5) return SB_OK;
    const double height = sb_dot(sb_sub(at, nearest->position), nearest->normal);
    patch->normal = nearest->normal;
    patch->center = sb_madd(at, -height, nearest->normal);
    if (height < -0.5 * s || height > limit) return SB_OK;
    for (size_t i = 0; i < patch->count; i++) patch->walls[i].part = part_of(patch, &patch->walls[i]);
    patch->wetness_point = out_of_walls(patch, at, 0.5 * s);
    add_bodies(patch);
    patch->behind = patch->before = scene->numerics.support * s;
    for (size_t b = 0; b < patch->body_count; b++)
        if (model->bodies[patch->body[b]].thin > 0)
            patch->behind = fmin(patch->behind, 0.5 * model->bodies[patch->body[b]].thin);
    sb_status status = sb_patch_region_make(&patch->region, patch->center, patch->normal, patch->radius, patch->flat,
                                            on_face, patch, error);
    patch->on_wall = status == SB_OK && patch->region.off < (0.5 + 1e-6) * s;
    return status;
}

static double radius_of(const sb_scene *scene, const sb_probe *probe)
{
    return probe->radius > 0 ? probe->radius : PATCH_RADIUS * scene->resolution;
}

double sb_patch_range(const sb_scene *scene, const sb_probe *probe)
{
    const double support = scene->numerics.support * scene->resolution, radius = radius_of(scene, probe);
    return fmax(1.5 * fmax(radius, support) + support, SB_PATCH_REGION * radius * sqrt(2)) + scene->resolution;
}

sb_status sb_patch_create(const sb_scene *scene, const sb_model *model, const sb_probe *probe, sb_patch **patch,
                          sb_error *error)
{
    sb_patch *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, probe->name);
    made->radius = radius_of(scene, probe);
    for (int axis = 0; axis < 2; axis++) made->period[axis] = sb_repeat_length(scene, model->min, model->max, axis);
    made->spacing = scene->resolution;
    made->flat = scene->dimensions == 2;
    made->offset = scene->numerics.wall_offset * scene->resolution;
    made->wetness_point = probe->at;
    made->first_layer = (scene->numerics.wall_offset + FIRST_LAYER) * scene->resolution;
    sb_status status = collect(made, model, probe->at, sb_patch_range(scene, probe), error);
    if (status == SB_OK) status = choose_face(made, scene, model, probe->at, error);
    if (status != SB_OK) {
        sb_patch_destroy(made);
        return status;
    }
    *patch = made;
    return SB_OK;
}

size_t sb_patch_places(const sb_patch *patch, sb_push_place places[SB_PATCH_PLACES])
{
    /* Forces beyond an edge count at the edge. */
    const double range = patch->radius + patch->offset + 2 * patch->before;
    for (size_t b = 0; b < patch->body_count && patch->on_wall; b++)
        places[b] = (sb_push_place){patch->body[b], patch->center, range};
    return patch->on_wall ? patch->body_count : 0;
}

static bool of_patch(const sb_patch *patch, size_t body)
{
    bool found = false;
    for (size_t b = 0; b < patch->body_count; b++) found |= patch->body[b] == body;
    return found;
}

/* Nearest image of a periodic domain. */
static sb_vec3 from_center(const sb_patch *patch, sb_vec3 at)
{
    sb_vec3 way = sb_sub(at, patch->center);
    if (patch->period[0] > 0) way.x -= patch->period[0] * round(way.x / patch->period[0]);
    if (patch->period[1] > 0) way.y -= patch->period[1] * round(way.y / patch->period[1]);
    return way;
}

/* Whether a force is that of another wall of the same body, which crosses the face: along the normal of another facet,
   or by a boundary particle in front of the face's. Those behind it belong to the face's edges. */
static bool of_other_wall(const sb_patch *patch, const sb_wall_push *push)
{
    const bool by_facet = sb_norm(push->normal) > 0, by_particle = sb_norm(sb_sub(push->from, push->at)) > 0;
    if (by_facet) return fabs(sb_dot(push->normal, patch->normal)) < 0.9;
    return by_particle && sb_dot(from_center(patch, push->from), patch->normal) > 0.3 * patch->spacing;
}

double sb_patch_share(const sb_patch *patch, const sb_wall_push *push)
{
    if (!of_patch(patch, push->body) || of_other_wall(patch, push)) return 0;
    const sb_vec3 way = from_center(patch, push->at);
    const double height = sb_dot(way, patch->normal);
    if (height < patch->offset - patch->behind || height > patch->offset + patch->before) return 0;
    const double weight =
        sb_patch_region_weight(&patch->region, sb_add(patch->center, sb_madd(way, -height, patch->normal)));
    return -weight * sb_dot(push->force, patch->normal);
}

/* Pressure on a wall, as force divided by area.

   The force between a wall and a fluid particle contains the particle's own solver pressure only. The solver pressure
   of the first layer at a wall is therefore far from the hydrostatic one (measured in a tank at rest, kernel cubic,
   support 2, gamma 0.7: 1.9 times the hydrostatic pressure in the first layer, 0.85 in the second, 1.02 in the third),
   while the force on the wall is correct to a fraction of a per cent. A probe on a wall therefore reads the force on a
   small patch of the wall. The virial pressure of the first layer (src/sim/terms/virial_pressure.c) is closer, but
   still some per cent too high: a probe near a wall ignores that layer. */
#include "measure/patch.h"

#include "base/memory.h"
#include "physics/wall_volume.h"

/* How a boundary particle near the probe is related to the patch. */
enum wall_part {
    SURFACE,  /* of the boundary surface under the probe */
    ROUNDING, /* of a rounded edge of that surface, where the rounding lies within a crossing wall */
    REAR, /* of the rear side of a plate, which carries a part of the force on the front side if the plate is thin */
    CROSSING, /* of a wall that crosses the surface */
    UNRELATED
};

/* weight > 0: belongs to the patch. psi in kg. */
typedef struct patch_wall {
    sb_vec3 position, normal;
    double psi, weight;
    enum wall_part part;
} patch_wall;

struct sb_patch {
    bool on_wall;
    double spacing, first_layer; /* m */
    double offset;               /* m, from a boundary surface to the physical surface */
    double area;                 /* integral of the weight over the patch, m^2 (m in 2D) */
    sb_vec3 normal, center;      /* of the disk, which lies in the boundary surface */
    sb_vec3 wetness_point;
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
    sb_free(patch->walls);
    sb_free(patch);
}

size_t sb_patch_bytes(const sb_patch *patch)
{
    return sizeof *patch + patch->capacity * sizeof *patch->walls;
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

static sb_status add_wall(sb_patch *patch, sb_vec3 position, sb_vec3 normal, sb_error *error)
{
    if (sb_grow((void **)&patch->walls, &patch->capacity, patch->count + 1, sizeof *patch->walls) != 0)
        return sb_fail_memory(error, "wall around a probe");
    patch->walls[patch->count++] = (patch_wall){.position = position, .normal = normal};
    return SB_OK;
}

/* Adds a boundary particle and its periodic images, as far as they are within the range. */
static sb_status add_near(sb_patch *patch, sb_vec3 position, sb_vec3 normal, sb_vec3 at, double range,
                          const double length[2], sb_error *error)
{
    int most[2];
    for (int axis = 0; axis < 2; axis++) most[axis] = length[axis] > 0 ? 1 + (int)ceil(range / length[axis]) : 0;
    for (int j = -most[1]; j <= most[1]; j++)
        for (int i = -most[0]; i <= most[0]; i++) {
            sb_vec3 image = sb_add(position, sb_vec(i * length[0], j * length[1], 0));
            sb_vec3 d = sb_sub(image, at);
            if (sb_dot(d, d) >= range * range) continue;
            sb_status status = add_wall(patch, image, normal, error);
            if (status != SB_OK) return status;
        }
    return SB_OK;
}

static sb_status collect(sb_patch *patch, const sb_scene *scene, const sb_model *model, sb_vec3 at, double range,
                         sb_error *error)
{
    const double length[2] = {sb_repeat_length(scene, model->min, model->max, 0),
                              sb_repeat_length(scene, model->min, model->max, 1)};
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) /* it moves away from the probe */
            continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            sb_vec3 normal = model->wall_normal ? model->wall_normal[i] : sb_vec(0, 0, 0);
            sb_status status = add_near(patch, model->wall_position[i], normal, at, range, length, error);
            if (status != SB_OK) return status;
        }
    }
    return SB_OK;
}

/* Number of boundary particles near one that lie in the same plane. */
static size_t count_coplanar(const sb_patch *patch, const patch_wall *wall)
{
    const double s = patch->spacing;
    size_t count = 0;
    for (size_t k = 0; k < patch->count; k++) {
        const sb_vec3 d = sb_sub(patch->walls[k].position, wall->position);
        count += sb_norm(d) < 2.5 * s && fabs(sb_dot(d, wall->normal)) < 0.3 * s &&
                 sb_dot(patch->walls[k].normal, wall->normal) > 0.98;
    }
    return count;
}

/* The nearest boundary particle; if that one belongs to a rounded edge, one of the plane face beside the edge. */
static const patch_wall *nearest_wall(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL, *plane = NULL;
    for (size_t i = 0; i < patch->count; i++)
        if (!best || sb_norm(sb_sub(patch->walls[i].position, at)) < sb_norm(sb_sub(best->position, at)))
            best = &patch->walls[i];
    if (!best) return NULL;
    const double range = sb_norm(sb_sub(best->position, at)) + 0.5 * patch->spacing;
    size_t most = 2 * count_coplanar(patch, best);
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        const sb_vec3 d = sb_sub(at, wall->position);
        if (sb_norm(d) > range || fabs(sb_dot(d, wall->normal) - patch->offset) > 0.25 * patch->spacing) continue;
        if (count_coplanar(patch, wall) <= most) continue;
        most = count_coplanar(patch, wall);
        plane = wall;
    }
    return plane ? plane : best;
}

static double bell(double q)
{
    return q < 1 ? (1 - q * q) * (1 - q * q) : 0;
}

/* ---- which boundary particles carry the force on the patch ---- */

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
    if (cosine > 0.05 && height < 0.8 * s) return ROUNDING;
    return height < 0.3 * s && cosine < -0.5 ? REAR : UNRELATED;
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

static bool is_within(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *crossing = nearest_crossing(patch, at);
    return crossing && depth_within(patch, crossing, at) > 0;
}

/* Integral of the weight over the part of the disk that has boundary particles and lies in front of crossing walls. */
static double covered_area(const sb_patch *patch, double radius, bool flat)
{
    enum { HALF = 16 };
    sb_vec3 n = patch->normal;
    sb_vec3 u = fabs(n.y) < 0.9 ? sb_normalize(sb_cross(sb_vec(0, 1, 0), n)) : sb_vec(1, 0, 0);
    sb_vec3 v = sb_cross(n, u);
    double cell = radius / HALF, sum = 0, limit = 0.75 * patch->spacing;
    int rows = flat ? 0 : HALF;
    for (int j = -rows; j <= rows; j++)
        for (int i = -HALF; i <= HALF; i++) {
            double weight = bell(hypot(i, j) / HALF);
            sb_vec3 at = sb_madd(sb_madd(patch->center, i * cell, u), j * cell, v);
            bool covered = false;
            for (size_t k = 0; k < patch->count && weight > 0 && !covered; k++)
                covered = patch->walls[k].part == SURFACE && patch->walls[k].weight > 0 &&
                          sb_norm(sb_sub(patch->walls[k].position, at)) < limit;
            if (!covered) continue;
            const patch_wall *crossing = nearest_crossing(patch, onto_face(patch, at));
            /* A cell that the crossing wall cuts counts half. */
            const double depth = crossing ? depth_within(patch, crossing, onto_face(patch, at)) : -cell;
            sum += depth > 0.25 * cell ? 0 : depth > -0.25 * cell ? 0.5 * weight : weight;
        }
    return sum * (flat ? cell : cell * cell);
}

/* Weight of a boundary particle. One that lies within a crossing wall gets the weight of the nearest point in front of
   that wall, because it carries the force there. */
static double weight_of(const sb_patch *patch, const patch_wall *wall, double radius)
{
    sb_vec3 place = wall->position;
    if (wall->part != SURFACE) place = sb_madd(place, -height_over_surface(patch, place), patch->normal);
    place = sb_madd(out_of_walls(patch, onto_face(patch, place), 0), -patch->offset, patch->normal);
    return bell(sb_norm(sb_sub(place, patch->center)) / radius);
}

/* Chooses the boundary particles of the patch and their weights. The disk lies in the boundary surface. */
static void choose_walls(sb_patch *patch, const sb_scene *scene, sb_vec3 at, double radius)
{
    const patch_wall *nearest = nearest_wall(patch, at);
    double s = patch->spacing, limit = patch->offset + 0.5 * s;
    if (!nearest || sb_norm(nearest->normal) < 0.5) return;
    const double height = sb_dot(sb_sub(at, nearest->position), nearest->normal);
    patch->normal = nearest->normal;
    patch->center = sb_madd(at, -height, nearest->normal);
    if (height < -0.5 * s || height > limit || sb_norm(sb_sub(patch->center, nearest->position)) > 1.1 * s) return;
    for (size_t i = 0; i < patch->count; i++) patch->walls[i].part = part_of(patch, &patch->walls[i]);
    for (size_t i = 0; i < patch->count; i++) {
        patch_wall *wall = &patch->walls[i];
        if (wall->part == ROUNDING && !is_within(patch, onto_face(patch, wall->position))) wall->part = UNRELATED;
        if (wall->part != CROSSING && wall->part != UNRELATED) wall->weight = weight_of(patch, wall, radius);
    }
    patch->wetness_point = out_of_walls(patch, at, 0.5 * s);
    patch->area = covered_area(patch, radius, scene->dimensions == 2);
    patch->on_wall = patch->area > 0;
}

/* Computes the wall volumes as the simulation does. They are correct for particles whose neighbours were all collected,
   which holds for all particles of the patch. */
static void set_volumes(sb_patch *patch, const sb_scene *scene)
{
    const sb_numerics *n = &scene->numerics;
    const bool of_lattice = n->wall_gamma == 0;
    const double gamma = of_lattice
                             ? sb_wall_gamma(n->kernel, scene->dimensions, n->support, n->wall_offset, n->wall_spacing)
                             : n->wall_gamma;
    double h = n->support * scene->resolution;
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *at = &patch->walls[i];
        double sum = 0, curvature = 0;
        for (size_t k = 0; k < patch->count; k++) {
            const sb_vec3 d = sb_sub(patch->walls[k].position, at->position);
            const double w = sb_kernel_value(n->kernel, scene->dimensions, h, sb_norm(d));
            sum += w;
            if (sb_wall_curvature_includes(sb_dot(at->normal, patch->walls[k].normal)))
                curvature += w * sb_dot(d, at->normal) / h;
        }
        const double factor = of_lattice ? sb_wall_curvature_factor(curvature / sum) : 1;
        patch->walls[i].psi = gamma * scene->fluid.density / sum * factor;
    }
}

sb_status sb_patch_create(const sb_scene *scene, const sb_model *model, const sb_probe *probe, sb_patch **patch,
                          sb_error *error)
{
    sb_patch *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, probe->name);
    double support = scene->numerics.support * scene->resolution;
    double radius = probe->radius > 0 ? probe->radius : PATCH_RADIUS * scene->resolution;
    made->spacing = scene->resolution;
    made->offset = scene->numerics.wall_offset * scene->resolution;
    made->wetness_point = probe->at;
    made->first_layer = (scene->numerics.wall_offset + FIRST_LAYER) * scene->resolution;
    sb_status status =
        collect(made, scene, model, probe->at, 1.5 * fmax(radius, support) + support + scene->resolution, error);
    if (status != SB_OK) {
        sb_patch_destroy(made);
        return status;
    }
    choose_walls(made, scene, probe->at, radius);
    if (made->on_wall) set_volumes(made, scene);
    *patch = made;
    return SB_OK;
}

/* Weighted force of one fluid particle on the patch along the patch's normal, per mass: N/kg. */
static double force_of(const sb_patch *patch, const sb_scene *scene, const sb_fluid_sample *sample)
{
    const sb_numerics *n = &scene->numerics;
    double h = n->support * scene->resolution, sum = 0;
    const bool in_front = height_over_surface(patch, sample->position) > 0;
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        sb_vec3 d = sb_sub(sample->position, wall->position);
        double height = sb_dot(d, patch->normal), r = sb_norm(d);
        if (wall->weight > 0 && height > 0 && r < h && (wall->part != REAR || in_front))
            sum -= wall->weight * wall->psi * height / r * sb_kernel_slope(n->kernel, scene->dimensions, h, r);
    }
    return sum * sample->push;
}

sb_status sb_patch_pressure(const sb_patch *patch, const sb_measure_view *view, double *pressure, sb_error *error)
{
    const sb_scene *scene = view->scene;
    double h = scene->numerics.support * scene->resolution;
    sb_vec3 min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), max = sb_scale(min, -1);
    for (size_t i = 0; i < patch->count; i++)
        if (patch->walls[i].weight > 0) {
            min = sb_min(min, patch->walls[i].position);
            max = sb_max(max, patch->walls[i].position);
        }
    /* Pressures and densities belong to the positions at the step's start. */
    sb_status status = sb_cloud_query(view->cloud, view->sim, sb_sub(min, sb_vec(h, h, h)),
                                      sb_add(max, sb_vec(h, h, h)), sb_sim_report(view->sim)->time_step, error);
    double sum = 0;
    for (size_t i = 0; status == SB_OK && i < view->cloud->count; i++)
        sum += force_of(patch, scene, &view->cloud->samples[i]);
    double mass = scene->fluid.density * pow(scene->resolution, scene->dimensions);
    *pressure = mass * sum / patch->area;
    return status;
}

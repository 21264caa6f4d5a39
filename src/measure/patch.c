/* Pressure on a wall as force over area.

   A fluid particle at a wall is pushed by the wall with its own pressure only, so that the layer
   next to it has to have far more of the solve's pressure than the water has there (measured in a tank at rest, kernel
   cubic, support 2, gamma 0.7: 1.9 times the hydrostatic one in the first layer, 0.85 in the
   second, 1.02 in the third), while the force on the wall is right to a fraction of a percent.
   Hence a probe on a wall reads that force over a small patch. The pressure that such a layer bears
   (sim/bearing.c) is nearer, but some per cent too high still: a probe near a wall leaves it out. */
#include "measure/patch.h"

#include "base/memory.h"
#include "physics/wall_volume.h"

/* weight > 0: belongs to the patch. psi in kg. */
typedef struct patch_wall {
    sb_vec3 position, normal;
    double psi, weight;
} patch_wall;

struct sb_patch {
    bool on_wall;
    double spacing, first_layer; /* m */
    double area;                 /* integral of the weight over the patch's surface, m^2 (m in 2D) */
    sb_vec3 normal;
    size_t count, capacity;
    patch_wall *walls;
};

/* Spacings behind wall_offset. A fluid particle nearer to a boundary particle than that is in the layer at the wall,
   which rests half a spacing before the face; the next one rests 1.5 before it. */
#define FIRST_LAYER 1.0

#define PATCH_RADIUS 2.0 /* spacings, when the probe has none */

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

/* Those of a boundary particle and of its images beyond periodic sides that are near enough. */
static sb_status add_near(sb_patch *patch, sb_vec3 position, sb_vec3 normal, sb_vec3 at, double reach,
                          const double length[2], sb_error *error)
{
    int most[2];
    for (int axis = 0; axis < 2; axis++) most[axis] = length[axis] > 0 ? 1 + (int)ceil(reach / length[axis]) : 0;
    for (int j = -most[1]; j <= most[1]; j++)
        for (int i = -most[0]; i <= most[0]; i++) {
            sb_vec3 image = sb_add(position, sb_vec(i * length[0], j * length[1], 0));
            sb_vec3 d = sb_sub(image, at);
            if (sb_dot(d, d) >= reach * reach) continue;
            sb_status status = add_wall(patch, image, normal, error);
            if (status != SB_OK) return status;
        }
    return SB_OK;
}

static sb_status collect(sb_patch *patch, const sb_scene *scene, const sb_model *model, sb_vec3 at, double reach,
                         sb_error *error)
{
    const double length[2] = {sb_repeat_length(scene, model->min, model->max, 0),
                              sb_repeat_length(scene, model->min, model->max, 1)};
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) /* goes away from the probe */
            continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            sb_vec3 normal = model->wall_normal ? model->wall_normal[i] : sb_vec(0, 0, 0);
            sb_status status = add_near(patch, model->wall_position[i], normal, at, reach, length, error);
            if (status != SB_OK) return status;
        }
    }
    return SB_OK;
}

static const patch_wall *nearest_wall(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL;
    for (size_t i = 0; i < patch->count; i++)
        if (!best || sb_norm(sb_sub(patch->walls[i].position, at)) < sb_norm(sb_sub(best->position, at)))
            best = &patch->walls[i];
    return best;
}

static double bell(double q)
{
    return q < 1 ? (1 - q * q) * (1 - q * q) : 0;
}

/* Integral of the weight over that part of the disk about `center` which has boundary particles. */
static double covered_area(const sb_patch *patch, sb_vec3 center, double radius, bool flat)
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
            sb_vec3 at = sb_madd(sb_madd(center, i * cell, u), j * cell, v);
            bool covered = false;
            for (size_t k = 0; k < patch->count && weight > 0 && !covered; k++)
                covered = patch->walls[k].weight > 0 && sb_norm(sb_sub(patch->walls[k].position, at)) < limit;
            sum += covered ? weight : 0;
        }
    return sum * (flat ? cell : cell * cell);
}

/* Chooses the particles of the patch and their weights. The disk lies in the particles' sheet. */
static void choose(sb_patch *patch, const sb_scene *scene, sb_vec3 at, double radius)
{
    const patch_wall *nearest = nearest_wall(patch, at);
    double s = patch->spacing, limit = (scene->numerics.wall_offset + 0.5) * s;
    if (!nearest || sb_norm(nearest->normal) < 0.5) return;
    sb_vec3 n = nearest->normal, center;
    double height = sb_dot(sb_sub(at, nearest->position), n);
    center = sb_madd(at, -height, n);
    if (height < -0.5 * s || height > limit || sb_norm(sb_sub(center, nearest->position)) > 0.8 * s) return;
    patch->normal = n;
    for (size_t i = 0; i < patch->count; i++) {
        patch_wall *wall = &patch->walls[i];
        sb_vec3 d = sb_sub(wall->position, center);
        /* The radius may exceed that of the disk a little: coverage looks 0.75 spacings far. */
        if (sb_dot(wall->normal, n) > 0.9 && fabs(sb_dot(d, n)) < 0.3 * s) wall->weight = bell(sb_norm(d) / radius);
    }
    patch->area = covered_area(patch, center, radius, scene->dimensions == 2);
    patch->on_wall = patch->area > 0;
}

/* As the simulation. Right for those whose neighbours were all collected, which holds for the patch. */
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
        double sum = 0, bulge = 0;
        for (size_t k = 0; k < patch->count; k++) {
            const sb_vec3 d = sb_sub(patch->walls[k].position, at->position);
            const double w = sb_kernel_value(n->kernel, scene->dimensions, h, sb_norm(d));
            sum += w;
            if (sb_wall_bends_with(sb_dot(at->normal, patch->walls[k].normal))) bulge += w * sb_dot(d, at->normal) / h;
        }
        const double bend = of_lattice ? sb_wall_bend(bulge / sum) : 1;
        patch->walls[i].psi = gamma * scene->fluid.density / sum * bend;
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
    made->first_layer = (scene->numerics.wall_offset + FIRST_LAYER) * scene->resolution;
    sb_status status =
        collect(made, scene, model, probe->at, 1.5 * fmax(radius, support) + support + scene->resolution, error);
    if (status != SB_OK) {
        sb_patch_destroy(made);
        return status;
    }
    choose(made, scene, probe->at, radius);
    if (made->on_wall) set_volumes(made, scene);
    *patch = made;
    return SB_OK;
}

/* Push of one fluid particle on the patch along its normal, weighted, per mass: N/kg. */
static double push_of(const sb_patch *patch, const sb_scene *scene, const sb_fluid_sample *sample)
{
    const sb_numerics *n = &scene->numerics;
    double h = n->support * scene->resolution, sum = 0;
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        sb_vec3 d = sb_sub(sample->position, wall->position);
        double height = sb_dot(d, patch->normal), r = sb_norm(d);
        if (wall->weight > 0 && height > 0 && r < h)
            sum -= wall->weight * wall->psi * height / r * sb_kernel_slope(n->kernel, scene->dimensions, h, r);
    }
    return sum * sample->push;
}

sb_status sb_patch_pressure(const sb_patch *patch, const sb_sight *sight, double *pressure, sb_error *error)
{
    const sb_scene *scene = sight->scene;
    double h = scene->numerics.support * scene->resolution;
    sb_vec3 min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), max = sb_scale(min, -1);
    for (size_t i = 0; i < patch->count; i++)
        if (patch->walls[i].weight > 0) {
            min = sb_min(min, patch->walls[i].position);
            max = sb_max(max, patch->walls[i].position);
        }
    /* Pressures and densities belong to the places at the step's start. */
    sb_status status = sb_cloud_query(sight->cloud, sight->sim, sb_sub(min, sb_vec(h, h, h)),
                                      sb_add(max, sb_vec(h, h, h)), sb_sim_report(sight->sim)->time_step, error);
    double sum = 0;
    for (size_t i = 0; status == SB_OK && i < sight->cloud->count; i++)
        sum += push_of(patch, scene, &sight->cloud->samples[i]);
    double mass = scene->fluid.density * pow(scene->resolution, scene->dimensions);
    *pressure = mass * sum / patch->area;
    return status;
}

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

/* What a boundary particle around is to the patch. */
enum wall_part {
    SHEET,  /* of the sheet under the probe */
    ROUND,  /* of the round by which that turns into a wall across, within which it lies */
    BEHIND, /* of the far side of a plate, which bears its share of what pushes on the near one if the plate is thin */
    ACROSS, /* of a wall that the sheet runs into */
    APART
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
    double offset;               /* m, from a sheet of boundary particles to the face that they stand for */
    double area;                 /* integral of the weight over the patch's surface, m^2 (m in 2D) */
    sb_vec3 normal, center;      /* of the disk, in the sheet */
    sb_vec3 outlook;
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

sb_vec3 sb_patch_outlook(const sb_patch *patch)
{
    return patch->outlook;
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

/* How many others around lie in the plane of one. */
static size_t mates_of(const sb_patch *patch, const patch_wall *wall)
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

/* The nearest boundary particle; where that is one of the round of an edge, one of the face beside it. */
static const patch_wall *nearest_wall(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL, *plane = NULL;
    for (size_t i = 0; i < patch->count; i++)
        if (!best || sb_norm(sb_sub(patch->walls[i].position, at)) < sb_norm(sb_sub(best->position, at)))
            best = &patch->walls[i];
    if (!best) return NULL;
    const double reach = sb_norm(sb_sub(best->position, at)) + 0.5 * patch->spacing;
    size_t most = 2 * mates_of(patch, best);
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        const sb_vec3 d = sb_sub(at, wall->position);
        if (sb_norm(d) > reach || fabs(sb_dot(d, wall->normal) - patch->offset) > 0.25 * patch->spacing) continue;
        if (mates_of(patch, wall) <= most) continue;
        most = mates_of(patch, wall);
        plane = wall;
    }
    return plane ? plane : best;
}

static double bell(double q)
{
    return q < 1 ? (1 - q * q) * (1 - q * q) : 0;
}

/* ---- which boundary particles bear what pushes on the patch ---- */

static double height_over_sheet(const sb_patch *patch, sb_vec3 at)
{
    return sb_dot(sb_sub(at, patch->center), patch->normal);
}

/* Whether the surface that a boundary particle belongs to comes out of the sheet: others in its plane lie before it. Of
   stairs the riser behind a tread does, the one before it does not. */
static bool comes_out(const sb_patch *patch, const patch_wall *wall)
{
    for (size_t k = 0; k < patch->count; k++) {
        const patch_wall *other = &patch->walls[k];
        if (sb_dot(other->normal, wall->normal) > 0.9 &&
            height_over_sheet(patch, other->position) > 0.25 * patch->spacing &&
            fabs(sb_dot(sb_sub(other->position, wall->position), wall->normal)) < 0.5 * patch->spacing)
            return true;
    }
    return false;
}

/* How far a place on the face lies within a wall across, m; 0 or less: before it, where water can be. */
static double depth_within(const sb_patch *patch, const patch_wall *across, sb_vec3 at)
{
    return patch->offset - sb_dot(sb_sub(at, across->position), across->normal);
}

static sb_vec3 onto_face(const sb_patch *patch, sb_vec3 sheet)
{
    return sb_madd(sheet, patch->offset, patch->normal);
}

/* A wall across is one before which the probe stands, and not the one opposite in a narrow channel. */
static enum wall_part part_of(const sb_patch *patch, const patch_wall *wall)
{
    const double height = height_over_sheet(patch, wall->position), s = patch->spacing;
    const double likeness = sb_dot(wall->normal, patch->normal);
    if (likeness > 0.9) return fabs(height) < 0.3 * s ? SHEET : APART;
    if (sb_norm(wall->normal) < 0.5) return APART;
    if (comes_out(patch, wall)) {
        const bool before = depth_within(patch, wall, onto_face(patch, patch->center)) < 0.25 * s;
        return before && likeness > -0.9 ? ACROSS : APART;
    }
    if (likeness > 0.05 && height < 0.8 * s) return ROUND;
    return height < 0.3 * s && likeness < -0.5 ? BEHIND : APART;
}

/* The boundary particle of a wall across that is nearest to a place on the face, and reaches it; NULL: none does. */
static const patch_wall *nearest_across(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *best = NULL;
    double reach = 2.5 * patch->spacing;
    for (size_t k = 0; k < patch->count; k++) {
        const double distance = sb_norm(sb_sub(patch->walls[k].position, at));
        if (patch->walls[k].part != ACROSS || distance >= reach) continue;
        best = &patch->walls[k];
        reach = distance;
    }
    return best;
}

/* A place on the face, or if it lies nearer than `off` to a wall across or within it, the nearest on the face that does
   not. Two walls make a corner. */
static sb_vec3 out_of_walls(const sb_patch *patch, sb_vec3 at, double off)
{
    for (int turn = 0; turn < 3; turn++) {
        const patch_wall *across = nearest_across(patch, at);
        const double depth = across ? depth_within(patch, across, at) + off : 0;
        if (!(depth > 1e-6 * patch->spacing)) return at;
        const sb_vec3 n = across->normal, along = sb_madd(n, -sb_dot(n, patch->normal), patch->normal);
        at = sb_madd(at, depth / sb_dot(along, along), along);
    }
    return at;
}

static bool is_within(const sb_patch *patch, sb_vec3 at)
{
    const patch_wall *across = nearest_across(patch, at);
    return across && depth_within(patch, across, at) > 0;
}

/* Integral of the weight over that part of the disk which has boundary particles and lies before walls across. */
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
                covered = patch->walls[k].part == SHEET && patch->walls[k].weight > 0 &&
                          sb_norm(sb_sub(patch->walls[k].position, at)) < limit;
            if (!covered) continue;
            const patch_wall *across = nearest_across(patch, onto_face(patch, at));
            /* A cell that the wall cuts counts by half. */
            const double depth = across ? depth_within(patch, across, onto_face(patch, at)) : -cell;
            sum += depth > 0.25 * cell ? 0 : depth > -0.25 * cell ? 0.5 * weight : weight;
        }
    return sum * (flat ? cell : cell * cell);
}

/* Those within a wall across bear what pushes before it. */
static double weight_of(const sb_patch *patch, const patch_wall *wall, double radius)
{
    sb_vec3 place = wall->position;
    if (wall->part != SHEET) place = sb_madd(place, -height_over_sheet(patch, place), patch->normal);
    place = sb_madd(out_of_walls(patch, onto_face(patch, place), 0), -patch->offset, patch->normal);
    /* The radius may exceed that of the disk a little: coverage looks 0.75 spacings far. */
    return bell(sb_norm(sb_sub(place, patch->center)) / radius);
}

/* Chooses the particles of the patch and their weights. The disk lies in the particles' sheet. */
static void choose(sb_patch *patch, const sb_scene *scene, sb_vec3 at, double radius)
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
        if (wall->part == ROUND && !is_within(patch, onto_face(patch, wall->position))) wall->part = APART;
        if (wall->part != ACROSS && wall->part != APART) wall->weight = weight_of(patch, wall, radius);
    }
    patch->outlook = out_of_walls(patch, at, 0.5 * s);
    patch->area = covered_area(patch, radius, scene->dimensions == 2);
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
    made->offset = scene->numerics.wall_offset * scene->resolution;
    made->outlook = probe->at;
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
    const bool before = height_over_sheet(patch, sample->position) > 0;
    for (size_t i = 0; i < patch->count; i++) {
        const patch_wall *wall = &patch->walls[i];
        sb_vec3 d = sb_sub(sample->position, wall->position);
        double height = sb_dot(d, patch->normal), r = sb_norm(d);
        if (wall->weight > 0 && height > 0 && r < h && (wall->part != BEHIND || before))
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

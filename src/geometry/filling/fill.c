/* Fills the sea and the boxes of water one after another, and removes particles where they overlap. */
#include "geometry/filling/fill.h"

#include "base/memory.h"
#include "base/random.h"
#include "base/stop.h"
#include "geometry/filling/parts.h"
#include "geometry/sampling/set.h"

#include <string.h>

/* In particle spacings: a particle nearer than this to a particle of an earlier sea or box is a duplicate. */
static const double duplicate_distance = 0.7;

void sb_fluid_free(sb_fluid *fluid)
{
    if (!fluid) return;
    sb_free(fluid->boxes);
    sb_free(fluid->position);
    sb_free(fluid->velocity);
    sb_free(fluid->pressure);
    sb_fill_source_destroy(fluid->source);
    *fluid = (sb_fluid){0};
}

/* Adds the particles of `fluid` within the box [min, max] to a set for distance queries. */
static int gather(const sb_fluid *fluid, sb_vec3 min, sb_vec3 max, sb_sample_set *set)
{
    for (size_t i = 0; i < fluid->count; ++i) {
        sb_vec3 p = fluid->position[i];
        if (p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z &&
            sb_sample_set_add(set, &(sb_sample){.at = p}))
            return -1;
    }
    return 0;
}

/* Removes from `more` the particles that lie in an earlier sea or box or too near to a particle of it. */
static int drop_duplicates(const sb_columns *waters, size_t water_count, const sb_fluid *fluid, double spacing,
                           sb_fluid *more)
{
    sb_vec3 min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), max = sb_scale(min, -1);
    for (size_t i = 0; i < more->count; ++i) {
        min = sb_min(min, more->position[i]);
        max = sb_max(max, more->position[i]);
    }
    sb_vec3 margin = {spacing, spacing, spacing};
    sb_sample_set set = {.cell = spacing, .origin = min};
    int failed = more->count > 0 && gather(fluid, sb_sub(min, margin), sb_add(max, margin), &set);
    size_t kept = 0;
    for (size_t i = 0; i < more->count && !failed; ++i) {
        failed = sb_stop_signal();
        bool duplicate = sb_sample_set_any(&set, more->position[i], duplicate_distance * spacing);
        for (size_t w = 0; w < water_count && !duplicate; ++w)
            duplicate = sb_columns_hold(waters + w, more->position[i]);
        if (duplicate) continue;
        more->position[kept] = more->position[i];
        more->velocity[kept] = more->velocity[i];
        more->pressure[kept++] = more->pressure[i];
    }
    more->count = more->here = kept;
    sb_sample_set_free(&set);
    return failed;
}

static void *join(const void *a, size_t a_count, const void *b, size_t b_count, size_t size)
{
    char *both = sb_alloc_untouched(a_count + b_count, size);
    if (both) {
        memcpy(both, a, a_count * size);
        memcpy(both + a_count * size, b, b_count * size);
    }
    return both;
}

/* Appends `more` to `fluid` and empties `more`. */
static int append(sb_fluid *fluid, sb_fluid *more)
{
    const size_t count = fluid->count + more->count;
    sb_fluid both = {.count = count, .here = count, .still_depth = fmax(fluid->still_depth, more->still_depth)};
    if (fluid->count == 0) {
        sb_fluid_free(fluid);
        *fluid = *more;
        fluid->still_depth = both.still_depth;
        *more = (sb_fluid){0};
        return 0;
    }
    both.position = join(fluid->position, fluid->count, more->position, more->count, sizeof *both.position);
    both.velocity = join(fluid->velocity, fluid->count, more->velocity, more->count, sizeof *both.velocity);
    both.pressure = join(fluid->pressure, fluid->count, more->pressure, more->count, sizeof *both.pressure);
    if (!both.position || !both.velocity || !both.pressure) {
        sb_fluid_free(&both);
        return -1;
    }
    sb_fluid_free(fluid);
    sb_fluid_free(more);
    *fluid = both;
    return 0;
}

void sb_fluid_displace(const sb_scene *scene, sb_fluid *fluid)
{
    double size = scene->numerics.jitter * scene->resolution;
    uint64_t seed = scene->numerics.seed;
    if (!(size > 0)) return;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < fluid->here; ++k) {
        const size_t i = fluid->from + k;
        sb_vec3 *p = fluid->position + k;
        p->x += size * (2 * sb_random(seed, 3 * i) - 1);
        if (scene->dimensions == 3) p->y += size * (2 * sb_random(seed, 3 * i + 1) - 1);
        p->z += size * (2 * sb_random(seed, 3 * i + 2) - 1);
    }
}

sb_status sb_columns_fill(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fluid_box *box,
                          sb_columns *columns, sb_wave_room *wave, sb_error *error)
{
    sb_columns made;
    sb_status status = sb_columns_build(scene, solids, count, box, &made, error);
    if (status != SB_OK) return status;
    for (size_t r = 0; box && r < made.run_count; ++r) made.runs[r].wet = true;
    if (!box) status = sb_columns_flood(&made, error);
    if (status != SB_OK) {
        sb_columns_free(&made);
        return status;
    }
    sb_columns_wave(&made, wave);
    *columns = made;
    return SB_OK;
}

/* Adds the sea (box NULL) or one box. Its columns are appended to `waters`, those of the earlier sea and boxes. */
static sb_status add_water(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fluid_box *box,
                           sb_columns *waters, size_t *water_count, sb_fluid *fluid, sb_box_share *share,
                           sb_wave_room *wave, sb_error *error)
{
    sb_columns *c = waters + *water_count;
    sb_fluid more = {0};
    sb_status status = sb_columns_fill(scene, solids, count, box, c, wave, error);
    if (status != SB_OK) return status;
    ++*water_count;
    status = sb_columns_particles(c, &more, error);
    if (share) share->room = more.count;
    if (status == SB_OK && fluid->count > 0 &&
        drop_duplicates(waters, *water_count - 1, fluid, scene->resolution, &more))
        status = sb_fail_memory(error, "water");
    if (share) share->received = more.count;
    if (status == SB_OK && append(fluid, &more)) status = sb_fail_memory(error, "water");
    sb_fluid_free(&more);
    return status;
}

/* Fills the sea and all boxes, and joins their particles. */
static sb_status fill_all(const sb_scene *scene, const sb_fill_solid *solids, size_t count, sb_fluid *fluid,
                          sb_error *error)
{
    sb_fluid made = {0};
    sb_wave_room wave = {.wet = false};
    size_t water_count = 0;
    sb_columns *waters = sb_alloc(scene->box_count + 1, sizeof *waters);
    sb_box_share *boxes = sb_alloc(scene->box_count, sizeof *boxes);
    sb_status status = waters && boxes ? SB_OK : sb_fail_memory(error, "water");
    if (status == SB_OK && scene->sea.present)
        status = add_water(scene, solids, count, NULL, waters, &water_count, &made, NULL, &wave, error);
    for (size_t i = 0; i < scene->box_count && status == SB_OK; ++i)
        status =
            add_water(scene, solids, count, scene->boxes + i, waters, &water_count, &made, boxes + i, &wave, error);
    for (size_t i = 0; i < water_count; ++i) sb_columns_free(waters + i);
    sb_free(waters);
    if (status != SB_OK) {
        sb_free(boxes);
        sb_fluid_free(&made);
        return status;
    }
    made.boxes = boxes;
    made.wave = wave;
    sb_fluid_displace(scene, &made);
    *fluid = made;
    return SB_OK;
}

bool sb_fill_divides(const sb_scene *scene)
{
    return scene->box_count + scene->sea.present == 1;
}

sb_status sb_fill_water(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fill_share *share,
                        sb_fluid *fluid, sb_error *error)
{
    return share->parts > 1 && sb_fill_divides(scene) ? sb_fill_part(scene, solids, count, share, fluid, error)
                                                      : fill_all(scene, solids, count, fluid, error);
}

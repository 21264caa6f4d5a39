#include "sim/walls/basin.h"

#include "base/random.h"
#include "check.h"

#include <math.h>
#include <string.h>

enum { KEYS_MAX = 16 };

static void build(basin *b, const sb_override *set, size_t count)
{
    *b = (basin){0};
    sb_error error = {0};
    if (sb_scene_read(SB_SOURCE_DIR "/tests/sim/tank.yaml", NULL, set, count, &b->scene, &error) != SB_OK ||
        sb_model_build(&b->scene, &b->model, &error) != SB_OK)
        fail_msg("%s", error.text);
}

void basin_start(basin *b)
{
    sb_error error = {0};
    if (sb_sim_create(&b->scene, &b->model, NULL, &b->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

void basin_fill_from(basin *b, const sb_override *set, size_t count)
{
    build(b, set, count);
    basin_start(b);
}

void basin_build(basin *b, const sb_override *set, size_t count)
{
    sb_override all[KEYS_MAX] = {{"numerics.walls", "images"}};
    assert_true(count < KEYS_MAX);
    memcpy(all + 1, set, count * sizeof *set);
    build(b, all, count + 1);
}

void basin_scatter(basin *b, uint64_t seed, sb_vec3 min, sb_vec3 max, double speed)
{
    sb_model *m = &b->model;
    const bool flat = m->dimensions == 2;
    const sb_vec3 size = sb_sub(max, min);
    for (size_t i = 0; i < m->fluid_count; i++) {
        double u[6];
        for (uint64_t k = 0; k < 6; k++) u[k] = sb_random(seed, 6 * i + k);
        m->fluid_position[i] = sb_add(min, sb_vec(u[0] * size.x, flat ? 0 : u[1] * size.y, u[2] * size.z));
        m->fluid_velocity[i] = sb_scale(sb_vec(2 * u[3] - 1, flat ? 0 : 2 * u[4] - 1, 2 * u[5] - 1), speed);
        m->fluid_pressure[i] = 0;
    }
}

void basin_fill(basin *b, int dimensions, const char *spacing, const char *max, const char *water, const char *bodies,
                const char *density)
{
    const sb_override set[] = {
        {"dimensions", dimensions == 2 ? "2" : "3"},
        {"resolution", spacing},
        {"domain.min", dimensions == 2 ? "[0, 0]" : "[0, 0, 0]"},
        {"domain.max", max},
        {"water", water},
        {"bodies", bodies},
        {"numerics.walls", "images"},
        {"numerics.density", density},
    };
    basin_fill_from(b, set, sizeof set / sizeof *set);
}

void basin_settle(basin *b)
{
    sb_error error = {0};
    if (sb_sim_settle(b->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

void basin_free(basin *b)
{
    sb_sim_destroy(b->sim);
    sb_model_free(&b->model);
    sb_scene_free(&b->scene);
}

sb_f4 basin_way(const sb_sim *sim, sb_vec3 p, uint32_t id, double size)
{
    const bool flat = sim->constant.dimension == 2;
    sb_f4 v = {(float)nearbyint(size * sin(3 * p.x + p.z)), flat ? 0 : (float)nearbyint(size * sin(5 * p.y + p.x)),
               (float)nearbyint(size * cos(2 * p.x - p.y)), 0};
    for (int axis = 0; axis < 3; axis++)
        if (!flat || axis != 1) v[axis] += (float)nearbyint(size * (sb_random((uint64_t)axis + 5, id) - 0.5));
    return v;
}

#include "sim/walls/basin.h"

#include "check.h"

void basin_fill_from(basin *b, const sb_override *set, size_t count)
{
    *b = (basin){0};
    sb_error error = {0};
    if (sb_scene_read(SB_SOURCE_DIR "/tests/sim/tank.yaml", NULL, set, count, &b->scene, &error) != SB_OK ||
        sb_model_build(&b->scene, &b->model, &error) != SB_OK ||
        sb_sim_create(&b->scene, &b->model, &b->sim, &error) != SB_OK)
        fail_msg("%s", error.text);
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

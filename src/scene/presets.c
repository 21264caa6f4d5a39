#include "scene/presets.h"

#include <string.h>

/* One row per key of `numerics`; the columns are in the order of sb_preset. After a change here,
   run test_scene_docs with SB_UPDATE_DOCS=1 to update docs/scene.md. */
/* clang-format off */
static const struct {
    const char *key, *value[2];
} rows[] = {
    /* key                     default       paper   */
    {"kernel",               {"wendland-c2", "cubic"}},
    {"support",              {"2.75",       "2"}},
    {"density",              {"completed",  "summed"}},
    {"solver",               {"chebyshev",         "jacobi"}},
    {"tolerance_rule",       {"pressure",   "density"}},
    {"tolerance",            {"0.002",      "0.001"}},
    {"min_iterations",       {"2",          "3"}},
    {"max_iterations",       {"500",        "500"}},
    {"relaxation",           {"0.5",        "0.5"}},
    {"warm_start",           {"1",          "0.6"}},
    {"source_relaxation",    {"0.2",        "1"}},
    {"cfl",                  {"0.4",        "0.4"}},
    {"time_step_rule",       {"depth",      "paper"}},
    {"time_step_factor",     {"0.22",       "0.075"}},
    {"time_step_max",        {"0",          "0"}},
    {"stress_correction",    {"1",          "0"}},
    {"stress_memory",        {"20",         "0"}},
    {"artificial_viscosity", {"0.005",       "0.05"}},
    {"wall_friction",        {"0",          "0.02"}},
    {"walls",                {"images",     "particles"}},
    {"wall_shear",           {"smooth",     "none"}},
    {"turbulence",           {"none",       "none"}},
    {"smagorinsky",          {"0.1",        "0.1"}},
    {"sound_speed",          {"0",          "0"}},
    {"wall_gamma",           {"0",          "1"}},
    {"wall_spacing",         {"0.8",        "1"}},
    {"wall_offset",          {"0.75",      "0.6"}},
    {"jitter",               {"0.05",       "0"}},
    {"seed",                 {"1",          "1"}},
    {"settle_steps",         {"500",        "0"}},
};
/* clang-format on */

const char *sb_preset_value(sb_preset preset, const char *key)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].key, key) == 0) return rows[i].value[preset];
    return NULL;
}

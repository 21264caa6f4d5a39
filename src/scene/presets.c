#include "scene/presets.h"

#include <string.h>

/* One row per key of `numerics`; the columns are in the order of sb_preset, then the value of the default preset in
   scenes of two dimensions if it is another one. After a change here, run test_scene_docs with SB_UPDATE_DOCS=1 to
   update docs/scene.md. */
enum { IN_2D = 3 };
/* clang-format off */
static const struct {
    const char *key, *value[4];
} rows[] = {
    /* key                     default        paper        wen            default in 2D */
    {"kernel",               {"wendland-c2", "cubic",     "wendland-c2"}},
    {"support",              {"2.75",        "2",         "3",           "3.25"}},
    {"kernel_correction",    {"none",        "none",      "cspm"}},
    {"density",              {"completed",   "summed",    "summed"}},
    {"solver",               {"chebyshev",   "jacobi",    "wcsph"}},
    {"tolerance_rule",       {"pressure",    "density",   "pressure"}},
    {"tolerance",            {"0.002",       "0.001",     "0.002"}},
    {"min_iterations",       {"2",           "3",         "2"}},
    {"max_iterations",       {"500",         "500",       "500"}},
    {"relaxation",           {"0.5",         "0.5",       "0.5"}},
    {"warm_start",           {"1",           "0.6",       "1"}},
    {"source_relaxation",    {"0.2",         "1",         "0.2"}},
    {"cfl",                  {"0.4",         "0.4",       "0.3"}},
    {"time_step_rule",       {"depth",       "paper",     "depth"}},
    {"time_step_factor",     {"0.22",        "0.075",     "0.22"}},
    {"time_step_max",        {"0",           "0",         "0"}},
    {"stress_correction",    {"1",           "0",         "0"}},
    {"density_diffusion",    {"0",           "0",         "0.1"}},
    {"stress_memory",        {"60",          "0",         "0"}},
    {"artificial_viscosity", {"0",           "0.05",      "0.01"}},
    {"hyperviscosity",       {"0.1",         "0",         "0"}},
    {"wall_friction",        {"0",           "0.02",      "0"}},
    {"walls",                {"images",      "particles", "dynamic"}},
    {"wall_beta",            {"0.7",         "0.7",       "0.7"}},
    {"wall_shear",           {"smooth",      "none",      "none"}},
    {"turbulence",           {"none",        "none",      "sps"}},
    {"smagorinsky",          {"0.1",         "0.1",       "0.1"}},
    {"sound_speed",          {"0",           "0",         "0"}},
    {"wall_spacing",         {"0.8",         "1",         "1"}},
    {"wall_offset",          {"0.75",        "0.6",       "0.75"}},
    {"jitter",               {"0.05",        "0",         "0"}},
    {"seed",                 {"1",           "1",         "1"}},
    {"settle_steps",         {"500",         "0",         "0"}},
};
/* clang-format on */

const char *const sb_preset_names[] = {"default", "paper", "wen", NULL};

const char *sb_preset_value(sb_preset preset, int dimensions, const char *key)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (strcmp(rows[i].key, key) != 0) continue;
        const bool differs = preset == SB_PRESET_DEFAULT && dimensions == 2 && rows[i].value[IN_2D];
        return rows[i].value[differs ? IN_2D : preset];
    }
    return NULL;
}

#include "app/check/numerics.h"

#include "scene/key.h"

#include <stdio.h>
#include <string.h>

enum { VALUE = 40 };

/* Writes the value as a scene has it: a word or a number. */
static void value_of(const sb_numerics *n, const sb_key *key, char text[VALUE])
{
    const char *field = (const char *)n + key->offset;
    if (key->type == SB_KEY_CHOICE)
        snprintf(text, VALUE, "%s", key->words[*(const int *)field]);
    else
        snprintf(text, VALUE, "%g", key->type == SB_KEY_INTEGER ? *(const int *)field : *(const double *)field);
}

void sb_numerics_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const sb_numerics *n = &scene->numerics;
    const bool explicit = n->solver == SB_SOLVER_WCSPH;
    const bool sound = explicit || n->artificial_viscosity > 0 || n->wall_friction > 0;
    const struct {
        const char *key;
        bool unused;
        const char *needed;
    } rows[] = {
        {"tolerance_rule", explicit, "a solver other than wcsph"},
        {"time_step_rule", explicit, "a solver other than wcsph"},
        {"time_step_factor", explicit, "a solver other than wcsph"},
        {"stress_memory", !(n->stress_correction > 0), "stress_correction above 0"},
        {"tolerance", explicit, "a solver other than wcsph"},
        {"min_iterations", explicit, "a solver other than wcsph"},
        {"max_iterations", explicit, "a solver other than wcsph"},
        {"warm_start", explicit, "a solver other than wcsph"},
        {"source_relaxation", explicit, "a solver other than wcsph"},
        {"relaxation", n->solver != SB_SOLVER_JACOBI, "solver: jacobi"},
        {"wall_beta", n->walls != SB_WALLS_DYNAMIC, "walls: dynamic"},
        {"smagorinsky", n->turbulence != SB_TURBULENCE_SPS, "turbulence: sps"},
        {"sound_speed", !sound, "artificial_viscosity or wall_friction above 0"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const sb_key *key = sb_table_find(&sb_numerics_table, rows[r].key);
        char text[200], value[VALUE];
        value_of(n, key, value);
        if (!rows[r].unused || strcmp(value, sb_key_default(key, n->preset, scene->dimensions)) == 0) continue;
        snprintf(text, sizeof text, "numerics.%s: %s has no effect; expected %s, or no such key", key->name, value,
                 rows[r].needed);
        visit(context, text);
    }
}

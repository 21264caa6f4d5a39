#include "choice.h"

#include "sensitivity.h"

#include <string.h>

/* clang-format off */
const sb_choice sb_choices[] = {
    {.name = "default", .quick = true},
    {.name = "paper", .paper = true, .quick = true},
    {.name = "paper, chebyshev", .paper = true, .fixed = {"numerics.solver=chebyshev"}},
    {.name = "paper, its tolerance x 4", .paper = true, .fixed = {"numerics.tolerance=0.004"}},
    {.name = "jacobi", .fixed = {"numerics.solver=jacobi"}},
    {.name = "jacobi, relaxation 0.3", .quick = true,
     .fixed = {"numerics.solver=jacobi", "numerics.relaxation=0.3"}},
    {.name = "cg", .quick = true, .fixed = {"numerics.solver=cg"}},
    {.name = "tolerance / 4", .key = "tolerance", .factor = 0.25},
    {.name = "tolerance x 2", .key = "tolerance", .factor = 2},
    {.name = "tolerance x 4", .quick = true, .key = "tolerance", .factor = 4},
    {.name = "tolerance x 16", .key = "tolerance", .factor = 16},
    {.name = "time step / 2", .quick = true, .key = "time_step_factor", .factor = 0.5},
    {.name = "time step x 1.5", .key = "time_step_factor", .factor = 1.5},
    {.name = "time step x 2", .quick = true, .key = "time_step_factor", .factor = 2},
    {.name = "CFL x 1.5", .key = "cfl", .factor = 1.5},
    {.name = "support 2", .quick = true, .fixed = {"numerics.support=2"}},
    {.name = "support 3", .quick = true, .fixed = {"numerics.support=3"}},
    {.name = "cubic, support 2.5", .fixed = {"numerics.kernel=cubic", "numerics.support=2.5"}},
    {.name = "warm start 0", .quick = true, .fixed = {"numerics.warm_start=0"}},
    {.name = "warm start 0.9", .fixed = {"numerics.warm_start=0.9"}},
    {.name = "source relaxation / 2", .key = "source_relaxation", .factor = 0.5},
    {.name = "source relaxation x 2", .quick = true, .key = "source_relaxation", .factor = 2},
    {.name = "at least 1 sweep", .fixed = {"numerics.min_iterations=1"}},
    {.name = "no stress correction", .quick = true, .fixed = {"numerics.stress_correction=0"}},
    {.name = "no hyperviscosity", .fixed = {"numerics.hyperviscosity=0"}},
    {.name = "hyperviscosity x 4", .key = "hyperviscosity", .factor = 4},
    {.name = "artificial viscosity instead", .fixed = {"numerics.hyperviscosity=0", "numerics.artificial_viscosity=0.005"}},
    {.name = "sea nested from x = 250", .quick = true, .subject = "plant", .scene = "../scenes/plant-coast.yaml",
     .fixed = {"domain.min=[250, 0, -38]"}},
    {.name = "sea nested from x = 400", .quick = true, .subject = "plant", .scene = "../scenes/plant-coast.yaml",
     .fixed = {"domain.min=[400, 0, -38]", "measure.map.min=[400, 0]"}},
    {.name = "sea nested from x = 250, two-way", .subject = "plant", .scene = "../scenes/plant-coast.yaml",
     .fixed = {"domain.min=[250, 0, -38]", "offshore.coupling=two-way"}},
    {.name = "sea replayed from x = 400", .quick = true, .subject = "plant", .scene = "../scenes/plant-coast.yaml",
     .records = "measure.planes=[{name: line, from: [400, 0], to: [400, 1150], record: true}]",
     .fixed = {"domain.min=[400, 0, -38]", "measure.map.min=[400, 0]", "offshore=null", "measure.gauges.offshore=null",
               "measure.gauges.slope=null", "sea={source: record, plane: line}"}},
    {.name = "no settling", .fixed = {"numerics.settle_steps=0"}},
    /* What the preset `wen` changes: a choice has the preset `default` or `paper`. */
    {.name = "wcsph", .quick = true, .slow = true,
     .fixed = {"numerics.solver=wcsph", "numerics.hyperviscosity=0", "numerics.support=3", "numerics.kernel_correction=cspm",
               "numerics.density=summed", "numerics.cfl=0.3", "numerics.stress_correction=0",
               "numerics.stress_memory=0", "numerics.density_diffusion=0.1", "numerics.artificial_viscosity=0.01",
               "numerics.walls=dynamic", "numerics.wall_shear=none", "numerics.turbulence=sps",
               "numerics.wall_spacing=1", "numerics.jitter=0", "numerics.settle_steps=0"}},
    {.name = NULL},
};
/* clang-format on */

size_t sb_choice_count(void)
{
    return sizeof sb_choices / sizeof *sb_choices - 1;
}

bool sb_choice_is_for(const sb_choice *choice, const char *subject)
{
    return !choice->subject || strcmp(choice->subject, subject) == 0;
}

void sb_choice_change(const sb_choice *choice, const sb_numerics *defaults, char change[SB_CHOICE_TEXT])
{
    change[0] = '\0';
    for (const sb_sensitivity_key *key = sb_sensitivity_keys; choice->key && key->key; key++)
        if (strcmp(key->key, choice->key) == 0) sb_sensitivity_change(key, defaults, choice->factor, change);
}

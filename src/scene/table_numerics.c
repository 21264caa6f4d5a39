#include "scene/presets.h"
#include "scene/reader.h"

#include <limits.h>
#include <math.h>

static const char *const solver_names[] = {"jacobi", "chebyshev", "cg", "wcsph", NULL};
static const char *const tolerance_names[] = {"density", "pressure", NULL};
static const char *const density_names[] = {"summed", "completed", NULL};
static const char *const wall_names[] = {"particles", "images", "dynamic", NULL};
static const char *const correction_names[] = {"none", "cspm", NULL};
static const char *const shear_names[] = {"none", "smooth", NULL};
static const char *const turbulence_names[] = {"none", "sps", NULL};
static const char *const step_names[] = {"paper", "depth", NULL};

#define NUMBER(key, unit_, min_, max_, flags_, doc_)                                                                   \
    {                                                                                                                  \
        .name = #key, .type = SB_KEY_NUMBER, SB_KEY_AT(sb_numerics, key), .unit = unit_, .min = min_, .max = max_,     \
        .flags = SB_KEY_PRESET | (flags_), .doc = doc_                                                                 \
    }
#define COUNT(key, unit_, min_, max_, doc_)                                                                            \
    {                                                                                                                  \
        .name = #key, .type = SB_KEY_INTEGER, SB_KEY_AT(sb_numerics, key), .unit = unit_, .min = min_, .max = max_,    \
        .flags = SB_KEY_PRESET, .doc = doc_                                                                            \
    }
#define CHOICE(key, words_, doc_)                                                                                      \
    {                                                                                                                  \
        .name = #key, .type = SB_KEY_CHOICE, SB_KEY_AT(sb_numerics, key), .words = words_, .flags = SB_KEY_PRESET,     \
        .doc = doc_                                                                                                    \
    }

/* clang-format off */
static const sb_key keys[] = {
    {.name = "preset", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_numerics, preset),
     .words = sb_preset_names, .fallback = "default",
     .doc = "Set of defaults for the keys that this block does not give. `default` is the best "
            "known set over several cases; `paper` follows Sampath et al.; `wen` follows Wen et al., with "
            "`solver: wcsph`."},
    {.name = "kernel", .type = SB_KEY_KERNEL, SB_KEY_AT(sb_numerics, kernel),
     .flags = SB_KEY_PRESET, .doc = "Kernel; `shorebreak list kernels` describes the kernels."},
    NUMBER(support, "spacings", 1.5, 4, 0,
           "Support radius: distance within which particles interact."),
    CHOICE(kernel_correction, correction_names,
           "Gradients of `solver: wcsph`. `cspm`: corrected by the second moments of the neighbours, exact for "
           "linear fields; momentum is no longer conserved. Not with `walls: images`."),
    CHOICE(density, density_names,
           "`summed`: density from the kernel sum alone. `completed`: with the density "
           "correction, which compensates the kernel's missing part at the surface; with `walls: images`."),
    CHOICE(solver, solver_names,
           "Method of the pressure solve. `wcsph`: no solve, but explicit steps of weakly compressible water, for "
           "comparison; `preset: wen` has values that fit. Not with sides of kind `sea`, surface tension, foam, settling, "
           "`density: completed`, `stress_correction` and `hyperviscosity`."),
    CHOICE(tolerance_rule, tolerance_names,
           "`density`: the tolerance is a mean relative excess density. `pressure`: it is a fraction of "
           "the still water's pressure, and the residual that ends a solve follows from the time step."),
    NUMBER(tolerance, NULL, 0, 1, SB_KEY_ABOVE | SB_KEY_BELOW,
           "Error at which a solve stops, see `tolerance_rule`."),
    COUNT(min_iterations, NULL, 0, 100000, "Smallest number of iterations of a solve."),
    COUNT(max_iterations, NULL, 1, 100000, "Largest number of iterations of a solve."),
    NUMBER(relaxation, NULL, 0, 1, SB_KEY_ABOVE,
           "Relaxation factor omega of the Jacobi solver. It is reduced where a wide support "
           "would make the solver diverge."),
    NUMBER(warm_start, NULL, 0, 1, 0, "Fraction of the last pressure from which a solve starts."),
    NUMBER(source_relaxation, NULL, 0, 1, SB_KEY_ABOVE,
           "Fraction of the density error that one step corrects."),
    NUMBER(cfl, NULL, 0, 1, SB_KEY_ABOVE,
           "Fraction of the support radius that a particle may travel in one step. With `solver: wcsph`: fraction of "
           "half the support radius that sound in the fastest water may travel."),
    CHOICE(time_step_rule, step_names,
           "Rule for the longest time step: `paper`: time_step_factor h/g; `depth`: "
           "time_step_factor h/sqrt(g D)."),
    NUMBER(time_step_factor, NULL, 0, 10, SB_KEY_ABOVE,
           "Factor in `time_step_rule`; for `paper` its unit is 1/s. For `depth`, values above "
           "0.3 give a warning and values above 0.6 are refused."),
    NUMBER(time_step_max, "s", 0, HUGE_VAL, 0, "Additional upper bound of the time step; 0: none."),
    NUMBER(stress_correction, NULL, 0, 1, 0,
           "Fraction of the deviatoric particle-packing stress that is removed, with `walls: images`; 0 leaves the "
           "term out."),
    NUMBER(stress_memory, NULL, 0, 1e9, 0,
           "Time in sqrt(D/g) after which the stress of the particle packing counts as steady: the "
           "correction leaves it. 0: never."),
    NUMBER(density_diffusion, NULL, 0, 1, 0,
           "Coefficient delta of the diffusion of density, with `solver: wcsph`; 0 leaves the term out. 0.1 is usual."),
    NUMBER(artificial_viscosity, NULL, 0, 10, 0,
           "Coefficient alpha of Monaghan's artificial viscosity; 0 leaves the term out."),
    NUMBER(hyperviscosity, NULL, 0, 1, 0,
           "Coefficient kappa of the hyperviscosity, which damps motion of the scale of the spacing; 0 leaves the term "
           "out."),
    NUMBER(wall_friction, NULL, 0, 10, 0,
           "Coefficient sigma of the artificial wall friction; 0 leaves the term out."),
    CHOICE(walls, wall_names,
           "What the pressure meets at walls; their surfaces have no detail finer than 0.1 spacings. `particles`: boundary "
           "particles [A12]. `images`: images of the water, reflected at the walls' facets. `dynamic`, for "
           "`solver: wcsph`: two staggered layers of boundary particles with a density of their own."),
    NUMBER(wall_beta, NULL, 0, 1, 0,
           "With `walls: dynamic`: share of the pressure of the water nearby in that of a boundary particle; the rest "
           "follows from its own density."),
    CHOICE(wall_shear, shear_names,
           "`smooth`: walls exert shear by the law of the smooth wall, with the fluid's "
           "viscosity. `none`: free slip."),
    CHOICE(turbulence, turbulence_names,
           "`sps`: sub-particle-scale turbulence, an eddy viscosity from the strain rate. `none` "
           "leaves it out."),
    NUMBER(smagorinsky, NULL, 0, 0.25, SB_KEY_ABOVE,
           "Smagorinsky constant C_s of the eddy viscosity: its mixing length away from walls, in "
           "particle spacings."),
    NUMBER(sound_speed, "m/s", 0, HUGE_VAL, 0,
           "Speed of sound in the terms of artificial_viscosity and wall_friction; 0: 10 sqrt(g D). With `solver: "
           "wcsph` that of the water; 0: 10 times sqrt(g D) or the water's greatest speed at the start, whichever is "
           "more. Less gives a warning there, and less than a fifth is refused."),
    NUMBER(wall_spacing, "spacings", 0.4, 1.2, 0,
           "Distance between boundary particles. A large distance slows water that slides along a "
           "wall."),
    NUMBER(wall_offset, "spacings", 0, 2, 0,
           "Distance of the boundary particles behind the physical wall; a run requires 0.25 or "
           "more."),
    NUMBER(jitter, "spacings", 0, 0.5, 0,
           "Amplitude of the random displacement of the particles at the start."),
    {.name = "seed", .type = SB_KEY_SEED, SB_KEY_AT(sb_numerics, seed), .max = 0x1p64,
     .flags = SB_KEY_PRESET, .doc = "Start seed: seed of the random displacement."},
    COUNT(settle_steps, "steps", 0, 1000000,
           "Largest number of settling steps before t = 0; 0: no settling."),
};
/* clang-format on */

static const sb_removed_key removed[] = {
    {"sleep", "this key was removed: still water is always computed; delete the key"},
    {"wall_gamma", "this key was removed: boundary particles have their published volume; delete the key"},
    {NULL, NULL},
};

/* What explicit steps and walls of boundary particles cannot do, and what only explicit steps can. Without numbers a
   value is a word. */
static sb_status check_forms(sb_reader *reader, const sb_yaml *map, const sb_numerics *n)
{
    const bool explicit = n->solver == SB_SOLVER_WCSPH, dynamic = n->walls == SB_WALLS_DYNAMIC;
    const bool particles = !explicit && n->walls == SB_WALLS_PARTICLES;
    const bool drag = n->wall_shear != SB_SHEAR_NONE || n->wall_friction > 0;
    const struct {
        bool wrong;
        const char *key, *text;
    } rules[] = {
        {explicit && n->density == SB_DENSITY_COMPLETED, "density",
         "completed with solver wcsph, whose density follows from the continuity equation: expected summed"},
        {explicit && n->stress_correction > 0, "stress_correction", "more than 0 with solver wcsph: expected 0"},
        {explicit && n->hyperviscosity > 0, "hyperviscosity", "more than 0 with solver wcsph: expected 0"},
        {explicit && n->settle_steps > 0, "settle_steps",
         "more than 0 with solver wcsph, which starts from the lattice: expected 0"},
        {explicit && dynamic && drag, n->wall_friction > 0 ? "wall_friction" : "wall_shear",
         "drag of walls needs walls: particles or images with solver wcsph: expected wall_shear none and "
         "wall_friction 0"},
        {explicit && n->kernel_correction == SB_CORRECTION_CSPM && n->walls == SB_WALLS_IMAGES, "kernel_correction",
         "cspm with walls: images, expected none, or walls: dynamic or particles"},
        {particles && n->density == SB_DENSITY_COMPLETED, "density", "completed needs walls: images, expected summed"},
        {particles && n->stress_correction > 0, "stress_correction", "more than 0 needs walls: images, expected 0"},
        {!explicit && dynamic, "walls", "dynamic needs solver: wcsph, expected particles or images"},
        {!explicit && n->kernel_correction != SB_CORRECTION_NONE, "kernel_correction",
         "cspm needs solver: wcsph, expected none"},
        {!explicit && n->density_diffusion > 0, "density_diffusion", "more than 0 needs solver: wcsph, expected 0"},
    };
    const char *const remedy = explicit    ? "; preset: wen has values that fit"
                               : particles ? "; preset: paper has values that fit"
                                           : "";
    for (size_t r = 0; r < sizeof rules / sizeof *rules; r++)
        if (rules[r].wrong) return sb_reader_fail(reader, map, rules[r].key, "%s%s", rules[r].text, remedy);
    return SB_OK;
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_numerics *numerics = item;
    if (numerics->min_iterations <= numerics->max_iterations) return check_forms(reader, map, numerics);
    return sb_reader_fail(reader, map, "min_iterations", "%d is more than max_iterations, expected at most %d",
                          numerics->min_iterations, numerics->max_iterations);
}

const sb_table sb_numerics_table = {SB_KEY_ROWS(keys), .removed = removed, .size = sizeof(sb_numerics),
                                    .finish = finish};

#include "scene/reader.h"

#include <limits.h>
#include <math.h>

static const char *const preset_words[] = {"default", "paper", NULL};
static const char *const solver_words[] = {"jacobi", "chebyshev", "cg", NULL};
static const char *const tolerance_words[] = {"density", "pressure", NULL};
static const char *const density_words[] = {"summed", "completed", NULL};
static const char *const shear_words[] = {"none", "smooth", NULL};
static const char *const turbulence_words[] = {"none", "sps", NULL};
static const char *const step_words[] = {"paper", "depth", NULL};

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
     .words = preset_words, .fallback = "default",
     .doc = "Fills in all that this block does not give: `paper` follows Sampath et al., "
            "`default` is the best known over several cases."},
    {.name = "kernel", .type = SB_KEY_KERNEL, SB_KEY_AT(sb_numerics, kernel),
     .flags = SB_KEY_PRESET, .doc = "Smoothing kernel; `shorebreak list kernels` describes them."},
    NUMBER(support, "spacings", 1.5, 4, 0, "Radius within which particles see each other."),
    CHOICE(density, density_words,
           "`summed`: the kernel sum alone; `completed`: each particle carries what its sum lacked at the surface, or had "
           "too much of at a wall, on the lattice it started from, until it comes away from there."),
    CHOICE(solver, solver_words, "Method of the pressure solve."),
    CHOICE(tolerance_rule, tolerance_words,
           "`density`: tolerance is a relative density error; `pressure`: it is the share of the "
           "still water's pressure, and the density error follows from the time step."),
    NUMBER(tolerance, NULL, 0, 1, SB_KEY_ABOVE | SB_KEY_BELOW,
           "At which mean excess density the solve stops."),
    COUNT(min_iterations, NULL, 0, 100000, "Fewest iterations of a solve."),
    COUNT(max_iterations, NULL, 1, 100000, "Most iterations of a solve."),
    NUMBER(relaxation, NULL, 0, 1, SB_KEY_ABOVE, "Factor omega of the Jacobi solver, lowered where a wide support would make it diverge."),
    NUMBER(warm_start, NULL, 0, 1, 0, "Share of the last pressure that a solve starts from."),
    NUMBER(source_relaxation, NULL, 0, 1, SB_KEY_ABOVE,
           "Share of the density error that one step mends."),
    NUMBER(cfl, NULL, 0, 1, SB_KEY_ABOVE,
           "Part of the support that a particle may cross per step."),
    CHOICE(time_step_rule, step_words,
           "Longest step: `paper` time_step_factor h/g, `depth` time_step_factor h/sqrt(g D), "
           "with h the support radius and D the still depth."),
    NUMBER(time_step_factor, NULL, 0, 10, SB_KEY_ABOVE,
           "Factor of that rule (under `paper` in 1/s); under `depth` a run warns of more than 0.3 and refuses more than 0.6."),
    NUMBER(time_step_max, "s", 0, HUGE_VAL, 0, "A further bound on the step; 0: none."),
    NUMBER(stress_correction, NULL, 0, 1, 0,
           "Share of the stress by which a sheared packing of particles pushes unlike water that is taken away; 0 leaves "
           "the term out."),
    NUMBER(artificial_viscosity, NULL, 0, 10, 0,
           "alpha of Monaghan's viscosity; 0 leaves the term out."),
    NUMBER(wall_friction, NULL, 0, 10, 0, "sigma of the wall friction; 0 leaves the term out."),
    CHOICE(wall_shear, shear_words,
           "`smooth`: walls hold the water that slides along them by the law of the smooth wall, with "
           "the fluid's viscosity; `none` lets it slip."),
    CHOICE(turbulence, turbulence_words,
           "`sps`: an eddy viscosity from the strain rate, for eddies below the spacing; `none` "
           "leaves it out."),
    NUMBER(smagorinsky, NULL, 0, 0.25, SB_KEY_ABOVE,
           "C_s of that eddy viscosity: its mixing length in spacings, away from walls."),
    NUMBER(sound_speed, "m/s", 0, HUGE_VAL, 0,
           "Speed in artificial_viscosity and wall_friction; 0: 10 sqrt(g D)."),
    NUMBER(wall_gamma, NULL, 0, 5, 0,
           "Factor on the volume of boundary particles, at least 0.1: with less, walls leak; 0: computed, so that "
           "a lattice of water stays at rest on planes and at edges."),
    NUMBER(wall_spacing, "spacings", 0.4, 1.2, 0,
           "Distance of boundary particles from each other; wide ones are grains that hold what slides along a wall."),
    NUMBER(wall_offset, "spacings", 0, 2, 0,
           "How far boundary particles lie behind the physical wall; a run asks for 0.25 or more."),
    NUMBER(jitter, "spacings", 0, 0.5, 0, "Amplitude of the random displacement at the start."),
    {.name = "seed", .type = SB_KEY_SEED, SB_KEY_AT(sb_numerics, seed), .max = 0x1p64,
     .flags = SB_KEY_PRESET, .doc = "Seed of that displacement."},
    {.name = "sleep", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_numerics, sleep), .flags = SB_KEY_PRESET,
     .doc = "Whether a sea at rest is left out of the computation until a wave comes near."},
    COUNT(settle_steps, "steps", 0, 1000000, "Most steps before t = 0 in which the water comes to rest; 0: none."),
};
/* clang-format on */

static const double GAMMA_MIN = 0.1; /* below, walls leak */

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_numerics *numerics = item;
    if (numerics->wall_gamma > 0 && numerics->wall_gamma < GAMMA_MIN)
        return sb_reader_fail(reader, map, "wall_gamma", "%g is out of range, expected 0 or a number from %g to 5",
                              numerics->wall_gamma, GAMMA_MIN);
    if (numerics->min_iterations <= numerics->max_iterations) return SB_OK;
    return sb_reader_fail(reader, map, "min_iterations", "%d is more than max_iterations, expected at most %d",
                          numerics->min_iterations, numerics->max_iterations);
}

const sb_table sb_numerics_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_numerics), .finish = finish};

/* The optional parts that a scene needs. What it does not need costs neither time nor memory. */
#ifndef SB_SIM_NEEDS_H
#define SB_SIM_NEEDS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct sb_needs {
    bool density_correction, stress_correction, turbulence;
    bool packing_strain;        /* the density correction follows strains, with the stress correction */
    bool steady_stress;         /* the stress correction leaves out its steady part */
    bool wall_shear, wall_drag; /* drag: shear or friction */
    bool images;                /* walls reflect water */
    bool wall_lists;            /* boundary particles act by their pairs with water, for which there are lists */
    bool wall_body;             /* there are none, and walls have drag */
    bool sea;                   /* water of a given sea comes in through a side */
    bool viscosity;             /* pairs have a viscosity: artificial, eddy, or the fluid's where it is not faint */
    bool hyperviscosity;
    bool surface_tension;
    bool sponge;         /* zones slow water down */
    bool viscous_sponge; /* zones have a viscosity */
    bool eddy;           /* particles have a viscosity of their own: turbulence or viscous_sponge */
    bool foam;           /* water emits spray, foam and bubbles */
    bool settling;
    bool start_velocity;     /* water in motion at t = 0, after settling */
    bool implicit;           /* steps have a pressure solve */
    bool wcsph;              /* steps are explicit, in two halves (sim/wcsph/wcsph.h) */
    bool dynamic_walls;      /* boundary particles have a density of their own */
    bool direction, product; /* fields of the pressure solver */
    bool ahead;              /* a sweep begins while the stopping test of the one before is on its way */
} sb_needs;

/* A row that exists if one of these flags is set has the flag's offset, or SB_ALWAYS. */
enum { SB_ALWAYS = 1000 };
#define SB_NEEDS(flag) offsetof(sb_needs, flag)

static inline bool sb_needed(const sb_needs *needs, size_t flag)
{
    return flag == SB_ALWAYS || *(const bool *)((const char *)needs + flag);
}

#endif

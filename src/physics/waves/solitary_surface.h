/* The surface of a solitary wave in conformal variables; for solitary_exact.c. */
#ifndef SB_PHYSICS_SOLITARY_SURFACE_H
#define SB_PHYSICS_SOLITARY_SURFACE_H

#include <complex.h>
#include <stddef.h>

/* Modes of the surface, and places on one half of it. */
enum { SB_SURFACE_MODES = 512 };

/* Lengths are in depths and speeds in sqrt(g h). The flow that is at rest with the wave is uniform, with the speed -c,
   in the strip 0 < Im Z < 1 that z(Z) maps on the water:

       z(Z) = stretch Z + sum b_k sin(k Z),   k = pi m / length,   m = 1 to `modes`. */
typedef struct sb_solitary_surface {
    double celerity, length, stretch, volume;
    size_t modes; /* without those that are 0 to rounding */
    double b[SB_SURFACE_MODES];
} sb_solitary_surface;

/* Computes the surface. Returns 0, -1 without memory, 1 if it does not converge. */
int sb_solitary_surface_find(double height, sb_solitary_surface *surface);

/* z and its first three derivatives at Z. */
void sb_solitary_surface_map(const sb_solitary_surface *surface, double complex at, double complex z[4]);

#endif

/* Solitary waves of permanent form on constant depth, by the full equations of an inviscid fluid without surface
   tension: computed, not a series in the height. */
#ifndef SB_PHYSICS_SOLITARY_EXACT_H
#define SB_PHYSICS_SOLITARY_EXACT_H

#include "base/status.h"
#include "physics/waves/dispersion.h"

/* Greatest and least height over depth: beyond, the crest is too sharp, or the wave too long, for what is computed. */
#define SB_SOLITARY_EXACT_HIGHEST 0.7
#define SB_SOLITARY_EXACT_LOWEST 1e-3

typedef struct sb_solitary_exact sb_solitary_exact; /* constant after its creation */

/* Computes the wave of that height and depth, m, in a tenth of a second. SB_BAD_INPUT for a height that is not within
   the limits above. The caller destroys it. */
sb_status sb_solitary_exact_create(double height, double depth, double gravity, sb_solitary_exact **wave,
                                   sb_error *error);
void sb_solitary_exact_destroy(sb_solitary_exact *wave); /* NULL has no effect */

double sb_solitary_exact_celerity(const sb_solitary_exact *wave);             /* m/s */
double sb_solitary_exact_volume(const sb_solitary_exact *wave);               /* m^2, above still water */
double sb_solitary_exact_elevation(const sb_solitary_exact *wave, double xi); /* m; xi: m ahead of the crest */

/* Sets the motion xi m ahead of the crest and z m above the bed, with an error below 1e-5 of sqrt(g h), and of g, for
   heights up to 0.6 of the depth, and 1e-4 beyond. Above the surface it is that of the surface. */
void sb_solitary_exact_motion(const sb_solitary_exact *wave, double xi, double z, sb_wave_motion *motion);

#endif

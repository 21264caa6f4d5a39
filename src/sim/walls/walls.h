/* Creation, motion and search of boundary particles. */
#ifndef SB_SIM_WALLS_H
#define SB_SIM_WALLS_H

#include "sim/simulation.h"

/* The moving bodies alone, which do not absorb yet: a part of sb_walls_create. It reads no boundary particles. */
sb_status sb_paddles_create(sb_sim *sim, sb_error *error);
sb_status sb_walls_create(sb_sim *sim, sb_error *error);
void sb_walls_destroy(sb_sim *sim);
/* sim/walls/volumes.c: psi_b = rho_0 / sum_k W_bk over the boundary particles k of `set` within h, b included
   [A12, eq. 4; S16, eq. 30]. only_own: only over those of the same body. The set must not have images yet. With images
   the factor of a lattice precedes (physics/wall_volume.h). Dynamic boundary particles have the mass of a water
   particle instead. Returns 0, or -1 without memory. */
int sb_wall_volumes(const sb_sim *sim, sb_wall_set *set, bool only_own);
/* Adds the images beyond periodic sides, with the volume, body and normal of their originals. mark: bits that are added
   to their bodies. Returns 0, or -1 without memory. */
int sb_wall_images(sb_wall_set *set, const sb_space *space, uint32_t mark);
/* Rebuilds the table of the moving bodies after their displacements have been set. */
sb_status sb_walls_restore(sb_sim *sim, sb_error *error);
/* Builds the hash set of blocks from the set's cells. Returns 0, or -1 without memory. */
int sb_walls_near_build(sb_wall_set *set, const sb_space *space);
/* Sorts a set along the Z-curve, stably, and builds its cells. Returns 0, or -1 without memory. */
int sb_walls_table(sb_wall_set *set, const sb_space *space);
/* sim/walls/divide.c: keeps this rank's share of the static set, which sb_walls_divide makes smaller. Not with foam,
   which may be anywhere, and dynamic boundary particles, which have numbers. Of a model with a part of the boundary
   particles the share is those that are not marked; the marks are taken away. Returns 0, or -1 without memory. */
int sb_walls_share(sb_sim *sim);
/* Marks of the bodies of static boundary particles, until shares have been taken: of another rank's share, from which
   volumes follow; an image beyond a periodic side. Shares keep the latter. */
#define SB_WALL_MARK ((uint32_t)1 << 31)
#define SB_WALL_IMAGE ((uint32_t)1 << 30)
void sb_walls_share_free(sb_wall_share *share);
/* Gives each rank the static boundary particles that its domain's particles may meet, if the domains have changed. All
   ranks call it. SB_FAILED without memory in any. */
sb_status sb_walls_divide(sb_sim *sim, sb_error *error);
/* Whether a cell may have boundary particles of the set within the support radius. */
bool sb_walls_near(const sb_wall_set *set, const sb_space *space, sb_record record);

#endif

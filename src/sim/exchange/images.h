/* Images beyond periodic sides, of owned particles and of those of other domains. */
#ifndef SB_SIM_IMAGES_H
#define SB_SIM_IMAGES_H

#include "sim/simulation.h"

/* Makes room for `halo` entries and `images` after the owned particles. Nothing in the workspace is alive. Returns 0,
   or -1 without memory. */
int sb_ghosts_reserve(sb_sim *sim, size_t halo, size_t images);

/* Makes the images with positions and cells; the halo has its positions. */
sb_status sb_images_make(sb_sim *sim, sb_error *error);

/* Copies to the images, `ghosts` + halo values, the values of their originals. */
struct sb_halo;
void sb_images_refresh(const sb_sim *sim, const struct sb_halo *halo);

#endif

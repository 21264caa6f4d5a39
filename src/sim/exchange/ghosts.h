/* Ghost particles: what neighbours are read from besides the owned particles. The entries of their arrays are

       [0, n)                 owned particles
       [n, n + halo)          particles of other domains, in the order of all particles
       [n + halo, ... count)  images of both beyond the periodic sides */
#ifndef SB_SIM_GHOSTS_H
#define SB_SIM_GHOSTS_H

#include "sim/search/cells.h"

#include <stdbool.h>

typedef struct sb_ghosts {
    size_t halo, lower;  /* lower: how many of the halo are of domains before this one */
    sb_cells halo_cells; /* table over the records of the halo */

    size_t count;            /* images */
    bool any;                /* whether any domain has images */
    uint32_t *of;            /* entry of the original of each image: owned, or of the halo */
    sb_cells cells;          /* table over the images' records */
    uint64_t *words, *other; /* buffers of their sort */
    size_t of_capacity, words_capacity, other_capacity;
} sb_ghosts;

#endif

/* Ghost particles: images of fluid particles beyond the periodic sides. */
#ifndef SB_SIM_GHOSTS_H
#define SB_SIM_GHOSTS_H

#include "sim/search/cells.h"

/* Ghosts are the entries n to n + count of the arrays that neighbours are read from. */
typedef struct sb_ghosts {
    size_t count;
    uint32_t *of;            /* index of the original of each ghost */
    sb_cells cells;          /* table over the ghosts' records */
    uint64_t *words, *other; /* buffers of their sort */
    size_t of_capacity, words_capacity, other_capacity;
} sb_ghosts;

#endif

/* Images of owned particles beyond the periodic sides. */
#ifndef SB_SIM_GHOSTS_H
#define SB_SIM_GHOSTS_H

#include "sim/cells.h"
#include "sim/sim.h"

/* Entries n to n + count of the arrays that neighbours are read from. */
typedef struct sb_ghosts {
    size_t count;
    uint32_t *of;            /* the owned particle that each copies */
    sb_cells cells;          /* over their records */
    uint64_t *words, *other; /* for their sort */
    size_t of_capacity, words_capacity, other_capacity;
} sb_ghosts;

/* Gives the ghosts the values of a field (a velocity, an acceleration, an eddy viscosity) whose owned part has changed.
 */
void sb_ghosts_refresh(const sb_sim *sim, sb_f4 *field);
void sb_ghosts_refresh_values(const sb_sim *sim, float *field);
void sb_ghosts_destroy(sb_sim *sim);

#endif

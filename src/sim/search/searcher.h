/* The neighbour search of one thread. One pass over a group computes neighbour lists, density, wall vector and the
   diagonal of the pressure operator of each particle, because all four need the same offsets. */
#ifndef SB_SIM_SEARCHER_H
#define SB_SIM_SEARCHER_H

#include "sim/search/lists.h"

enum { SB_WALLS_AROUND_MAX = 4096 }; /* boundary particles in and beside one cell */

/* Limits that were exceeded: neighbours of a particle, boundary particles around a cell, records around a group. */
enum { SB_FULL_LIST = 1, SB_FULL_WALLS = 2, SB_FULL_AROUND = 4 };

typedef struct sb_searcher sb_searcher;

sb_searcher *sb_searcher_create(const sb_sim *sim); /* NULL without memory */
void sb_searcher_free(sb_searcher *searcher);
/* Appends the group's lists to `lists`, and fills in the fields of its particles. */
void sb_search_group(sb_sim *sim, sb_searcher *searcher, sb_list_builder *lists, sb_group *group);
/* The limits that were exceeded, as bits. */
unsigned sb_searcher_full(const sb_searcher *searcher);

/* sb_lists.unit of a simulation: the largest W'/r, that of coincident particles, has the root 2^15 - 1. */
float sb_lists_unit(const sb_sim *sim);

#endif

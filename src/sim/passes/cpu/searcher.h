/* The neighbour search of one thread. One pass over a group computes neighbour lists, density, wall vector and the
   diagonal of the pressure operator of each particle, because all four need the same offsets. */
#ifndef SB_SIM_SEARCHER_H
#define SB_SIM_SEARCHER_H

#include "sim/passes/cpu/lists.h"
#include "sim/passes/cpu/wall_finder.h"

/* Limits that were exceeded, besides those of a wall finder: records around a group, facets or images of walls around a
   group. SB_CROWDED beside SB_FULL_FACETS: nothing was appended yet, and a part of the group may have few enough. */
enum { SB_FULL_AROUND = 4, SB_FULL_FACETS = 8, SB_CROWDED = 16 };

/* A form of the search. */
typedef struct sb_search_form {
    void *(*create)(const sb_sim *sim); /* what one thread needs, one block of memory; NULL without memory */
    /* Appends the group's lists to `lists`, and fills in the fields of its particles. Returns the limits that were
       exceeded, as bits. */
    unsigned (*search)(sb_sim *sim, void *searcher, sb_list_builder *lists, sb_group *group);
} sb_search_form;

void *sb_searcher_create(const sb_sim *sim);
unsigned sb_search_group(sb_sim *sim, void *searcher, sb_list_builder *lists, sb_group *group);

/* Searches all groups and copies their lists into the shared pools. SB_FAILED if a limit was exceeded. */
sb_status sb_search_all(sb_sim *sim, const sb_search_form *form, sb_error *error);

/* sb_lists.unit of a simulation: the largest W'/r, that of coincident particles, has the root SB_ROOT_MAX. */
float sb_lists_unit(const sb_sim *sim);

#endif

/* Neighbour lists under construction: each thread writes those of a few groups at a time, then takes room for them in
   the shared pools. */
#ifndef SB_SIM_LISTS_H
#define SB_SIM_LISTS_H

#include "sim/vicinity.h"

enum { SB_WALLS_AROUND_MAX = 4096 }; /* boundary particles in and beside one cell */

/* There is more than fits: around a particle, of boundary particles around a cell, around a group. */
enum { SB_FULL_LIST = 1, SB_FULL_WALLS = 2, SB_FULL_AROUND = 4 };

typedef struct sb_list_builder {
    sb_four_pairs *four;
    uint32_t *wall;
    float *wall_slope;
    sb_run *run;
    size_t fours, walls, runs; /* written since the last time room was taken */
    size_t capacity_four, capacity_wall, capacity_slope, capacity_run;
    bool starved; /* memory ran out */
} sb_list_builder;

/* Appends the hits as particle i's list, their slopes by `root`; those beyond `count` are the particle itself. */
void sb_list_water(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i);
/* The same of boundary particles; candidates are as in sb_pairs.index. */
void sb_list_walls(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i);
/* Appends what is around a group. */
void sb_list_runs(sb_list_builder *lists, const sb_vicinity *v, sb_group *group);

/* sim/neighbours.c: the search through groups by one thread, and what it needs. */
struct sb_searcher;
struct sb_searcher *sb_searcher_create(const sb_sim *sim);
void sb_searcher_free(struct sb_searcher *searcher);
void sb_search_group(sb_sim *sim, struct sb_searcher *searcher, sb_list_builder *lists, sb_group *group);
/* Which of the limits were hit: bits. */
unsigned sb_searcher_full(const struct sb_searcher *searcher);

#endif

/* The records around a group of particles, gathered cell by cell: the candidates of the neighbour search. */
#ifndef SB_SIM_VICINITY_H
#define SB_SIM_VICINITY_H

#include "sim/passes/cpu/hits.h"
#include "sim/search/around.h"

/* Parts: fluid particles, then ghost particles beyond periodic sides. Images of both follow (passes/cpu/images.h). */
enum { SB_VICINITY_PARTS = 2, SB_VICINITY_CELLS = 64, SB_VICINITY_ROWS = 9 * SB_VICINITY_PARTS };
_Static_assert((int)SB_AROUND_MAX <= (int)SB_CANDIDATES_MAX && (int)SB_VICINITY_ROWS <= (int)SB_CANDIDATE_RANGES_MAX,
               "capacity of the search for hits");

typedef struct sb_vicinity {
    uint32_t low[3], cells[3];                                /* first cell along each axis, and how many */
    size_t parts, count;                                      /* count above SB_AROUND_MAX: too many */
    size_t images;                                            /* candidates [count, count + images) */
    uint32_t start[SB_VICINITY_PARTS][SB_VICINITY_CELLS + 1]; /* candidates of a cell: [start, next start) */
    size_t runs;
    sb_run run[SB_VICINITY_PARTS * SB_VICINITY_CELLS]; /* the same without images, as entries of sim->state.position */
    float x[SB_AROUND_MAX + SB_HIT_SPARE], y[SB_AROUND_MAX + SB_HIT_SPARE], z[SB_AROUND_MAX + SB_HIT_SPARE];
    sb_f4 place[SB_AROUND_MAX]; /* the same coordinates, one record each */
} sb_vicinity;

/* Gathers the records around a group, and sets the group's corner. */
void sb_vicinity_gather(const sb_sim *sim, sb_group *group, sb_vicinity *v);

/* Finds the candidates of parts [part, end) that may be within the support radius of a particle of the group. self: its
   offset from the group's corner. Returns the number of ranges. */
size_t sb_vicinity_candidates(const sb_sim *sim, const sb_vicinity *v, size_t part, size_t end, sb_f4 self,
                              sb_candidate_range range[SB_VICINITY_ROWS]);

/* The candidate that particle i of the group is. A group may begin within a cell. */
uint32_t sb_vicinity_candidate(const sb_sim *sim, const sb_vicinity *v, size_t i);

#endif

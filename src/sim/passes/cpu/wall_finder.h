/* Finds the boundary particles around one particle after the other. Where walls reflect water, boundary particles serve
   the drag and the eddy viscosity only, once or twice a step, and are found each time: lists of them would take more
   memory than all fields of a step (docs/decisions/0087). Other walls have lists, which the search fills by this. */
#ifndef SB_SIM_CPU_WALL_FINDER_H
#define SB_SIM_CPU_WALL_FINDER_H

#include "sim/passes/cpu/hits.h"
#include "sim/passes/cpu/kernel_batch.h"
#include "sim/walls/entry.h"

enum { SB_WALLS_AROUND_MAX = 4096 }; /* boundary particles in and beside one cell */
_Static_assert((int)SB_WALLS_AROUND_MAX <= (int)SB_CANDIDATES_MAX, "capacity of the search for hits");

/* Limits that were exceeded. */
enum { SB_FULL_LIST = 1, SB_FULL_WALLS = 2 };

/* Boundary particles around one cell as offsets from the cell's corner, in quanta. */
typedef struct sb_surroundings {
    size_t count;
    float x[SB_WALLS_AROUND_MAX + SB_HIT_SPARE], y[SB_WALLS_AROUND_MAX + SB_HIT_SPARE],
        z[SB_WALLS_AROUND_MAX + SB_HIT_SPARE];
    sb_f4 place[SB_WALLS_AROUND_MAX];
    float weight[SB_WALLS_AROUND_MAX];
    uint32_t index[SB_WALLS_AROUND_MAX];
} sb_surroundings;

/* What the search of one pass has in common. */
typedef struct sb_wall_search {
    const sb_kernel *kernel;
    sb_kernel_batch *batch;
    sb_find_hits *find_hits;
    float q_scale;     /* (quantum / h)^2 */
    float slope_scale; /* alpha quantum / h^(d+2): W'/r per quantum */
} sb_wall_search;

typedef struct sb_wall_finder {
    const sb_wall_search *search;
    uint64_t code;    /* of the cell whose surroundings these are; UINT64_MAX: none yet */
    sb_record corner; /* of that cell */
    sb_surroundings around;
    sb_hits hits;
    unsigned full; /* limits that were exceeded */
} sb_wall_finder;

/* Boundary particles of a list, in the form of sb_pairs; count: a multiple of four. */
typedef struct sb_wall_list {
    const uint32_t *index;
    const float *slope;
    size_t count;
} sb_wall_list;

sb_wall_search sb_wall_search_of(const sb_sim *sim);

/* The finder has no content yet; large parts of it are not written before they are needed. */
static inline void sb_wall_finder_begin(sb_wall_finder *f, const sb_wall_search *search)
{
    f->search = search;
    f->code = UINT64_MAX;
    f->around.count = 0;
    f->full = 0;
}

/* The hits of particle i: offsets from them, their entries as candidates, psi W'(r)/r times the quantum as slopes, psi
   as roots, and kernel values. Filled up to a multiple of four (`padded`) with the first at slope 0. */
const sb_hits *sb_wall_finder_find(const sb_sim *sim, sb_wall_finder *f, size_t i);

/* Those around particle i, of the lists if there are any, else found now. */
static inline sb_wall_list sb_wall_list_of(const sb_sim *sim, sb_wall_finder *f, size_t i)
{
    const sb_pairs *pairs = &sim->work.wall_pairs;
    if (sim->needs.wall_lists)
        return (sb_wall_list){pairs->index + pairs->first[i], pairs->slope + pairs->first[i], pairs->count[i]};
    const sb_hits *h = sb_wall_finder_find(sim, f, i);
    return (sb_wall_list){h->candidate, h->slope, h->padded};
}

/* The body of all boundary particles of a list, if none is an image beyond a periodic side; else SB_WALL_NONE or
   SB_WALL_SEVERAL. */
uint32_t sb_wall_list_body(const sb_sim *sim, sb_wall_list walls);

/* SB_OK, or SB_FAILED for limits that a finder exceeded. */
sb_status sb_wall_finder_refuse(const sb_sim *sim, unsigned full, sb_error *error);

#endif

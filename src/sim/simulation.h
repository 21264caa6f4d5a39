/* The simulation's structure, private to src/sim. A stage reads the constant parts, the state and the workspace, and
   writes the state and the workspace. Nothing reads the report, which is for output only. */
#ifndef SB_SIM_SIMULATION_H
#define SB_SIM_SIMULATION_H

#include "sim/exchange/ghosts.h"
#include "sim/needs.h"
#include "sim/search/cells.h"
#include "sim/search/pairs.h"
#include "sim/sim.h"
#include "sim/state/constants.h"
#include "sim/state/space.h"
#include "sim/state/state.h"
#include "sim/state/work.h"
#include "sim/step/policy.h"
#include "sim/walls/sets.h"

enum {
    SB_BLOCK = 1024, /* particles per unit of work */
    SB_SIM_SKIPPED_MAX = 16
};

struct sb_passes;   /* sim/passes/passes.h */
struct sb_pushes;   /* sim/walls/pushes.h */
struct sb_strip;    /* sim/sea/strip.h */
struct sb_exchange; /* sim/exchange/exchange.h */
struct sb_foam;     /* sim/foam/foam.h */
struct sb_domains;  /* sim/exchange/domains.h */

struct sb_sim {
    /* constant */
    const sb_scene *scene;
    const sb_model *model;
    sb_constants constant;
    sb_needs needs;
    sb_space space;
    const struct sb_passes *passes;     /* over pairs, in the form for this processor */
    const struct sb_exchange *exchange; /* with other domains */
    sb_ranks *ranks;                    /* that compute the run together; NULL: it is alone */
    struct sb_domains *domains;         /* NULL: it is alone */

    sb_state state;
    struct sb_strip *strip;       /* of given water; NULL: no side is a sea */
    const sb_step_policy *policy; /* of the present step */
    sb_walls walls;

    /* of one step */
    sb_work work;
    sb_cells cells;
    sb_ghosts ghosts;
    sb_groups groups;

    /* output only */
    struct sb_foam *foam;     /* NULL: the scene has none */
    struct sb_pushes *pushes; /* sim/walls/pushes.h; NULL: none are recorded */
    sb_step_report report;
    sb_stage_time stage[SB_STAGES_MAX];
    size_t stage_count;
    sb_skipped skipped[SB_SIM_SKIPPED_MAX + 1];
};

/* The first entry of images beyond periodic sides. */
static inline size_t sb_images_first(const sb_sim *sim)
{
    return sim->state.n + sim->ghosts.halo;
}

static inline size_t sb_blocks(const sb_sim *sim)
{
    return (sim->state.n + SB_BLOCK - 1) / SB_BLOCK;
}

/* B_i = sum_b psi_b grad W_ib, kg/m^4, which is 0 where walls reflect. The last lane has no meaning. */
SB_INLINE sb_f4 sb_wall_vector(const sb_sim *sim, size_t i)
{
    return sim->work.wall ? sim->work.wall[i] : (sb_f4){0};
}

/* The same for all particles: vector[i * step]. A choice for each particle would let compilers round sums otherwise. */
typedef struct sb_wall_vectors {
    const sb_f4 *vector;
    size_t step;
} sb_wall_vectors;

SB_INLINE sb_wall_vectors sb_wall_vectors_of(const sb_sim *sim)
{
    static const sb_f4 none = {0};
    return sim->work.wall ? (sb_wall_vectors){sim->work.wall, 1} : (sb_wall_vectors){&none, 0};
}

/* What the motion of walls adds to the divergence at particle i, kg/m^3/s. */
SB_INLINE float sb_wall_flux(const sb_sim *sim, size_t i)
{
    return sim->work.wall ? sim->work.wall[i][3] : sim->work.flux[i];
}

static inline size_t sb_block_end(const sb_sim *sim, size_t block)
{
    size_t end = (block + 1) * SB_BLOCK;
    return end < sim->state.n ? end : sim->state.n;
}

#endif

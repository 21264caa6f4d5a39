/* Still water left alone: what no wave has come near keeps its place and its pressure, is at rest, and costs next
   to nothing; for the water beside it, it is a neighbour like any other (docs/decisions/0006). Sleepers are kept
   apart from the particles that the stages own, ordered by tile: a column of water over a square of the ground. */
#ifndef SB_SIM_SLEEP_H
#define SB_SIM_SLEEP_H

#include "base/archive.h"
#include "sim/state.h"

/* Squares of the ground from the domain's lower corner on, row after row along x; a cell lies in one of them. In 2D
   there is one row. */
typedef struct sb_tiles {
    int shift;        /* tile = (place - corner) >> shift: their edge in quanta is 2^shift */
    uint32_t size[2]; /* tiles along x and y */
    size_t count;
    bool wraps[2];  /* whether the domain repeats along the axis */
    uint32_t reach; /* tiles around what is reached or stirred that are awake */
    uint64_t ticks; /* tiles that the front of what is reached has gone so far */
    uint32_t full;  /* particles over the fullest tile */
    unsigned char *awake, *reached, *occupied, *stirred, *fringe, *beside, *spare; /* per tile, see below */
    int64_t (*momentum)[2]; /* sum of horizontal velocity, in units of 2^-20 sqrt(g D) */
    uint32_t *water;        /* particles awake over it */
} sb_tiles;
/* awake: nothing sleeps there; for good. reached: a wave from what has moved so far may have come there. stirred:
   disturbed, or may be at any time. occupied: particles awake are over it, whether it is awake or not. fringe: asleep,
   and awake water may touch it. beside: fringe, or next to some. */

/* What water asleep does to a body: pressure, friction and moment as in an impulse, N and N m. */
typedef struct sb_held_force {
    uint32_t tile, body;
    double value[9];
} sb_held_force;

/* N, of a particle on a wall through contact; wall as in wall_pairs. */
typedef struct sb_settled_push {
    float push[3];
    uint32_t wall;
} sb_settled_push;

typedef struct sb_sleep {
    sb_tiles tiles;

    /* the sleepers, tile after tile and along the Z-curve in each */
    size_t count;
    size_t *first;       /* tiles + 1: those of tile t are [first[t], first[t + 1]) */
    sb_record *position; /* quanta; last lane 0 */
    float *pressure;     /* Pa */
    float *density;      /* kg/m^3 */
    uint32_t *id;
    size_t capacity; /* of these: how many slept at first */
    sb_cells cells;

    /* those that awake water may touch, and their images beyond periodic sides: copied behind the ghosts in each
       step, at rest */
    size_t fringe;
    sb_record *fringe_position;
    float *fringe_q, *fringe_density; /* p / rho^2, kg/m^3 */
    sb_cells fringe_cells;
    unsigned char *block_beside; /* per block of awake particles: some may touch sleepers */

    /* forces on bodies, means over the last steps of settling, by tile; their sums, 9 values per body */
    size_t held_count;
    sb_held_force *held;
    double *held_sum;

    sb_vec3 rub, support; /* N, of sleepers on awake water in this step: by viscosity, by pressure */
    uint64_t particle_steps, asleep_steps;
    /* by id, until the start: means over the last steps of settling */
    float *settled_q;
    sb_settled_push *settled_push;
    float share;  /* of the next step in them */
    double woken; /* s, when the last of them woke; below 0: some sleep still */
} sb_sleep;

/* Whether the scene asks for it, and its water is still at the start. */
bool sb_sleep_wanted(const sb_scene *scene);

/* Around settling: before its first step, after each, and after the last: lays to sleep what is not near water or
   bodies that move or may. */
sb_status sb_sleep_expect(sb_sim *sim, sb_error *error);
void sb_sleep_feel(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 push); /* in the step: contact */
void sb_sleep_listen(sb_sim *sim, int step);
sb_status sb_sleep_begin(sb_sim *sim, sb_error *error);
int sb_sleep_make(sb_sim *sim); /* without sleepers; 0, or -1 without memory */
void sb_sleep_destroy(sb_sim *sim);
size_t sb_sleep_bytes(const sb_sim *sim);

/* sim/sleep_save.c: for sb_sim_save and sb_sim_load, after the particles awake. What makes no sense is refused by the
   archive; SB_FAILED: no memory. */
void sb_sleep_save(const sb_sim *sim, sb_archive_out *out);
sb_status sb_sleep_load(sb_sim *sim, sb_archive_in *in, sb_error *error);

/* Stages: wakes what a disturbance has come near (before the sort); puts the fringe behind the ghosts (after them). */
sb_status sb_stage_wake(sb_sim *sim, sb_error *error);
sb_status sb_stage_fringe(sb_sim *sim, sb_error *error);

/* Sleepers of the fringe in this step: entries from sb_fringe_first on of the arrays that neighbours are read from. */
static inline size_t sb_fringe_count(const sb_sim *sim)
{
    return sim->sleep ? sim->sleep->fringe : 0;
}

static inline size_t sb_fringe_first(const sb_sim *sim)
{
    return sim->n + sim->ghosts.count;
}

/* How many sleep. */
static inline size_t sb_asleep(const sb_sim *sim)
{
    return sim->sleep ? sim->sleep->count : 0;
}

/* The tile over which a place lies, where a periodic side is the domain's end; those beyond it count to its margin. */
SB_INLINE size_t sb_tile_within(const sb_sim *sim, const sb_tiles *tiles, sb_record at)
{
    const uint32_t low = sb_space_low(&sim->space);
    uint32_t index[2] = {0, 0};
    for (int axis = 0; axis < 2; axis++) {
        index[axis] = at[axis] > low ? (at[axis] - low) >> tiles->shift : 0;
        index[axis] = index[axis] < tiles->size[axis] ? index[axis] : tiles->size[axis] - 1;
    }
    return (size_t)index[1] * tiles->size[0] + index[0];
}

/* The same, where what is beyond a periodic side is back through the other. */
SB_INLINE size_t sb_tile_of(const sb_sim *sim, const sb_tiles *tiles, sb_record at)
{
    return sb_tile_within(sim, tiles, sim->space.repeats ? sb_space_wrap(&sim->space, at) : at);
}

/* sim/sleep_tiles.c */
int sb_tiles_create(const sb_sim *sim, sb_tiles *tiles); /* 0, or -1 without memory */
void sb_tiles_free(sb_tiles *tiles);
size_t sb_tiles_bytes(const sb_tiles *tiles);
/* Looks at the water awake and at moving bodies: water, occupied, stirred, reached; at step 0 also for what the scene
   starts with in motion. */
void sb_tiles_look(const sb_sim *sim, sb_tiles *tiles);
/* Lets the front of what is reached run on to the present time, and wakes the tiles within reach of reached and
   stirred ones. Returns whether any was asleep. */
bool sb_tiles_wake(const sb_sim *sim, sb_tiles *tiles);
/* Finds fringe and beside anew. Returns whether the fringe has changed. */
bool sb_tiles_fringe(sb_tiles *tiles);
void sb_tiles_beside(sb_tiles *tiles); /* beside, from fringe */

/* sim/sleep_store.c */
int sb_sleepers_reserve(sb_sleep *sleep); /* arrays for count of them, in the place of any there were */
/* Moves the water over tiles that are not awake out of the simulation's arrays, which are sorted, to rest at its
   settled pressure; density: by id. */
int sb_sleepers_take(sb_sim *sim, const float *density);
/* Gives those over awake tiles back, at the arrays' end. */
int sb_sleepers_wake(sb_sim *sim);
/* Collects the fringe. 0, or -1 without memory. */
int sb_sleepers_fringe(sb_sim *sim);

/* sim/sleep_forces.c */
/* Keeps what the water over tiles that are not awake did to bodies while it settled. 0, or -1 without memory. */
int sb_held_take(sb_sim *sim);
void sb_held_wake(sb_sim *sim);             /* leaves out what has woken */
void sb_held_press(sb_sim *sim, double dt); /* adds to the bodies' impulses */
/* Sum (N) of what `of` says (m/s^2) that sleepers do to each particle that may touch them. around: its group's, with
   velocities and, where they are, eddy viscosities; sleepers are the places from the group's first one on. */
typedef sb_f4 sb_sleep_share(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i, const void *with);
sb_vec3 sb_sleep_sum(const sb_sim *sim, sb_sleep_share *of, const void *with);
void sb_sleep_support(sb_sim *sim); /* support, by the pressures that moved the water */

#endif

/* Spray, foam and bubbles: particles that breaking water emits, for pictures and files [Ihmsen et al. 2012]. The water
   moves them and does not feel them: nothing outside of this folder reads them but snapshots, checkpoints and the
   report.

   A particle of water emits where air is near, where neighbours approach it (trapped air) or where it is at a crest
   that moves outwards, and where it is fast. The scales are the speed sqrt(g D) and the time sqrt(D/g) of the water's
   waves, and sqrt(g dr): speeds of approach above it can lift water by a spacing and so mix it with air. Sums over
   neighbours have the weight 1 - r/h and are divided by that of a full lattice, so that they do not depend on the
   support radius.

   Each particle of foam is of one kind in a step, by the share s of the sum of weights around it: spray falls freely,
   foam at the surface moves with the water around it, bubbles rise through that water. Particles end after their life
   in water, in solids and outside of the domain. */
#ifndef SB_SIM_FOAM_H
#define SB_SIM_FOAM_H

#include "sim/simulation.h"

#include <math.h>

/* Where something begins and where it is complete: x maps to (x - from)/(to - from), limited to [0, 1]. */
typedef struct sb_foam_range {
    float from, to;
} sb_foam_range;

/* Constants of a run. */
typedef struct sb_foam_law {
    sb_foam_range energy;   /* (m/s)^2, square of the speed */
    sb_foam_range trapped;  /* m/s, mean speed of approach */
    sb_foam_range crest;    /* mean of 1 - cos of the angle between normals */
    float surface;          /* least length of work.surface where air is near */
    float outwards;         /* least cosine between velocity and normal at a crest */
    float rate;             /* 1/s, particles that one of water emits at most for each of the two reasons */
    float lifetime;         /* s, longest life in water */
    float rise;             /* m/s, speed of bubbles relative to the water */
    float air, water;       /* shares s below which a particle is spray, and above which it is a bubble */
    float support, inverse; /* m; 1/m */
    float full;             /* sum of weights of a full lattice */
} sb_foam_law;

/* A particle. Checkpoints have it as it is, so that it must have no padding. */
typedef struct sb_foam_particle {
    sb_record position; /* quanta; last lane 0 */
    sb_f4 velocity;     /* m/s; last lane: s of life in water left */
    uint32_t id, kind;  /* kind: sb_foam_kind; SB_FOAM_KINDS: it has ended */
    uint32_t spare[2];  /* 0 */
} sb_foam_particle;

typedef struct sb_foam {
    sb_foam_law law;
    size_t count, capacity;
    sb_foam_particle *particle; /* in the order of emission */
    uint32_t next_id;
    uint64_t *words, *other; /* buffers of the order by cells */
    size_t words_capacity, other_capacity;
} sb_foam;

/* What decides how much a particle of water emits. */
typedef struct sb_foam_sums {
    float trapped, crest; /* as in sb_foam_law; crest 0 where the particle does not move outwards */
} sb_foam_sums;

/* The water around a place. */
typedef struct sb_foam_water {
    float share;    /* s */
    sb_f4 velocity; /* m/s, weighted mean; 0 without water */
} sb_foam_water;

/* The record that is `way` (m) from another, within the range of positions. */
static inline sb_record sb_foam_displaced(const sb_sim *sim, sb_record from, sb_f4 way)
{
    sb_record to = {0};
    for (int axis = 0; axis < 3; axis++) {
        const double at = from[axis] + rint((double)way[axis] / sim->space.quantum);
        to[axis] = at < 0 ? 0 : at >= SB_POSITION_END ? SB_POSITION_END - 1 : (uint32_t)at;
    }
    return to;
}

/* foam.c: makes sim->foam if the scene has foam. SB_FAILED without memory. */
sb_status sb_foam_create(sb_sim *sim, sb_error *error);
void sb_foam_destroy(sb_foam *foam);
size_t sb_foam_bytes(const sb_foam *foam);
/* Saves and loads within the section of the simulation; nothing without foam. */
void sb_foam_save(const sb_sim *sim, sb_archive_out *out);
void sb_foam_load(sb_sim *sim, sb_archive_in *in);
/* Number of particles of each kind. */
void sb_foam_count(const sb_foam *foam, size_t count[SB_FOAM_KINDS]);
/* Fills the foam of a frame. Returns 0, or -1 without memory. */
int sb_foam_fill(const sb_sim *sim, sb_frame *frame);
/* The stage, before the water moves: moves the particles to t + dt and emits new ones, in steps of the run only. */
sb_status sb_stage_foam(sb_sim *sim, sb_error *error);

/* potentials.c: computes work.surface from the neighbour lists; then work.emission, the expected number of particles
   that each particle of water emits in this step, times SB_FOAM_ONE. */
enum { SB_FOAM_ONE = 1 << 16 };
void sb_foam_find_surface(sb_sim *sim);
void sb_foam_find_emission(sb_sim *sim);
/* The sums of particle i of a group; entry: the index of each record around the group. */
sb_foam_sums sb_foam_sums_of(const sb_sim *sim, const uint32_t *entry, size_t i);
/* Writes the index of each record around a group. entry: SB_AROUND_MAX. */
void sb_foam_entries(const sb_sim *sim, const sb_group *group, uint32_t *entry);

/* motion.c: moves all particles by the time step, and removes those that end. Returns 0, or -1 without memory. */
int sb_foam_move(sb_sim *sim);
/* The water around a place at the step's start, with velocities at its end. */
sb_foam_water sb_foam_look(const sb_sim *sim, sb_record at);

/* emission.c: emits by work.emission, at most up to foam.most. Returns 0, or -1 without memory. */
int sb_foam_emit(sb_sim *sim);

#endif

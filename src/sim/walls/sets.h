/* Boundary particles [A12]: the static ones, and those of moving bodies. */
#ifndef SB_SIM_WALL_SETS_H
#define SB_SIM_WALL_SETS_H

#include "physics/absorption/absorbing.h"
#include "physics/wavemakers/wavemaker.h"
#include "sim/search/cells.h"
#include "sim/sim.h"
#include "sim/state/space.h"

/* Boundary particles that share one search table: all static ones, or all moving ones, images beyond periodic sides
   included. */
typedef struct sb_wall_set {
    size_t count;
    sb_record *record; /* sorted by cell; last lane: psi_b in kg (kg/m in 2D) */
    uint32_t *body;    /* model body of each */
    uint32_t *facing;  /* its normal's index in sb_walls.normals */
    uint32_t *number;  /* of dynamic boundary particles (sim/wcsph/boundary.h); NULL: they are not */
    sb_cells cells;
    uint64_t *near; /* hash set of Z-order blocks with walls in or beside them */
    uint64_t near_mask;
} sb_wall_set;

/* Of a boundary particle: record, body, index of its normal. */
enum { SB_WALL_BYTES = sizeof(sb_record) + 2 * sizeof(uint32_t) };

enum { SB_STATIC, SB_MOVING, SB_WALL_SETS };

struct sb_absorber; /* sim/walls/absorber.h */

/* The law of a wave maker: one for all bodies that it moves, so that a sum of many waves is evaluated once per step and
   not once per push-plate. */
typedef struct sb_moving_law {
    sb_paddle paddle;           /* kind NULL: it moves no body */
    sb_absorbing_filter filter; /* of a paddle that absorbs */
    bool commanded;             /* its start waits for a command, or one gave it: it is saved */
    double here, there;         /* m, its displacement at t and t + dt; of the present step only */
    double surface;             /* m, the waves of a paddle that absorbs, at t; of the present step only */
} sb_moving_law;

/* A moving body and its present displacement. */
typedef struct sb_moving_body {
    sb_moving_law *law;
    struct sb_absorber *absorber; /* NULL: it only follows its law */
    sb_vec3 direction;
    double share;                           /* of the law's motion that it makes */
    double displacement, next_displacement; /* m, at t and t + dt */
    sb_vec3 velocity;                       /* m/s, between them */
} sb_moving_body;

/* Boundary particles of moving bodies at displacement 0. */
typedef struct sb_moving_rest {
    size_t count;
    sb_record *record;
    uint32_t *body, *facing;
    uint32_t *number; /* as in sb_wall_set */
} sb_moving_rest;

struct sb_mirror; /* sim/walls/mirrors.c */
struct sb_mirror_edge;
struct sb_mirror_entry;

/* The facets at which water is reflected, and a table of those near each block of 2 x 2 x 2 cells. */
typedef struct sb_mirrors {
    size_t count, capacity, edge_count, edge_capacity;
    struct sb_mirror *mirror;
    struct sb_mirror_edge *edge;
    size_t moving_count;
    uint32_t *moving; /* mirrors of moving bodies that water may meet now; they are in no block */
    size_t entries, entries_capacity;
    struct sb_mirror_entry *entry; /* sorted by block */
} sb_mirrors;

/* Dynamic boundary particles by number (sim/wcsph/boundary.h). count 0: there are none. */
typedef struct sb_boundary {
    size_t count;
    float *excess, *begin; /* kg/m^3, density above the rest density, at present and at the step's start; NAN: dry */
    float *rate;           /* kg/m^3/s, of the density */
    float *load;           /* q = p/rho^2 */
} sb_boundary;

/* A share of all static boundary particles in the order of their keys, which each of several ranks keeps, so that the
   ranks can give each other those near their domains. The static set then has only these. */
typedef struct sb_wall_share {
    uint64_t *cut; /* of the domains for which the static set was made; NULL: the static set has all */
    size_t count;
    sb_record *record; /* as in sb_wall_set */
    uint32_t *body, *facing;
} sb_wall_share;

/* Normals of boundary particles (sim/walls/normals.h). */
typedef struct sb_wall_normals {
    size_t count, capacity, slots;
    sb_f4 *normal;
    uint32_t *slot; /* hash set of them: index plus 1; 0: none */
} sb_wall_normals;

typedef struct sb_walls {
    sb_wall_share share;
    sb_wall_normals normals;
    sb_mirrors mirrors;
    sb_boundary boundary;
    sb_wall_set set[SB_WALL_SETS];
    sb_moving_rest rest;
    sb_moving_law *laws; /* one per wave maker of the scene */
    size_t moving_count;
    sb_moving_body *moving;   /* bodies */
    uint32_t *moving_of_body; /* model body -> index into moving, UINT32_MAX: static */
} sb_walls;

#endif

/* An entry of a wall list (sb_pairs.index): the wall set in the highest bit, and a boundary particle of that set in the
   other bits. */
#ifndef SB_SIM_WALL_ENTRY_H
#define SB_SIM_WALL_ENTRY_H

#include "sim/simulation.h"
#include "sim/state/simd.h"

enum { SB_WALL_SET_SHIFT = 31 };

SB_INLINE uint32_t sb_wall_entry(uint32_t set, uint32_t particle)
{
    return set << SB_WALL_SET_SHIFT | particle;
}

SB_INLINE bool sb_wall_moves(uint32_t entry)
{
    return entry >> SB_WALL_SET_SHIFT == SB_MOVING;
}

SB_INLINE uint32_t sb_wall_particle(uint32_t entry)
{
    return entry & ((1u << SB_WALL_SET_SHIFT) - 1);
}

SB_INLINE const sb_wall_set *sb_wall_set_of(const sb_sim *sim, uint32_t entry)
{
    return &sim->walls.set[entry >> SB_WALL_SET_SHIFT];
}

/* Index of the model's body that the boundary particle belongs to. */
SB_INLINE uint32_t sb_wall_body(const sb_sim *sim, uint32_t entry)
{
    return sb_wall_set_of(sim, entry)->body[sb_wall_particle(entry)];
}

/* Velocity of the boundary particle in this step, m/s; last lane 0. */
SB_INLINE sb_f4 sb_wall_velocity(const sb_sim *sim, uint32_t entry)
{
    if (!sb_wall_moves(entry)) return (sb_f4){0};
    const sb_vec3 v = sim->walls.moving[sim->walls.moving_of_body[sb_wall_body(sim, entry)]].velocity;
    return (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

#endif

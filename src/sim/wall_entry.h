/* An entry of a list of walls (sb_pairs.index): a wall set in its highest bit, a boundary particle of that set below.
 */
#ifndef SB_SIM_WALL_ENTRY_H
#define SB_SIM_WALL_ENTRY_H

#include "sim/simd.h"
#include "sim/state.h"

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
    return &sim->walls[entry >> SB_WALL_SET_SHIFT];
}

/* The model's body that it belongs to. */
SB_INLINE uint32_t sb_wall_body(const sb_sim *sim, uint32_t entry)
{
    return sb_wall_set_of(sim, entry)->body[sb_wall_particle(entry)];
}

/* m/s, over the step; last lane 0. */
SB_INLINE sb_f4 sb_wall_velocity(const sb_sim *sim, uint32_t entry)
{
    if (!sb_wall_moves(entry)) return (sb_f4){0};
    const sb_vec3 v = sim->moving[sim->moving_of_body[sb_wall_body(sim, entry)]].velocity;
    return (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

#endif

/* Normals of boundary particles, each once: walls have many boundary particles and few directions. */
#ifndef SB_SIM_WALL_NORMALS_H
#define SB_SIM_WALL_NORMALS_H

#include "sim/simulation.h"

/* The index of a normal in the table, which it joins if it is new. Returns 0, or -1 without memory. */
int sb_wall_normals_index(sb_wall_normals *table, sb_f4 normal, uint32_t *index);
void sb_wall_normals_free(sb_wall_normals *table);
size_t sb_wall_normals_bytes(const sb_wall_normals *table);

/* Unit, towards the water; 0 0 0 if the model has none. */
SB_INLINE sb_f4 sb_wall_normal(const sb_sim *sim, const sb_wall_set *set, size_t particle)
{
    return sim->walls.normals.normal[set->facing[particle]];
}

#endif

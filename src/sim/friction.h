/* Wall friction of one pair, used where it moves the water and where it pushes the body. */
#ifndef SB_SIM_FRICTION_H
#define SB_SIM_FRICTION_H

#include "sim/state.h"

/* -psi_b Pi_ib grad W_ib times the quantum [S16, eq. 33]; factor = sigma h c_s / 2, epsilon = 0.01 h^2 in
   quanta^2, slope as in wall_pairs. */
SB_INLINE sb_f4 sb_friction(const sb_sim *sim, size_t i, sb_f4 velocity, uint32_t wall, float slope,
                            float factor, float epsilon)
{
    const sb_wall_set *set = &sim->walls[wall >> 31];
    wall &= 0x7fffffffu;
    sb_f4 d = sb_offset(sim->position[i], set->record[wall]);
    if (set == &sim->walls[SB_MOVING]) {
        sb_vec3 v = sim->moving[sim->moving_of_body[set->body[wall]]].velocity;
        velocity -= (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
    }
    float approach = sb_sum3(velocity * d);
    if (approach >= 0)
        return (sb_f4){0};
    float r2 = sb_sum3(d * d);
    return d * sb_splat(factor * approach * slope / ((r2 + epsilon) * sim->density[i]));
}

#endif

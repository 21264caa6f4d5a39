/* What walls do along themselves: friction and shear of one pair, used where they move the water and where they
   push the body. */
#ifndef SB_SIM_FRICTION_H
#define SB_SIM_FRICTION_H

#include "sim/state.h"

#include <math.h>

/* Factors of one step; lengths in quanta where that is said. */
typedef struct sb_rub {
    bool on;
    float friction; /* sigma h c_s / (2 quanta) [S16, eq. 33]; 0: none */
    float epsilon;  /* 0.01 h^2, quanta^2 */
    bool shear;     /* whether smooth walls hold the water that slides along them */
    float viscosity, rest_density;  /* m^2/s; kg/m^3: density sums beside walls are none of the water's */
    float quantum, offset, nearest; /* m; of the sheet behind the wall, and least from the wall: quanta */
} sb_rub;

/* Whether walls hold what slides along them. */
bool sb_shear_on(const sb_scene *scene);

sb_rub sb_rub_make(const sb_sim *sim);

/* Of a smooth wall's shear over rho u^2, u the speed along it at a Reynolds number's distance: below 139 the laminar
   sublayer, above it the power law of the turbulent one [Werner & Wengle 1991, eqs. 17, 18 at a point: u+ = y+,
   and 8.3 (y+)^(1/7)]. */
SB_INLINE float sb_wall_law(float reynolds)
{
    return fmaxf(1 / reynolds, 0.0246f / sqrtf(sqrtf(reynolds)));
}

/* The shear of a plane wall is the same for all its boundary particles: what has been found of it for one particle of
   the water. Starts as zeros. */
typedef struct sb_rubbing {
    sb_f4 normal, velocity; /* the boundary particle's, and the water's beside the wall's */
    float height;           /* above its sheet, quanta: parallel walls, as of stairs, are not one */
    sb_f4 shear;            /* c_f |u| u / rho_0 */
} sb_rubbing;

SB_INLINE bool sb_same3(sb_f4 a, sb_f4 b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* height: above the sheet, quanta. */
SB_INLINE void sb_shear_look(sb_rubbing *of, sb_f4 normal, sb_f4 velocity, float height, const sb_rub *rub)
{
    const sb_f4 along = velocity - normal * sb_splat(sb_sum3(normal * velocity));
    const float u2 = sb_sum3(along * along);
    *of = (sb_rubbing){.normal = normal, .velocity = velocity, .height = height};
    if (!(u2 > 0))
        return;
    const float u = sqrtf(u2), distance = fmaxf(height - rub->offset, rub->nearest) * rub->quantum;
    of->shear = along * sb_splat(sb_wall_law(u * distance / rub->viscosity) * u / rub->rest_density);
}

/* Acceleration of particle i by one pair, m/s^2; slope as in wall_pairs. Shear acts on the area of wall that the
   particle's pressure acts on. */
SB_INLINE sb_f4 sb_rubbed(const sb_sim *sim, size_t i, sb_f4 velocity, uint32_t wall, float slope, const sb_rub *rub,
                          sb_rubbing *rubbing)
{
    const sb_wall_set *set = &sim->walls[wall >> 31];
    wall &= 0x7fffffffu;
    const sb_f4 d = sb_offset(sim->position[i], set->record[wall]);
    sb_f4 sum = {0};
    if (set == &sim->walls[SB_MOVING]) {
        sb_vec3 v = sim->moving[sim->moving_of_body[set->body[wall]]].velocity;
        velocity -= (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
    }
    if (rub->friction > 0) {
        const float approach = sb_sum3(velocity * d);
        if (approach < 0)
            sum += d * sb_splat(rub->friction * approach * slope / ((sb_sum3(d * d) + rub->epsilon) * sim->density[i]));
    }
    const sb_f4 normal = set->normal[wall];
    const float height = rub->shear ? sb_sum3(normal * d) : 0;
    if (height > 0) {
        const bool level = fabsf(height - rubbing->height) <= 1e-4f * rub->nearest;
        if (!level || !sb_same3(normal, rubbing->normal) || !sb_same3(velocity, rubbing->velocity))
            sb_shear_look(rubbing, normal, velocity, height, rub);
        sum += rubbing->shear * sb_splat(slope * height);
    }
    return sum;
}

#endif

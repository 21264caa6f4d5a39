/* Drag of walls, four boundary particles at a time. It is used for the acceleration of the water and for the force on
   the body. */
#ifndef SB_SIM_CPU_DRAG_H
#define SB_SIM_CPU_DRAG_H

#include "sim/walls/drag.h"
#include "sim/walls/entry.h"
#include "sim/walls/normals.h"

/* Shear stress of a smooth wall over rho u^2, with u the speed along the wall at the distance y, as a function of
   reynolds = u y/nu: the law of the laminar sublayer below 139, and above it the power law of turbulent flow
   [Werner & Wengle 1991, eqs. 17, 18 at a point: u+ = y+, and 8.3 (y+)^(1/7)]. */
SB_INLINE sb_f4 sb_wall_laws(sb_f4 reynolds)
{
    const sb_f4 laminar = sb_splat(1) / reynolds, turbulent = sb_splat(0.0246f) / sb_sqrt4(sb_sqrt4(reynolds));
    return sb_select(laminar > turbulent, laminar, turbulent);
}

SB_INLINE sb_f4 sb_dot4(sb_four a, sb_four b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Four boundary particles of a list relative to a fluid particle, by lanes. */
typedef struct sb_wall_four {
    sb_four offset, normal, velocity; /* quanta; unit vector; velocity of the water relative to the wall, m/s */
} sb_wall_four;

SB_INLINE sb_wall_four sb_gather_walls(const sb_sim *sim, size_t i, sb_f4 velocity, const uint32_t *wall)
{
    sb_f4 d[4], n[4], v[4];
    for (size_t k = 0; k < 4; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, wall[k]);
        const uint32_t b = sb_wall_particle(wall[k]);
        d[k] = sb_offset(sim->state.position[i], set->record[b]);
        n[k] = sb_wall_normal(sim, set, b);
        v[k] = velocity - sb_wall_velocity(sim, wall[k]);
    }
    return (sb_wall_four){sb_transpose(d[0], d[1], d[2], d[3]), sb_transpose(n[0], n[1], n[2], n[3]),
                          sb_transpose(v[0], v[1], v[2], v[3])};
}

/* Acceleration by wall shear, four pairs at a time: c_f |u| u/rho_0 times slope and height. */
SB_INLINE sb_four sb_wall_shear_four(const sb_wall_four *of, sb_f4 slope, const sb_wall_drag *law)
{
    const sb_f4 through = sb_dot4(of->normal, of->velocity), height = sb_dot4(of->normal, of->offset);
    const sb_f4 offset = sb_splat(law->offset), nearest = sb_splat(law->nearest);
    const sb_four along = {.x = of->velocity.x - of->normal.x * through,
                           .y = of->velocity.y - of->normal.y * through,
                           .z = of->velocity.z - of->normal.z * through};
    const sb_f4 u2 = sb_dot4(along, along), u = sb_sqrt4(u2);
    const sb_f4 above = height - offset;
    const sb_f4 distance = sb_select(above > nearest, above, nearest) * sb_splat(law->quantum);
    const sb_f4 stress = sb_wall_laws(u * distance / sb_splat(law->viscosity)) * u / sb_splat(law->rest_density);
    const sb_i4 slides = (height > (sb_f4){0}) & (u2 > (sb_f4){0});
    const sb_f4 shear = sb_select(slides, stress, (sb_f4){0}), area = sb_select(slides, slope * height, (sb_f4){0});
    return (sb_four){.x = along.x * shear * area, .y = along.y * shear * area, .z = along.z * shear * area};
}

/* Accelerations of particle i by friction and shear of four pairs, m/s^2. wall, slope: four entries of wall_pairs.
   Shear acts on the same area of wall as the particle's pressure. */
SB_INLINE void sb_wall_drag_four(const sb_sim *sim, size_t i, sb_f4 velocity, const uint32_t *wall, const float *slope,
                                 const sb_wall_drag *law, sb_f4 out[4])
{
    const sb_wall_four of = sb_gather_walls(sim, i, velocity, wall);
    const sb_f4 slopes = {slope[0], slope[1], slope[2], slope[3]};
    sb_four sum = {.x = {0}, .y = {0}, .z = {0}};
    if (law->friction > 0) {
        const sb_f4 approach = sb_dot4(of.velocity, of.offset);
        const sb_f4 weight = (sb_dot4(of.offset, of.offset) + sb_splat(law->epsilon)) * sb_splat(sim->work.density[i]);
        const sb_f4 factor =
            sb_select(approach < (sb_f4){0}, sb_splat(law->friction) * approach * slopes / weight, (sb_f4){0});
        sum = (sb_four){.x = of.offset.x * factor, .y = of.offset.y * factor, .z = of.offset.z * factor};
    }
    if (law->shear) {
        const sb_four shear = sb_wall_shear_four(&of, slopes, law);
        sum.x += shear.x;
        sum.y += shear.y;
        sum.z += shear.z;
    }
    const sb_four pairs = sb_transpose(sum.x, sum.y, sum.z, (sb_f4){0});
    out[0] = pairs.x, out[1] = pairs.y, out[2] = pairs.z, out[3] = pairs.w;
}

#endif

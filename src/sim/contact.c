#include "sim/contact.h"

#include <math.h>

enum { SWEEPS = 3 }; /* a corner of three walls asks for one each */

/* In spacings: the nearest a particle comes to the sheet; how fast one that starts nearer is let out. */
static const float NEAREST = 0.6f, RELEASE = 0.005f;

/* The wall as seen from a point: weighted means over the boundary particles in reach. */
typedef struct view {
    sb_f4 normal;    /* unit, towards the side that the particle is on */
    float distance;  /* quanta, of the point from the sheet; negative: beyond it */
    float before;    /* the same for where the particle is now */
    sb_f4 velocity;  /* m/s, of the wall */
    uint32_t nearest;
    bool found;
} view;

static sb_f4 wall_velocity(const sb_sim *sim, uint32_t wall)
{
    if (!(wall >> 31))
        return (sb_f4){0};
    const sb_wall_set *set = &sim->walls[SB_MOVING];
    sb_vec3 v = sim->moving[sim->moving_of_body[set->body[wall & 0x7fffffffu]]].velocity;
    return (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

/* step: where the point is, relative to the particle, in quanta. Weights fall off steeply, so that in a corner
   the nearer wall speaks. */
static view look(const sb_sim *sim, size_t i, sb_f4 step)
{
    const float reach = sim->constant.support / (float)sim->space.quantum;
    const uint32_t *index = sim->wall_pairs.index + sim->wall_pairs.first[i];
    const float *slope = sim->wall_pairs.slope + sim->wall_pairs.first[i];
    sb_f4 normal = {0}, place = {0};
    float total = 0, heaviest = 0;
    view v = {.found = false};
    for (size_t k = 0; k < sim->wall_pairs.count[i]; k++) {
        const sb_wall_set *set = &sim->walls[index[k] >> 31];
        const uint32_t b = index[k] & 0x7fffffffu;
        sb_f4 here = sb_offset(sim->position[i], set->record[b]);
        sb_f4 d = here + step;
        float q2 = sb_sum3(d * d) / (reach * reach);
        if (q2 >= 1 || slope[k] == 0)
            continue;
        float weight = (1 - q2) * (1 - q2);
        weight *= weight;
        normal += set->normal[b] * sb_splat(weight);
        place += here * sb_splat(weight);
        total += weight;
        if (weight > heaviest) {
            heaviest = weight;
            v.nearest = index[k];
        }
    }
    float length = sqrtf(sb_sum3(normal * normal));
    if (!(length > 0.1f * total))
        return v;
    v.normal = normal / sb_splat(length);
    v.before = sb_sum3(v.normal * place) / total;
    if (v.before < 0) { /* a plate's other side */
        v.normal = -v.normal;
        v.before = -v.before;
    }
    v.distance = v.before + sb_sum3(v.normal * step);
    v.velocity = wall_velocity(sim, v.nearest);
    v.found = true;
    return v;
}

bool sb_contact_mend(const sb_sim *sim, size_t i, sb_f4 *velocity, uint32_t *touched)
{
    const float to_quanta = (float)(sim->report.time_step / sim->space.quantum);
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    bool mended = false;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        const view v = look(sim, i, *velocity * sb_splat(to_quanta));
        if (!v.found)
            return mended;
        float wall = sb_sum3(v.velocity * v.normal) * to_quanta;
        float least = v.before + RELEASE * spacing;
        least = wall + (least < NEAREST * spacing ? least : NEAREST * spacing);
        if (v.distance >= least)
            return mended;
        *velocity += v.normal * sb_splat((least - v.distance) / to_quanta);
        *touched = v.nearest;
        mended = true;
    }
    return mended;
}

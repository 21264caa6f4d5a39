#include "sim/walls/contact.h"

#include "sim/walls/entry.h"

#include <math.h>

/* Distances in particle spacings, added to wall_offset.
   PLANE: smallest distance of a particle from the boundary surface, about where water at rest lies between boundary
   particles.
   BALL: smallest distance from any single boundary particle. It protects ridges, where the mean plane lies too low. */
static const float PLANE = 0.05f, BALL = 0.2f;

/* The wall around the position at the step's end. Lengths in quanta. */
typedef struct wall_view {
    sb_f4 normal;            /* unit, towards the particle's side: mean over the boundary particles in the support */
    float before, distance;  /* from the boundary surface along the normal, now and at the step's end */
    sb_f4 apart;             /* offset from the nearest boundary particle, at the step's end */
    float ball_before, ball; /* distance from the nearest boundary particle, now and at the step's end */
    uint32_t nearest;        /* as in wall_pairs */
    bool found;
} wall_view;

/* Four boundary particles of a list, relative to a fluid particle. */
typedef struct four_walls {
    const sb_f4 *normal[4];
    sb_f4 here[4], there[4]; /* offsets in quanta, now and at the step's end */
    sb_f4 q2, weight;        /* by lanes: (|there| / h)^2; weight 0 beyond h and for padding */
} four_walls;

/* Computes the offsets and weights of four boundary particles. The weights decrease steeply with distance, so that the
   nearer wall dominates in a corner. */
SB_INLINE void weigh_four(const sb_sim *sim, size_t i, size_t first, sb_f4 step, float to_quanta, four_walls *s)
{
    const float support = sim->constant.support / (float)sim->space.quantum;
    const uint32_t *index = sim->work.wall_pairs.index + first;
    sb_f4 slope;
    memcpy(&slope, sim->work.wall_pairs.slope + first, sizeof slope);
    for (size_t k = 0; k < 4; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, index[k]);
        const uint32_t b = sb_wall_particle(index[k]);
        s->normal[k] = &set->normal[b];
        s->here[k] = sb_offset(sim->state.position[i], set->record[b]);
        s->there[k] = s->here[k] + step - sb_wall_velocity(sim, index[k]) * sb_splat(to_quanta);
    }
    const sb_four at = sb_transpose(s->there[0], s->there[1], s->there[2], s->there[3]);
    s->q2 = (at.x * at.x + at.y * at.y + at.z * at.z) * sb_splat(1 / (support * support));
    sb_f4 weight = (sb_splat(1) - s->q2) * (sb_splat(1) - s->q2);
    weight *= weight;
    weight *= weight;
    s->weight = sb_select((s->q2 < sb_splat(1)) & (slope != (sb_f4){0}), weight, (sb_f4){0});
}

/* Averages the boundary particles of particle i's list. */
SB_INLINE wall_view find_wall(const sb_sim *sim, size_t i, sb_f4 velocity, float to_quanta)
{
    const size_t begin = sim->work.wall_pairs.first[i], end = begin + sim->work.wall_pairs.count[i];
    const sb_f4 step = velocity * sb_splat(to_quanta);
    sb_f4 normal = {0}, now = {0}, then = {0}, nearest = {0};
    float total = 0, least = 1;
    wall_view v = {.found = false};
    for (size_t first = begin; first < end; first += 4) {
        four_walls s;
        weigh_four(sim, i, first, step, to_quanta, &s);
        for (size_t k = 0; k < 4; k++) {
            normal += *s.normal[k] * sb_splat(s.weight[k]);
            now += s.here[k] * sb_splat(s.weight[k]);
            then += s.there[k] * sb_splat(s.weight[k]);
            total += s.weight[k];
            if (s.weight[k] > 0 && s.q2[k] < least) {
                least = s.q2[k];
                nearest = s.here[k];
                v.apart = s.there[k];
                v.nearest = sim->work.wall_pairs.index[first + k];
            }
        }
    }
    float length = sqrtf(sb_sum3(normal * normal));
    if (!(length > 0.1f * total)) return v;
    v.normal = normal / sb_splat(length);
    v.before = sb_sum3(v.normal * now) / total;
    v.distance = sb_sum3(v.normal * then) / total;
    if (v.before < 0) { /* the other side of a plate */
        v.normal = -v.normal;
        v.before = -v.before;
        v.distance = -v.distance;
    }
    v.ball_before = sqrtf(sb_sum3(nearest * nearest));
    v.ball = sqrtf(sb_sum3(v.apart * v.apart));
    v.found = true;
    return v;
}

SB_INLINE float smaller(float a, float b)
{
    return a < b ? a : b;
}

SB_MULTIVERSION
size_t sb_contact_resolve(const sb_sim *sim, size_t i, sb_f4 *velocity, sb_contact_push pushes[SB_CONTACT_PUSHES_MAX])
{
    const float to_quanta = (float)(sim->state.time_step / sim->space.quantum);
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    const float surface = (float)sim->scene->numerics.wall_offset;
    const float release = sim->policy->release * spacing;
    size_t count = 0;
    while (count < SB_CONTACT_PUSHES_MAX) {
        const wall_view v = find_wall(sim, i, *velocity, to_quanta);
        if (!v.found) break;
        float plane = smaller((surface + PLANE) * spacing, v.before + release) - v.distance;
        float ball = smaller((surface + BALL) * spacing, v.ball_before + release) - v.ball;
        sb_f4 change;
        if (plane > 0)
            change = v.normal * sb_splat(plane / to_quanta);
        else if (ball > 0 && v.ball > 0)
            change = v.apart * sb_splat(ball / (v.ball * to_quanta));
        else
            break;
        *velocity += change;
        pushes[count++] = (sb_contact_push){v.nearest, change};
    }
    return count;
}

#include "sim/contact.h"

#include "sim/wall_entry.h"

#include <math.h>

/* In spacings, beyond wall_offset. PLANE: the nearest a particle comes to the sheet; water at rest nestles between
   boundary particles down to about there. BALL: the nearest it comes to any one of them, which guards ridges,
   where a mean plane lies too low. RELEASE: how fast settling lets out one that starts nearer, per step. In a run such
   a one is not let in any further, and what is pressed on it pushes it out: contact itself gives no energy. */
static const float PLANE = 0.05f, BALL = 0.2f, RELEASE = 0.005f;

/* The wall as seen from where the step would end, lengths in quanta. */
typedef struct view {
    sb_f4 normal;            /* unit, towards the side that the particle is on: mean over those in reach */
    float before, distance;  /* from the sheet along it, now and at the step's end */
    sb_f4 apart;             /* from the nearest boundary particle, at the step's end */
    float ball_before, ball; /* that distance, now and at the step's end */
    uint32_t nearest;        /* as in wall_pairs */
    bool found;
} view;

/* Four boundary particles of a list as seen from the water. */
typedef struct four_seen {
    const sb_f4 *normal[4];
    sb_f4 here[4], there[4]; /* offsets in quanta, now and at the step's end */
    sb_f4 q2, weight;        /* by lanes: (|there| / h)^2; 0 for those out of reach then, and for padding */
} four_seen;

/* Weights fall off steeply, so that in a corner the nearer wall speaks. */
SB_INLINE void see(const sb_sim *sim, size_t i, size_t first, sb_f4 step, float to_quanta, four_seen *s)
{
    const float reach = sim->constant.support / (float)sim->space.quantum;
    const uint32_t *index = sim->wall_pairs.index + first;
    sb_f4 slope;
    memcpy(&slope, sim->wall_pairs.slope + first, sizeof slope);
    for (size_t k = 0; k < 4; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, index[k]);
        const uint32_t b = sb_wall_particle(index[k]);
        s->normal[k] = &set->normal[b];
        s->here[k] = sb_offset(sim->position[i], set->record[b]);
        s->there[k] = s->here[k] + step - sb_wall_velocity(sim, index[k]) * sb_splat(to_quanta);
    }
    const sb_four at = sb_transpose(s->there[0], s->there[1], s->there[2], s->there[3]);
    s->q2 = (at.x * at.x + at.y * at.y + at.z * at.z) * sb_splat(1 / (reach * reach));
    sb_f4 weight = (sb_splat(1) - s->q2) * (sb_splat(1) - s->q2);
    weight *= weight;
    weight *= weight;
    s->weight = sb_select((s->q2 < sb_splat(1)) & (slope != (sb_f4){0}), weight, (sb_f4){0});
}

SB_INLINE view look(const sb_sim *sim, size_t i, sb_f4 velocity, float to_quanta)
{
    const size_t begin = sim->wall_pairs.first[i], end = begin + sim->wall_pairs.count[i];
    const sb_f4 step = velocity * sb_splat(to_quanta);
    sb_f4 normal = {0}, now = {0}, then = {0}, nearest = {0};
    float total = 0, least = 1;
    view v = {.found = false};
    for (size_t first = begin; first < end; first += 4) {
        four_seen s;
        see(sim, i, first, step, to_quanta, &s);
        for (size_t k = 0; k < 4; k++) {
            normal += *s.normal[k] * sb_splat(s.weight[k]);
            now += s.here[k] * sb_splat(s.weight[k]);
            then += s.there[k] * sb_splat(s.weight[k]);
            total += s.weight[k];
            if (s.weight[k] > 0 && s.q2[k] < least) {
                least = s.q2[k];
                nearest = s.here[k];
                v.apart = s.there[k];
                v.nearest = sim->wall_pairs.index[first + k];
            }
        }
    }
    float length = sqrtf(sb_sum3(normal * normal));
    if (!(length > 0.1f * total)) return v;
    v.normal = normal / sb_splat(length);
    v.before = sb_sum3(v.normal * now) / total;
    v.distance = sb_sum3(v.normal * then) / total;
    if (v.before < 0) { /* a plate's other side */
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
size_t sb_contact_resolve(const sb_sim *sim, size_t i, sb_f4 *velocity, sb_contact_push touched[SB_CONTACT_PUSHES_MAX])
{
    const float to_quanta = (float)(sim->report.time_step / sim->space.quantum);
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    const float sheet = (float)sim->scene->numerics.wall_offset;
    const float release = sim->settling ? RELEASE * spacing : 0;
    size_t count = 0;
    while (count < SB_CONTACT_PUSHES_MAX) {
        const view v = look(sim, i, *velocity, to_quanta);
        if (!v.found) break;
        float plane = smaller((sheet + PLANE) * spacing, v.before + release) - v.distance;
        float ball = smaller((sheet + BALL) * spacing, v.ball_before + release) - v.ball;
        sb_f4 change;
        if (plane > 0)
            change = v.normal * sb_splat(plane / to_quanta);
        else if (ball > 0 && v.ball > 0)
            change = v.apart * sb_splat(ball / (v.ball * to_quanta));
        else
            break;
        *velocity += change;
        touched[count++] = (sb_contact_push){v.nearest, change};
    }
    return count;
}

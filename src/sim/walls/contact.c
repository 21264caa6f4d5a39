/* Contact resolution at facets. */
#include "sim/walls/contact.h"

#include "sim/walls/mirrors.h"

#include <math.h>

/* In spacings. NEAREST: water in motion may come as near to a facet as this; at rest pressure holds it farther away.
   PASSED: a particle this far behind a facet has come from elsewhere. BEYOND: behind both facets of an edge that turns
   towards the water, a particle may be beyond both; so far each facet counts as longer there. */
static const float NEAREST = 0.1f, PASSED = 0.2f, BEYOND = 0.3f;

/* In spacings: the round-off of distances. Smaller pushes are none: they would use up the pushes of a step. */
static const float ROUGH = 1e-5f;

/* A particle and its way in this step. Lengths in quanta. */
typedef struct mover {
    sb_vec3 corner;       /* of the group */
    sb_f4 self, velocity; /* offset from the corner; m/s */
    float to_quanta, spacing, release;
} mover;

static bool turns_to_water(sb_bend bend)
{
    return bend == SB_BEND_HOLLOW || bend == SB_BEND_CONCAVE;
}

/* Whether the foot of the perpendicular from `at` (quanta) lies within the facet. */
static bool above_facet(const sb_sim *sim, const sb_mirror *mirror, sb_vec3 at)
{
    const double beyond = (double)(BEYOND * sim->constant.spacing) / sim->space.quantum;
    if (mirror->moving != UINT32_MAX) {
        const sb_moving_body *body = &sim->walls.moving[mirror->moving];
        at = sb_madd(at, -body->displacement / sim->space.quantum, body->direction);
    }
    for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
        const sb_mirror_edge *e = &sim->walls.mirrors.edge[k];
        if (sb_dot(e->inward, at) < e->distance - (turns_to_water(e->bend) ? beyond : 0)) return false;
    }
    return true;
}

/* The facets near a group. */
typedef struct planes {
    const sb_group_plane *plane;
    uint32_t count;
} planes;

static sb_vec3 place_of(const mover *m, sb_f4 offset)
{
    return sb_add(m->corner, sb_vec((double)offset[0], (double)offset[1], (double)offset[2]));
}

/* Where a particle's way in this step begins and ends before a facet. */
typedef struct approach {
    float before, after;
} approach;

static approach approach_of(const sb_sim *sim, const mover *m, const sb_group_plane *to)
{
    const sb_f4 way = (m->velocity - sb_mirror_velocity(sim, to->mirror)) * sb_splat(m->to_quanta);
    const float before = sb_sum3(to->plane * m->self) - to->plane[3];
    return (approach){before, before + sb_sum3(to->plane * way)};
}

/* Whether the surface bends away, by less than a right angle, from facet `from`, over which the particle starts, to
   facet `to`, over which it ends: the foot of its start on the first is behind the second, and the foot of its end on
   the second behind the first. At edges that turn towards the water both are before. */
static bool bends_away(const sb_group_plane *from, approach a, const sb_group_plane *to, approach b, float eps)
{
    const float along = sb_sum3(from->plane * to->plane);
    return along > 0 && b.before - a.before * along < eps && a.after - b.after * along < eps;
}

/* The facet over which a particle starts that ends over facet `to`, round an edge at which the surface bends away. Of
   several the nearest; NULL if there is none. */
static const sb_group_plane *starts_over(const sb_sim *sim, const mover *m, planes near, const sb_group_plane *to)
{
    const approach end = approach_of(sim, m, to);
    const sb_group_plane *over = NULL;
    float least = INFINITY;
    for (uint32_t p = 0; p < near.count; p++) {
        const sb_group_plane *one = &near.plane[p];
        const sb_mirror *mirror = &sim->walls.mirrors.mirror[one->mirror];
        const approach start = approach_of(sim, m, one);
        if (one == to || mirror->both || start.before <= end.before || fabsf(start.before) >= least) continue;
        if (!bends_away(one, start, to, end, ROUGH * m->spacing)) continue;
        if (!above_facet(sim, mirror, place_of(m, m->self))) continue;
        least = fabsf(start.before);
        over = one;
    }
    return over;
}

static void take(sb_facet_contact made, bool *found, sb_facet_contact *contact)
{
    if (!(fabsf(made.push) > 0) || (*found && fabsf(made.push) >= fabsf(contact->push))) return;
    *contact = made;
    *found = true;
}

/* Takes the contact of a particle that comes round an edge, from before a facet to one to whose plane it is nearer at
   the start, or behind which it starts. It is pushed along the normal of the facet that it leaves, which takes energy
   from it, as far as it needs to stay as far before the surface as it was, at most NEAREST. Returns whether it comes so
   and needs that push; if it does not, try_facet decides. */
static bool try_edge(const sb_sim *sim, const mover *m, const sb_group_plane *to, planes near, bool *found,
                     sb_facet_contact *contact)
{
    const sb_mirror *mirror = &sim->walls.mirrors.mirror[to->mirror];
    const float nearest = NEAREST * m->spacing;
    const approach end = approach_of(sim, m, to);
    if (mirror->both || end.before >= nearest || end.after >= nearest) return false;
    const float way = m->to_quanta * m->to_quanta * sb_sum3(m->velocity * m->velocity);
    if (end.before < 0 && end.before * end.before > way) return false;
    if (!above_facet(sim, mirror, place_of(m, m->self + m->velocity * sb_splat(m->to_quanta)))) return false;
    const sb_group_plane *from = starts_over(sim, m, near, to);
    if (!from) return false;
    const approach start = approach_of(sim, m, from);
    const float least = start.before < nearest ? start.before : nearest, falls = start.before - start.after;
    const float needed = (least - end.after) / sb_sum3(from->plane * to->plane), push = needed < falls ? needed : falls;
    if (!(push > ROUGH * m->spacing)) return false;
    take((sb_facet_contact){from->plane * (sb_f4){1, 1, 1, 0}, push, from->mirror}, found, contact);
    return true;
}

/* Takes the contact with a facet if there is one that takes a smaller push than *contact. plane: of the facet, its
   distance from the group's corner in the last lane. */
static void try_facet(const sb_sim *sim, const mover *m, uint32_t index, sb_f4 plane, bool *found,
                      sb_facet_contact *contact)
{
    const sb_mirror *mirror = &sim->walls.mirrors.mirror[index];
    const sb_f4 way = (m->velocity - sb_mirror_velocity(sim, index)) * sb_splat(m->to_quanta);
    float before = sb_sum3(plane * m->self) - plane[3], side = 1;
    if (mirror->both && before < 0) side = -1;
    before *= side;
    const float after = before + side * sb_sum3(plane * way);
    const float nearest = NEAREST * m->spacing;
    const float least = before + m->release < nearest ? before + m->release : nearest;
    const float push = least - after;
    if (!(push > ROUGH * m->spacing) || before < -PASSED * m->spacing) return;
    if (*found && push >= fabsf(contact->push)) return;
    if (!above_facet(sim, mirror, place_of(m, m->self + m->velocity * sb_splat(m->to_quanta)))) return;
    take((sb_facet_contact){plane * (sb_f4){1, 1, 1, 0}, side * push, index}, found, contact);
}

/* Tries a facet that is in no group's list. */
static void try_mirror(const sb_sim *sim, const mover *m, uint32_t index, bool *found, sb_facet_contact *contact)
{
    const sb_mirror *mirror = &sim->walls.mirrors.mirror[index];
    const sb_vec3 n = mirror->normal;
    double level = mirror->distance - sb_dot(n, m->corner);
    if (mirror->moving != UINT32_MAX) {
        const sb_moving_body *body = &sim->walls.moving[mirror->moving];
        level += sb_dot(n, body->direction) * body->displacement / sim->space.quantum;
    }
    try_facet(sim, m, index, (sb_f4){(float)n.x, (float)n.y, (float)n.z, (float)level}, found, contact);
}

bool sb_contact_possible(const sb_sim *sim, const sb_group *group, size_t i)
{
    return sim->needs.images ? group->planes > 0 : sim->work.wall_pairs.count[i] > 0;
}

bool sb_contact_find(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 velocity, sb_facet_contact *contact)
{
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    const sb_record from = group->corner;
    const mover m = {.corner = sb_vec((double)from[0], (double)from[1], (double)from[2]),
                     .self = sb_offset(sim->state.position[i], from),
                     .velocity = velocity,
                     .to_quanta = (float)(sim->state.time_step / sim->space.quantum),
                     .spacing = spacing,
                     .release = sim->policy->release * spacing};
    bool found = false;
    const planes near = {sim->groups.plane + group->plane, sim->needs.images ? group->planes : 0};
    for (uint32_t p = 0; p < near.count; p++)
        if (!try_edge(sim, &m, &near.plane[p], near, &found, contact))
            try_facet(sim, &m, near.plane[p].mirror, near.plane[p].plane, &found, contact);
    if (sim->needs.images) return found;
    const sb_mirrors *mirrors = &sim->walls.mirrors;
    size_t end, at = sb_mirrors_of_block(sim, sim->state.position[i], &end);
    for (; at < end; at++) try_mirror(sim, &m, mirrors->entry[at].mirror, &found, contact);
    for (size_t k = 0; k < mirrors->moving_count; k++) try_mirror(sim, &m, mirrors->moving[k], &found, contact);
    return found;
}

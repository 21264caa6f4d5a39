/* Contact resolution at facets. */
#include "sim/walls/contact.h"

#include "sim/walls/mirrors.h"

#include <math.h>

/* In spacings. NEAREST: water in motion may come as near to a facet as this; at rest pressure holds it farther away.
   PASSED: a particle this far behind a facet has come from elsewhere. BEYOND: behind both facets of an edge that turns
   towards the water, a particle may be beyond both; so far each facet counts as longer there. */
static const float NEAREST = 0.1f, PASSED = 0.2f, BEYOND = 0.3f;

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
    if (!(push > 0) || before < -PASSED * m->spacing || (*found && push >= fabsf(contact->push))) return;
    const sb_f4 end = m->self + m->velocity * sb_splat(m->to_quanta);
    if (!above_facet(sim, mirror, sb_add(m->corner, sb_vec((double)end[0], (double)end[1], (double)end[2])))) return;
    *contact = (sb_facet_contact){plane * (sb_f4){1, 1, 1, 0}, side * push, index};
    *found = true;
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
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    for (uint32_t p = 0; sim->needs.images && p < group->planes; p++)
        try_facet(sim, &m, planes[p].mirror, planes[p].plane, &found, contact);
    if (sim->needs.images) return found;
    const sb_mirrors *mirrors = &sim->walls.mirrors;
    size_t end, at = sb_mirrors_of_block(sim, sim->state.position[i], &end);
    for (; at < end; at++) try_mirror(sim, &m, mirrors->entry[at].mirror, &found, contact);
    for (size_t k = 0; k < mirrors->moving_count; k++) try_mirror(sim, &m, mirrors->moving[k], &found, contact);
    return found;
}

/* Contact resolution at facets. */
#include "sim/walls/mirrors.h"

#include <math.h>

/* In spacings. NEAREST: water in motion may come as near to a facet as this; at rest images hold it farther away.
   PASSED: a particle this far behind a facet has come from elsewhere. BEYOND: behind both facets of an edge that turns
   towards the water, a particle may be beyond both; so far each facet counts as longer there. */
static const float NEAREST = 0.1f, PASSED = 0.2f, BEYOND = 0.3f;

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

bool sb_mirrors_contact(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 velocity, sb_facet_contact *contact)
{
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    const float to_quanta = (float)(sim->state.time_step / sim->space.quantum);
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    const float release = sim->policy->release * spacing;
    const sb_f4 self = sb_offset(sim->state.position[i], group->corner);
    bool found = false;
    for (uint32_t p = 0; p < group->planes; p++) {
        const sb_f4 plane = planes[p].plane;
        const sb_mirror *mirror = &sim->walls.mirrors.mirror[planes[p].mirror];
        const sb_f4 way = (velocity - sb_mirror_velocity(sim, planes[p].mirror)) * sb_splat(to_quanta);
        float before = sb_sum3(plane * self) - plane[3], side = 1;
        if (mirror->both && before < 0) side = -1;
        before *= side;
        const float after = before + side * sb_sum3(plane * way);
        const float least = before + release < NEAREST * spacing ? before + release : NEAREST * spacing;
        const float push = least - after;
        if (!(push > 0) || before < -PASSED * spacing || (found && push >= fabsf(contact->push))) continue;
        const sb_f4 end = self + velocity * sb_splat(to_quanta);
        const sb_vec3 at = sb_vec((double)group->corner[0] + (double)end[0], (double)group->corner[1] + (double)end[1],
                                  (double)group->corner[2] + (double)end[2]);
        if (!above_facet(sim, mirror, at)) continue;
        *contact = (sb_facet_contact){p, side * push};
        found = true;
    }
    return found;
}

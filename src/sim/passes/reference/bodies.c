/* The forces of the water on bodies: the reaction of every wall pair, one at a time, on one thread. */
#include "sim/passes/cpu/body_forces.h"
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"
#include "sim/step/ledger.h"
#include "sim/walls/contact.h"
#include "sim/walls/mirrors.h"

#include <string.h>

/* A force by pressure or contact, and one by drag, on a body. at: m. */
static void act_on(const sb_sim *sim, uint32_t body, sb_vec3 at, sb_vec3 pressure, sb_vec3 drag, double *force)
{
    const sb_vec3 arm = sb_sub(at, sim->model->bodies[body].moment_point);
    const sb_vec3 moment = sb_cross(arm, sb_add(pressure, drag));
    const double values[SB_FORCE_VALUES] = {pressure.x, pressure.y, pressure.z, drag.x,  drag.y,
                                            drag.z,     moment.x,   moment.y,   moment.z};
    for (int v = 0; v < SB_FORCE_VALUES; v++) force[(size_t)body * SB_FORCE_VALUES + (size_t)v] += values[v];
}

/* The same of fluid particle i on the body of a wall entry. It acts at the particle, shifted by whole periods to the
   original if the entry is an image. */
static void act(const sb_sim *sim, size_t i, uint32_t entry, sb_vec3 pressure, sb_vec3 drag, double *force)
{
    const sb_space *space = &sim->space;
    const sb_record record = sb_wall_set_of(sim, entry)->record[sb_wall_particle(entry)];
    const sb_vec3 shift =
        sb_sub(sb_space_position(space, sb_space_wrap(space, record)), sb_space_position(space, record));
    const sb_vec3 at = sb_add(sb_space_position(space, sim->state.position[i]), shift);
    act_on(sim, sb_wall_body(sim, entry), at, pressure, drag, force);
}

/* ---- images ---- */

/* The force `along` times m along a facet's normal. */
static void push_facet(const sb_sim *sim, uint32_t mirror, sb_f4 normal, sb_vec3 at, double along, double *force)
{
    const sb_vec3 push = sb_scale(sb_vector_of(normal), (double)sim->constant.mass * along);
    act_on(sim, sb_mirror_body(sim, mirror), sb_add(at, sb_mirror_shift(sim, mirror)), push, (sb_vec3){0}, force);
}

static void push_plane(const sb_sim *sim, const sb_group_plane *plane, sb_vec3 at, double along, double *force)
{
    push_facet(sim, plane->mirror, plane->plane, at, along, force);
}

void sb_plain_reflect(const sb_sim *sim, const sb_indices *indices, uint32_t path, sb_vec3 at, sb_vec3 a, double *force)
{
    const sb_group_plane *plane[SB_REFLECTIONS_MAX];
    const int count = sb_path_planes(indices, path, plane);
    for (int k = count; k-- > 0;) { /* from the particle on: the last reflection of the image first */
        const sb_vec3 n = sb_vector_of(plane[k]->plane);
        const double along = sb_dot(n, a);
        push_plane(sim, plane[k], at, -along, force);
        a = sb_madd(a, -2 * along, n);
    }
}

/* The reactions to the hydrostatic part of an image's pressure: each plane of the path takes the acceleration `a` per
   quantum times the part of the head that it adds. from: quanta from the corner, the original. */
static void take_head(const sb_sim *sim, const sb_indices *indices, uint32_t path, sb_vec3 at, sb_vec3 from, sb_vec3 a,
                      double *force)
{
    const sb_group_plane *plane[SB_REFLECTIONS_MAX];
    const int count = sb_path_planes(indices, path, plane);
    for (int k = 0; k < count; k++) {
        const uint32_t mirror = plane[k]->mirror;
        const sb_vec3 n = sb_vector_of(plane[k]->plane);
        const sb_vec3 to = sb_madd(from, -2 * (sb_dot(n, from) - (double)plane[k]->plane[3]), n);
        act_on(sim, sb_mirror_body(sim, mirror), sb_add(at, sb_mirror_shift(sim, mirror)),
               sb_scale(a, -(double)sim->constant.mass * (from.z - to.z)), (sb_vec3){0}, force);
        from = to;
    }
}

static double unknown_of(const sb_sim *sim, uint32_t entry)
{
    return (double)sim->work.unknown[sb_entry_owner(sim, entry)];
}

/* Pressure on walls by pairs of particle i with images, and by its pairs at edges. */
static void react_images(const sb_sim *sim, const sb_indices *around, size_t i, double *force)
{
    const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
    const double own = (double)sim->work.unknown[i], hydrostatic = (double)sb_hydrostatic(sim);
    for (size_t k = sb_direct_count(sim, i); k < sb_pair_count(sim, i); k++) {
        const sb_one_pair p = sb_pair_at(sim, around, i, k);
        if (p.slope == 0) continue;
        const sb_vec3 from = sb_offset_of(sim->state.position[p.other], around->corner);
        sb_plain_reflect(sim, around, p.path, at, sb_scale(p.offset, -p.slope * (own + unknown_of(sim, p.other))),
                         force);
        take_head(sim, around, p.path, at, from, sb_scale(p.offset, -p.slope * hydrostatic), force);
    }
    for (size_t k = 0; k < sb_edge_count(sim, i); k++) {
        const sb_edge_pair *e = sb_edge_at(sim, i, k);
        const double q = own + unknown_of(sim, e->entry);
        const sb_vec3 pull =
            sb_madd(sb_scale(sb_vector_of(sb_edge_own(e)), q), hydrostatic, sb_vector_of(sb_edge_head(e)));
        act_on(sim, sb_mirror_body(sim, e->mirror), sb_add(at, sb_mirror_shift(sim, e->mirror)),
               sb_scale(pull, (double)sim->constant.mass), (sb_vec3){0}, force);
    }
}

/* Contact with facets. */
static void contact(sb_sim *sim, const sb_group *group, size_t i, sb_body_sums *total)
{
    const sb_f4 start = sb_ledger_start(sim, i), before = sim->work.end_velocity[i];
    const double dt = sim->state.time_step;
    const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
    sb_f4 velocity = before;
    sb_facet_contact c;
    for (int k = 0; k < SB_CONTACT_PUSHES_MAX && sb_contact_find(sim, group, i, velocity, &c); k++) {
        const double along = (double)c.push * sim->space.quantum / dt;
        const sb_vec3 change = sb_scale(sb_vector_of(c.normal), along);
        push_facet(sim, c.mirror, c.normal, at, -along / dt, total->force);
        total->contact_bodies += sb_dot(change, sb_vector_of(sb_mirror_velocity(sim, c.mirror)));
        velocity += (sb_f4){(float)change.x, (float)change.y, (float)change.z, 0};
    }
    total->contact += sb_ledger_work(before, velocity, start, velocity);
    velocity[3] = before[3];
    sim->work.end_velocity[i] = velocity;
}

/* ---- boundary particles ---- */

/* Pressure and drag of particle i. */
static void react(sb_sim *sim, size_t i, const sb_wall_drag *law, sb_body_sums *total)
{
    const double mass = (double)sim->constant.mass, q = sim->needs.images ? 0 : (double)sim->work.unknown[i];
    sb_vec3 drag = {0};
    sb_one_wall walls[SB_PLAIN_WALLS_MAX];
    const size_t count = sb_plain_walls(sim, i, walls);
    for (const sb_one_wall *wall = walls; wall < walls + count; wall++) {
        const sb_vec3 own = law->on ? sb_plain_drag(sim, i, wall, law) : (sb_vec3){0};
        drag = sb_add(drag, own);
        act(sim, i, wall->entry, sb_scale(wall->offset, mass * q * wall->slope), sb_scale(own, -mass), total->force);
    }
    const sb_vec3 both = sb_add(sb_vector_of(sb_ledger_start(sim, i)), sb_vector_of(sim->work.end_velocity[i]));
    if (law->on) total->friction += 0.5 * sb_dot(drag, both);
}

int sb_plain_bodies(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total)
{
    memset(total->force, 0, sim->model->body_count * SB_FORCE_VALUES * sizeof *total->force);
    total->friction = total->contact = total->contact_bodies = 0;
    for (size_t g = 0; g < sim->groups.count; g++) {
        const sb_group *group = &sim->groups.group[g];
        sb_indices around;
        sb_indices_of(sim, group, &around);
        for (size_t i = group->first; i < group->end; i++) {
            if (sim->needs.images) react_images(sim, &around, i, total->force);
            if (sb_contact_possible(sim, group, i)) contact(sim, group, i, total);
            react(sim, i, law, total);
        }
    }
    return 0;
}

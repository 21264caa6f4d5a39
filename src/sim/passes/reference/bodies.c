/* The forces of the water on bodies: the reaction of every wall pair, one at a time, on one thread. */
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"
#include "sim/step/ledger.h"
#include "sim/walls/contact.h"

#include <string.h>

/* A force by pressure or contact, and one by drag, of fluid particle i on the body of a wall entry. It acts at the
   particle, shifted by whole periods to the original if the entry is an image. */
static void act(const sb_sim *sim, size_t i, uint32_t entry, sb_vec3 pressure, sb_vec3 drag, double *force)
{
    const sb_space *space = &sim->space;
    const sb_record record = sb_wall_set_of(sim, entry)->record[sb_wall_particle(entry)];
    const sb_vec3 shift =
        sb_sub(sb_space_position(space, sb_space_wrap(space, record)), sb_space_position(space, record));
    const sb_vec3 at = sb_add(sb_space_position(space, sim->state.position[i]), shift);
    const uint32_t body = sb_wall_body(sim, entry);
    const sb_vec3 arm = sb_sub(at, sim->model->bodies[body].moment_point);
    const sb_vec3 moment = sb_cross(arm, sb_add(pressure, drag));
    const double values[SB_FORCE_VALUES] = {pressure.x, pressure.y, pressure.z, drag.x,  drag.y,
                                            drag.z,     moment.x,   moment.y,   moment.z};
    for (int v = 0; v < SB_FORCE_VALUES; v++) force[(size_t)body * SB_FORCE_VALUES + (size_t)v] += values[v];
}

/* Pressure and drag of particle i. */
static void react(sb_sim *sim, size_t i, const sb_wall_drag *law, sb_body_sums *total)
{
    const double mass = (double)sim->constant.mass, q = (double)sim->work.unknown[i];
    sb_vec3 drag = {0};
    for (size_t k = 0; k < sim->work.wall_pairs.count[i]; k++) {
        const sb_one_wall wall = sb_wall_at(sim, i, k);
        const sb_vec3 own = law->on ? sb_plain_drag(sim, i, &wall, law) : (sb_vec3){0};
        drag = sb_add(drag, own);
        act(sim, i, wall.entry, sb_scale(wall.offset, mass * q * wall.slope), sb_scale(own, -mass), total->force);
    }
    const sb_vec3 both = sb_add(sb_vector_of(sim->state.velocity[i]), sb_vector_of(sim->work.end_velocity[i]));
    if (law->on) total->friction += 0.5 * sb_dot(drag, both);
}

static void contact(sb_sim *sim, size_t i, sb_body_sums *total)
{
    const sb_f4 start = sim->state.velocity[i], before = sim->work.end_velocity[i];
    sb_contact_push pushes[SB_CONTACT_PUSHES_MAX];
    sb_f4 velocity = before;
    const size_t count = sb_contact_resolve(sim, i, &velocity, pushes);
    const double scale = -(double)sim->constant.mass / sim->state.time_step;
    if (count == 0) return;
    for (size_t k = 0; k < count; k++) {
        const sb_vec3 change = sb_vector_of(pushes[k].change);
        act(sim, i, pushes[k].wall, sb_scale(change, scale), (sb_vec3){0}, total->force);
        total->contact_bodies += sb_dot(change, sb_vector_of(sb_wall_velocity(sim, pushes[k].wall)));
    }
    total->contact += sb_ledger_work(before, velocity, start, velocity);
    velocity[3] = before[3];
    sim->work.end_velocity[i] = velocity;
}

int sb_plain_bodies(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total)
{
    memset(total->force, 0, sim->model->body_count * SB_FORCE_VALUES * sizeof *total->force);
    total->friction = total->contact = total->contact_bodies = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        contact(sim, i, total);
        react(sim, i, law, total);
    }
    return 0;
}

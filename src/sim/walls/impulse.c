/* Forces of the water on bodies over one step: the reaction to every wall term that accelerated the water
   [A12, eq. 10]. The momenta of water and bodies therefore balance to round-off. */
#include "sim/passes/passes.h"
#include "sim/step/stages.h"
#include "sim/walls/pushes.h"

/* Adds a force's values over dt (s) to a body's impulse. */
static void add_impulse(sb_body_impulse *total, double dt, const double *s)
{
    total->pressure = sb_madd(total->pressure, dt, sb_vec(s[0], s[1], s[2]));
    total->friction = sb_madd(total->friction, dt, sb_vec(s[3], s[4], s[5]));
    total->moment = sb_madd(total->moment, dt, sb_vec(s[6], s[7], s[8]));
}

sb_status sb_stage_impulse(sb_sim *sim, sb_error *error)
{
    const size_t bodies = sim->model->body_count;
    const sb_wall_drag law = sb_wall_drag_make(sim);
    sb_body_sums sums = {.force = sim->work.body_force};
    if (sim->passes->bodies(sim, &law, &sums) != 0) return sb_fail_memory(error, "forces on bodies");
    if (sb_pushes_share(sim) != 0) return sb_fail_memory(error, "forces on walls");
    if (sim->needs.images || sim->needs.dynamic_walls)
        for (size_t v = 0; v < bodies * SB_FORCE_VALUES; v++) sim->work.body_force[v] += sim->work.stress_force[v];
    sim->work.sums.friction = sums.friction;
    sim->work.sums.contact = sums.contact;
    sim->work.sums.contact_bodies = sums.contact_bodies;
    if (!sim->policy->runs) return SB_OK;
    for (size_t body = 0; body < bodies; body++)
        add_impulse(&sim->state.impulse[sb_model_whole(sim->model, body)], sim->state.time_step,
                    sim->work.body_force + body * SB_FORCE_VALUES);
    return SB_OK;
}

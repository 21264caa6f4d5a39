/* Motion of bodies: where wave makers and absorption place them, and the tables of their boundary particles, which are
   rebuilt only while they move. */
#include "sim/step/stages.h"
#include "sim/walls/absorber.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/walls.h"

#include <math.h>

/* Places the moving set at the bodies' present displacements. Boundary particles that have left the grid of cells (a
   gate pulled out of the domain) meet no water and are left out. */
static void place(sb_sim *sim)
{
    sb_wall_set *set = &sim->walls.set[SB_MOVING];
    set->count = 0;
    for (size_t i = 0; i < sim->walls.rest.count; i++) {
        const sb_moving_body *moving = &sim->walls.moving[sim->walls.moving_of_body[sim->walls.rest.body[i]]];
        sb_vec3 shift = sb_scale(moving->direction, moving->displacement / sim->space.quantum);
        if (!(sb_norm(shift) < SB_POSITION_END)) continue;
        sb_record step = {(uint32_t)(int32_t)nearbyint(shift.x), (uint32_t)(int32_t)nearbyint(shift.y),
                          (uint32_t)(int32_t)nearbyint(shift.z), 0};
        sb_record placed = sim->walls.rest.record[i] + step;
        if (!sb_space_inside(&sim->space, placed)) continue;
        sb_carry(&placed, sb_carried_value(sim->walls.rest.record[i]));
        set->record[set->count] = placed;
        set->facing[set->count] = sim->walls.rest.facing[i];
        if (set->number) set->number[set->count] = sim->walls.rest.number[i];
        set->body[set->count++] = sim->walls.rest.body[i];
    }
}

/* Evaluates the laws at the step's begin and end. Nothing moves while the water settles. */
static void evaluate_laws(sb_sim *sim)
{
    const double time = sim->state.time, dt = sim->state.time_step;
    for (size_t w = 0; w < sim->scene->wavemaker_count; w++) {
        sb_moving_law *law = &sim->walls.laws[w];
        const sb_paddle *paddle = &law->paddle;
        if (!paddle->kind) continue;
        law->here = sim->policy->runs ? sb_paddle_displacement(paddle, time) : 0;
        law->there = sim->policy->runs ? sb_paddle_displacement(paddle, time + dt) : 0;
        if (sim->policy->runs && law->filter.gain > 0)
            law->surface = paddle->kind->surface(paddle->state, time - paddle->start);
    }
}

sb_status sb_stage_walls(sb_sim *sim, sb_error *error)
{
    const double dt = sim->state.time_step;
    bool moved = false;
    evaluate_laws(sim);
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        double here = moving->share * moving->law->here;
        const double there = moving->share * moving->law->there;
        if (moving->absorber) here += moving->absorber->state.offset;
        moved |= here != moving->displacement;
        moving->displacement = here;
        moving->next_displacement = there;
    }
    if (sim->policy->runs && sb_absorbers_measure(sim) != 0) return sb_fail_memory(error, "absorbing paddles");
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        if (moving->absorber && sim->policy->runs) moving->next_displacement += sb_absorber_advance(sim, moving);
        moving->velocity = sb_scale(moving->direction, (moving->next_displacement - moving->displacement) / dt);
    }
    return moved ? sb_walls_restore(sim, error) : SB_OK;
}

sb_status sb_sim_trigger(sb_sim *sim, size_t wavemaker, sb_error *error)
{
    const char *name = sim->scene->wavemakers[wavemaker].name;
    if (sim->state.settle.under_way)
        return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": the water settles, expected a command after that",
                       name);
    sb_paddle *paddle = &sim->walls.laws[wavemaker].paddle;
    if (!paddle->kind) return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": moves no body", name);
    if (isfinite(paddle->start))
        return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": its motion began or begins at t = %.17g s", name,
                       paddle->start);
    paddle->start = sim->state.time;
    return SB_OK;
}

sb_status sb_walls_restore(sb_sim *sim, sb_error *error)
{
    if (sim->walls.moving_count == 0) return SB_OK;
    place(sim);
    sb_mirrors_list_moving(sim);
    if (sb_walls_table(&sim->walls.set[SB_MOVING], &sim->space) != 0 ||
        sb_walls_near_build(&sim->walls.set[SB_MOVING], &sim->space) != 0)
        return sb_fail_memory(error, "moving boundary particles");
    return SB_OK;
}

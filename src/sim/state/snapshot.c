/* Frames for consumers. */
#include "base/memory.h"
#include "sim/foam/foam.h"
#include "sim/state/gather.h"
#include "sim/state/particle.h"

#include <stdio.h>

/* Density sums do not exist before the first step. */
static float density_error(const sb_sim *sim, float density)
{
    return sim->work.lists_current ? density / sim->constant.rest_density - 1 : 0;
}

/* NULL without memory. */
static sb_frame *create_frame(const sb_sim *sim, size_t count)
{
    sb_frame *frame = sb_frame_create(count, sim->model->body_count);
    if (frame && sb_scene_shows_density_error(sim->scene) && !sb_frame_add_density_error(frame)) {
        sb_frame_release(frame);
        return NULL;
    }
    return frame;
}

static void fill_particles(const sb_sim *sim, sb_frame *frame)
{
    const sb_vec3 shift = sb_sub(sim->space.origin, sim->model->min);
    const double quantum = sim->space.quantum;
    const size_t count = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++) {
        const sb_particle p = sb_particle_at(sim, i);
        sb_record x = sb_space_wrap(&sim->space, p.position);
        frame->position[3 * i] = (float)(x[0] * quantum + shift.x);
        frame->position[3 * i + 1] = (float)(x[1] * quantum + shift.y);
        frame->position[3 * i + 2] = (float)(x[2] * quantum + shift.z);
        for (size_t axis = 0; axis < 3; axis++) frame->velocity[3 * i + axis] = p.velocity[axis];
        frame->pressure[i] = p.pressure;
        frame->id[i] = p.id;
        if (frame->density_error) frame->density_error[i] = density_error(sim, p.density);
    }
}

static void fill_bodies(const sb_sim *sim, sb_frame *frame)
{
    const sb_model *model = sim->model;
    for (size_t b = 0; b < model->body_count; b++) {
        sb_frame_body *body = &frame->bodies[b];
        snprintf(body->name, sizeof body->name, "%s", model->bodies[b].name);
        body->displacement = sb_sim_body_displacement(sim, b);
        const uint32_t m = sim->walls.moving_of_body[b];
        if (m != UINT32_MAX) body->velocity = sim->walls.moving[m].velocity;
        body->report = model->bodies[b].report;
    }
}

static void fill_status(const sb_sim *sim, sb_frame *frame)
{
    frame->origin = sim->model->min;
    frame->spacing = sim->scene->resolution;
    frame->status = (sb_frame_status){
        .step = sim->state.step,
        .time = sim->state.time,
        .duration = sim->scene->duration,
        .time_step = sim->state.time_step,
        .iterations = sim->state.sweeps,
        .density_error = sim->report.error_mean,
        .max_speed = sim->state.max_speed,
        .lost_particles = sim->state.lost,
    };
}

/* Gathers the frames of all domains in that of the first; `all` is empty in the others. */
static void gather(const sb_sim *sim, const sb_shares *shares, sb_frame *own, sb_frame *all)
{
    enum { VECTOR = 3 * sizeof(float) };
    sb_gather_first(sim, shares, own->position, VECTOR, all->position);
    sb_gather_first(sim, shares, own->velocity, VECTOR, all->velocity);
    sb_gather_first(sim, shares, own->pressure, sizeof *own->pressure, all->pressure);
    sb_gather_first(sim, shares, own->id, sizeof *own->id, all->id);
    if (own->density_error)
        sb_gather_first(sim, shares, own->density_error, sizeof *own->density_error, all->density_error);
}

/* NULL without memory in any domain. */
static sb_frame *snapshot_of_all(const sb_sim *sim)
{
    sb_shares shares;
    sb_gather_shares(sim, &shares);
    const bool first = sb_ranks_own(sim->ranks) == 0;
    sb_frame *own = create_frame(sim, sim->state.n), *all = create_frame(sim, first ? (size_t)shares.all : 0);
    if (sb_ranks_any(sim->ranks, !own || !all)) {
        sb_frame_release(all);
        all = NULL;
    } else {
        fill_particles(sim, own);
        gather(sim, &shares, own, all);
    }
    const bool failed = all && first && sb_foam_fill(sim, all) != 0;
    if (sim->foam && sb_ranks_any(sim->ranks, failed)) {
        sb_frame_release(all);
        all = NULL;
    }
    sb_frame_release(own);
    return all;
}

/* NULL without memory. */
static sb_frame *snapshot_of_own(const sb_sim *sim)
{
    sb_frame *frame = create_frame(sim, sim->state.n);
    if (frame && sb_ranks_own(sim->ranks) == 0 && sb_foam_fill(sim, frame) != 0) {
        sb_frame_release(frame);
        return NULL;
    }
    if (frame) fill_particles(sim, frame);
    return frame;
}

static sb_frame *complete(const sb_sim *sim, sb_frame *frame)
{
    if (!frame) return NULL;
    fill_bodies(sim, frame);
    fill_status(sim, frame);
    return frame;
}

sb_frame *sb_sim_snapshot(const sb_sim *sim)
{
    return complete(sim, sb_ranks_several(sim->ranks) ? snapshot_of_all(sim) : snapshot_of_own(sim));
}

sb_frame *sb_sim_snapshot_own(const sb_sim *sim)
{
    return complete(sim, snapshot_of_own(sim));
}

#include "state.h"

#include "base/clock.h"

#include <math.h>
#include <string.h>

#define SAMPLE_SPACING 0.125 /* s; 16 of them are the 2 s of the rates */

void sb_monitor_state_start(sb_monitor_state *state, double now)
{
    memset(state, 0, sizeof *state);
    state->started = state->last_data = now;
    state->samples[0].time = now;
    state->sample_count = 1;
}

void sb_monitor_on_restart(void *user, int64_t run_id)
{
    (void)run_id;
    sb_monitor_state *state = user;
    state->has_status = state->has_forces = state->has_frame = state->per_metre = false;
    state->statuses = 0;
    state->body_count = state->bodies_total = state->gauge_count = state->gauges_total = 0;
    state->peak = 0;
    memset(state->course, 0, sizeof state->course);
    memset(state->highest, 0, sizeof state->highest);
}

void sb_monitor_on_scene(void *user, const sb_live_scene *scene)
{
    sb_monitor_state *state = user;
    state->per_metre = scene->dimensions == 2;
    state->last_data = sb_clock();
}

/* The run time of a step since the last status, for each stage that both have. */
static void note_stages(sb_monitor_state *state, const sb_status_message *message)
{
    const sb_status_message *before = &state->status;
    const double steps = (double)(message->step - before->step);
    for (int i = 0; i < message->stage_count; i++) {
        const double spent = message->stage_seconds[i] - before->stage_seconds[i];
        const bool same = state->has_status && i < before->stage_count && steps > 0 && spent >= 0 &&
                          strcmp(message->stages[i], before->stages[i]) == 0;
        if (same)
            state->stage_step[i] = spent / steps;
        else if (!state->has_status || message->step != before->step)
            state->stage_step[i] = -1;
    }
}

static void note_quantities(sb_monitor_state *state, const sb_status_message *message)
{
    const double value[SB_QUANTITIES] = {message->iterations, message->density_error, message->density_error_max,
                                         message->time_step, message->max_speed};
    memcpy(state->value, value, sizeof value);
    for (int i = 0; i < SB_QUANTITIES; i++) {
        state->highest[i] = fmax(state->highest[i], value[i]);
        if (message->state == SB_RUN_RUNNING) sb_history_add(&state->course[i], value[i]); /* a pause repeats values */
    }
}

void sb_monitor_on_status(void *user, const sb_status_message *message)
{
    sb_monitor_state *state = user;
    note_stages(state, message);
    note_quantities(state, message);
    state->status = *message;
    state->has_status = true;
    state->statuses++;
    state->last_data = sb_clock();
}

static void note_force(sb_monitor_state *state, sb_monitor_body *body, const double force[3], double time)
{
    memcpy(body->force, force, sizeof body->force);
    body->horizontal = hypot(force[0], force[1]);
    if (body->course.count == 0 || body->horizontal > body->peak) {
        body->peak = body->horizontal;
        body->peak_time = time;
    }
    sb_history_add(&body->course, body->horizontal);
    state->peak = fmax(state->peak, fmax(body->horizontal, fabs(force[2])));
}

void sb_monitor_on_forces(void *user, const sb_forces_message *message)
{
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
    state->bodies_total = (size_t)message->total;
    if (!state->has_forces) state->forces_since = message->time;
    state->has_forces = true;
    const size_t first = (size_t)message->first, count = (size_t)message->count;
    for (size_t i = 0; i < count && first + i < SB_MONITOR_ROWS; i++) {
        const size_t row = first + i;
        sb_monitor_body *body = &state->bodies[row];
        if (row >= state->body_count || strcmp(body->name, message->names[i]) != 0) *body = (sb_monitor_body){0};
        memcpy(body->name, message->names[i], sizeof body->name);
        note_force(state, body, &message->force[3 * i], message->time);
        /* The rows before this one belong to a lost message. They stay empty until it is sent again. */
        while (state->body_count < row) state->bodies[state->body_count++] = (sb_monitor_body){0};
        if (state->body_count == row) state->body_count = row + 1;
    }
}

static void note_elevation(sb_monitor_gauge *gauge, bool wet, double eta, double z)
{
    gauge->wet = wet;
    gauge->eta = eta;
    gauge->z = z;
    if (!wet) return;
    gauge->eta_low = gauge->seen ? fmin(gauge->eta_low, eta) : eta;
    gauge->eta_high = gauge->seen ? fmax(gauge->eta_high, eta) : eta;
    gauge->seen = true;
    sb_history_add(&gauge->course, eta);
}

void sb_monitor_on_gauges(void *user, const sb_gauges_message *message)
{
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
    state->gauges_total = (size_t)message->total;
    const size_t first = (size_t)message->first, count = (size_t)message->count;
    for (size_t i = 0; i < count && first + i < SB_MONITOR_ROWS; i++) {
        const size_t row = first + i;
        sb_monitor_gauge *gauge = &state->gauges[row];
        if (row >= state->gauge_count || strcmp(gauge->name, message->names[i]) != 0) *gauge = (sb_monitor_gauge){0};
        memcpy(gauge->name, message->names[i], sizeof gauge->name);
        note_elevation(gauge, message->wet[i] != 0, message->eta[i], message->z[i]);
        while (state->gauge_count < row) state->gauges[state->gauge_count++] = (sb_monitor_gauge){0};
        if (state->gauge_count == row) state->gauge_count = row + 1;
    }
}

void sb_monitor_on_part(void *user, const sb_frame_message *message)
{
    (void)message;
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
}

void sb_monitor_on_frame(void *user, const sb_live_frame *frame)
{
    sb_monitor_state *state = user;
    state->frame_time = frame->time;
    state->frame_particles = frame->count;
    state->has_frame = true;
}

void sb_monitor_state_sample(sb_monitor_state *state, sb_live_counts count, double now)
{
    size_t used = state->sample_count;
    state->count = count;
    double span = now - state->samples[0].time;
    if (span > 0) {
        state->message_rate = (double)(count.messages - state->samples[0].count.messages) / span;
        state->byte_rate = (double)(count.bytes - state->samples[0].count.bytes) / span;
    }
    if (now - state->samples[used - 1].time < SAMPLE_SPACING) return;
    if (used == SB_MONITOR_SAMPLES) memmove(&state->samples[0], &state->samples[1], sizeof state->samples[0] * --used);
    state->samples[used].time = now;
    state->samples[used].count = count;
    state->sample_count = used + 1;
}

double sb_monitor_state_lost(const sb_monitor_state *state)
{
    const sb_live_counts *count = &state->count;
    const double valid = (double)(count->messages - count->refused - count->foreign);
    return count->lost > 0 ? (double)count->lost / ((double)count->lost + valid) : 0;
}

double sb_monitor_state_progress(const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    const double share = state->has_status && status->duration > 0 ? status->time / status->duration : 0;
    return share > 1 ? 1 : share > 0 ? share : 0;
}

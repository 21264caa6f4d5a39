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
    state->body_count = state->bodies_total = 0;
    state->peak = state->peak_component = 0;
    state->statuses = 0;
}

void sb_monitor_on_status(void *user, const sb_status_message *message)
{
    sb_monitor_state *state = user;
    state->status = *message;
    state->has_status = true;
    state->statuses++;
    state->last_data = sb_clock();
}

static void note_force(sb_monitor_state *state, sb_monitor_body *body, const double force[3])
{
    memcpy(body->force, force, sizeof body->force);
    body->horizontal = hypot(force[0], force[1]);
    body->peak = fmax(body->peak, body->horizontal);
    state->peak = fmax(state->peak, body->horizontal);
    for (int k = 0; k < 3; k++) state->peak_component = fmax(state->peak_component, fabs(force[k]));
}

void sb_monitor_on_forces(void *user, const sb_forces_message *message)
{
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
    state->bodies_total = (size_t)message->total;
    const size_t first = (size_t)message->first, count = (size_t)message->count;
    for (size_t i = 0; i < count && first + i < SB_MONITOR_BODIES; i++) {
        const size_t row = first + i;
        sb_monitor_body *body = &state->bodies[row];
        if (row >= state->body_count || strcmp(body->name, message->names[i]) != 0) *body = (sb_monitor_body){0};
        memcpy(body->name, message->names[i], sizeof body->name);
        note_force(state, body, &message->force[3 * i]);
        /* The rows before this one belong to a lost message. They stay empty until it is sent again. */
        while (state->body_count < row) state->bodies[state->body_count++] = (sb_monitor_body){0};
        if (state->body_count == row) state->body_count = row + 1;
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

#include "state.h"

#include "base/clock.h"

#include <math.h>
#include <string.h>

#define SAMPLE_SPACING 0.125 /* s; 16 of them are the 2 s of the rates */

void sb_monitor_state_start(sb_monitor_state *state, double now)
{
    sb_monitor_state_free(state);
    memset(state, 0, sizeof *state);
    state->started = state->last_data = now;
    state->samples[0].time = now;
    state->sample_count = 1;
}

void sb_monitor_state_free(sb_monitor_state *state)
{
    sb_assembly_free(&state->assembly);
}

static void new_run(sb_monitor_state *state)
{
    state->body_count = state->bodies_total = 0;
    state->peak = state->peak_component = 0;
    state->statuses = 0;
    sb_assembly_free(&state->assembly);
}

void sb_monitor_on_status(void *user, const sb_status_message *message)
{
    sb_monitor_state *state = user;
    if (state->has_status && (strcmp(state->status.run, message->run) != 0 || message->step < state->status.step))
        new_run(state);
    state->status = *message;
    state->has_status = true;
    state->statuses++;
    state->last_data = sb_clock();
}

void sb_monitor_on_forces(void *user, const sb_forces_message *message)
{
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
    state->bodies_total = (size_t)message->total;
    const size_t first = (size_t)message->first, count = (size_t)message->count;
    for (size_t i = 0; i < count && first + i < SB_MONITOR_BODIES; i++) {
        size_t row = first + i;
        sb_monitor_body *body = &state->bodies[row];
        if (row >= state->body_count || strcmp(body->name, message->names[i]) != 0) *body = (sb_monitor_body){0};
        memcpy(body->name, message->names[i], sizeof body->name);
        body->reported = message->reported[i];
        memcpy(body->force, &message->force[3 * i], sizeof body->force);
        body->horizontal = hypot(body->force[0], body->force[1]);
        body->peak = fmax(body->peak, body->horizontal);
        if (body->reported) {
            state->peak = fmax(state->peak, body->horizontal);
            for (int k = 0; k < 3; k++) state->peak_component = fmax(state->peak_component, fabs(body->force[k]));
        }
        /* The rows before this one belong to a lost message. They stay empty until it is sent again. */
        while (state->body_count < row) state->bodies[state->body_count++] = (sb_monitor_body){0};
        if (state->body_count == row) state->body_count = row + 1;
    }
}

void sb_monitor_on_particles(void *user, const sb_particles_message *message)
{
    sb_monitor_state *state = user;
    state->last_data = sb_clock();
    if (sb_assembly_add(&state->assembly, message) != SB_OK) state->assembly.chunks_ignored++;
}

void sb_monitor_state_sample(sb_monitor_state *state, sb_listener_counters count, double now)
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

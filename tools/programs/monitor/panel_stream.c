/* Health of the stream. */
#include "panel.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct row {
    const char *name;
    void (*write)(char *out, size_t size, const sb_monitor_state *state);
    bool (*bad)(const sb_monitor_state *state); /* NULL: never */
} row;

#define COUNT(NAME, MEMBER)                                                                                            \
    static void write_##NAME(char *out, size_t size, const sb_monitor_state *state)                                    \
    {                                                                                                                  \
        snprintf(out, size, "%" PRIu64, (uint64_t)state->MEMBER);                                                      \
    }
#define BAD(NAME, MEMBER)                                                                                              \
    static bool bad_##NAME(const sb_monitor_state *state)                                                              \
    {                                                                                                                  \
        return state->MEMBER > 0;                                                                                      \
    }

COUNT(repaired, count.parts_repaired)
COUNT(parts_lost, count.parts_lost)
COUNT(refused, count.refused)
COUNT(foreign, count.foreign)
COUNT(complete, count.frames_complete)
COUNT(partial, count.frames_partial)
COUNT(restarts, count.restarts)
COUNT(receiver, receiver_restarts)
COUNT(skipped, status.frames_skipped)
COUNT(errors, status.errors)
BAD(lost, count.lost)
BAD(parts_lost, count.parts_lost)
BAD(refused, count.refused)
BAD(partial, count.frames_partial)
BAD(receiver, receiver_restarts)
BAD(errors, status.errors)

static void write_rate(char *out, size_t size, const sb_monitor_state *state)
{
    snprintf(out, size, "%.1f per second, %.2f MB/s", state->message_rate, 1e-6 * state->byte_rate);
}

static void write_lost(char *out, size_t size, const sb_monitor_state *state)
{
    snprintf(out, size, "%" PRIu64 ", %.2g %%", state->count.lost, 100 * sb_monitor_state_lost(state));
}

static void write_frame(char *out, size_t size, const sb_monitor_state *state)
{
    if (state->has_frame)
        snprintf(out, size, "t = %.4g s, %" PRId64 " particles", state->frame_time, state->frame_particles);
    else
        snprintf(out, size, "none yet");
}

static void write_limits(char *out, size_t size, const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    const int used = snprintf(out, size, "one particle in %d, ", (int)status->decimation);
    if (status->rate > 0)
        snprintf(out + used, size - (size_t)used, "%.3g frames/s", status->rate);
    else
        snprintf(out + used, size - (size_t)used, "any rate");
}

static const row rows[] = {
    {"messages", write_rate, NULL},
    {"messages lost", write_lost, bad_lost},
    {"parts repaired", write_repaired, NULL},
    {"parts lost", write_parts_lost, bad_parts_lost},
    {"messages refused", write_refused, bad_refused},
    {"of another run", write_foreign, NULL},
    {"frames complete", write_complete, NULL},
    {"frames partial", write_partial, bad_partial},
    {"newest frame", write_frame, NULL},
    {"frames skipped", write_skipped, NULL}, /* the publisher's counts and limits, from here on */
    {"publisher errors", write_errors, bad_errors},
    {"limits", write_limits, NULL},
    {"run restarts", write_restarts, NULL},
    {"receiver restarts", write_receiver, bad_receiver},
};

static size_t count_stream(const sb_monitor_state *state)
{
    (void)state;
    return sizeof rows / sizeof *rows;
}

static void head_stream(sb_strip strip, const sb_monitor_state *state)
{
    (void)state;
    sb_strip_left(&strip, SB_STYLE_BOLD, 18, 1, "stream");
    sb_strip_left(&strip, SB_STYLE_BOLD, strip.width, 0, "value");
}

static void row_stream(sb_strip strip, const sb_monitor_state *state, size_t index)
{
    char value[120];
    rows[index].write(value, sizeof value, state);
    sb_strip_left(&strip, SB_STYLE_PLAIN, 18, 1, rows[index].name);
    const bool bad = rows[index].bad && rows[index].bad(state);
    sb_strip_left(&strip, bad ? SB_STYLE_BAD : SB_STYLE_PLAIN, strip.width, 0, value);
}

const sb_panel sb_panel_stream = {
    "Stream", count_stream, head_stream, row_stream, NULL, "",
};

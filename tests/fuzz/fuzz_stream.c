/* Fuzzes LCM messages as a subscriber receives them. The input is a sequence of messages, each preceded by its length
   in two bytes, high byte first. Every message is decoded as each type and as an encoded scene, and a subscriber takes
   it from each channel. */
#include "fuzz.h"

#include "stream/live.h"

#include <math.h>
#include <string.h>

static void check_name(const char *name)
{
    FUZZ_CHECK(memchr(name, 0, SB_STREAM_NAME));
    for (; *name; ++name) FUZZ_CHECK(*name >= ' ' && *name < 0x7f);
}

static void check_rows(int32_t total, int32_t first, int32_t count)
{
    FUZZ_CHECK(first >= 0 && count >= 0 && count <= SB_STREAM_ROWS && count <= total - first);
}

static void on_status(void *user, const sb_status_message *m)
{
    (void)user;
    check_name(m->run);
    FUZZ_CHECK(isfinite(m->time) && isfinite(m->eta_seconds) && m->step >= 0 && m->state < SB_RUN_STATES);
    FUZZ_CHECK(m->stage_count >= 0 && m->stage_count <= SB_STREAM_STAGES);
    for (int32_t i = 0; i < m->stage_count; ++i) check_name(m->stages[i]);
}

static void on_forces(void *user, const sb_forces_message *m)
{
    (void)user;
    check_rows(m->total, m->first, m->count);
    for (int32_t i = 0; i < m->count; ++i) check_name(m->names[i]);
    for (int32_t i = 0; i < 3 * m->count; ++i)
        FUZZ_CHECK(isfinite(m->force[i]) && isfinite(m->moment[i]) && isfinite(m->pressure[i]) &&
                   isfinite(m->friction[i]));
}

static void on_gauges(void *user, const sb_gauges_message *m)
{
    (void)user;
    check_rows(m->total, m->first, m->count);
    for (int32_t i = 0; i < m->count; ++i) {
        check_name(m->names[i]);
        FUZZ_CHECK(isfinite(m->eta[i]) && isfinite(m->z[i]));
    }
}

static void on_reply(void *user, const sb_reply_message *m)
{
    (void)user;
    FUZZ_CHECK(m->id >= 0 && m->counter >= 0 && isfinite(m->time) && memchr(m->text, 0, sizeof m->text));
}

/* Reads all of a complete frame, so that a sanitizer sees what no part brought. */
static void on_frame(void *user, const sb_live_frame *frame)
{
    unsigned *sum = user;
    int64_t next = 0;
    for (int32_t p = 0; p < frame->part_count; ++p) {
        FUZZ_CHECK(frame->parts[p].first == next && frame->parts[p].count >= 0);
        next += frame->parts[p].count;
    }
    FUZZ_CHECK(next == frame->count);
    for (int64_t i = 0; i < SB_STREAM_POINT * frame->count; ++i) *sum += frame->points[i];
    for (int32_t i = 0; i < frame->moved_count; ++i) FUZZ_CHECK(frame->moved[i] >= 0);
}

static void on_scene(void *user, const sb_live_scene *scene)
{
    (void)user;
    check_name(scene->run);
    for (size_t b = 0; b < scene->body_count; ++b) {
        const sb_live_body *body = &scene->bodies[b];
        check_name(body->name);
        for (size_t c = 0; c < 3 * body->triangle_count; ++c)
            FUZZ_CHECK(body->corners[c] >= 0 && (size_t)body->corners[c] < body->vertex_count);
    }
    for (size_t c = 0; c < scene->camera_count; ++c) FUZZ_CHECK(scene->cameras[c].key_count > 0);
    for (size_t g = 0; g < scene->gauge_count; ++g) check_name(scene->gauges[g].name);
    for (size_t w = 0; w < scene->wavemaker_count; ++w) check_name(scene->wavemakers[w]);
}

static void try_scene(const uint8_t *bytes, size_t size)
{
    sb_live_scene scene;
    sb_error error = {0};
    const sb_status status = sb_live_scene_decode(bytes, size, &scene, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    on_scene(NULL, &scene);
    sb_live_scene_free(&scene);
}

/* Checks the texts of refusals, which the subscriber does not keep. */
static void try_errors(const uint8_t *bytes, size_t size)
{
    static union {
        sb_status_message status;
        sb_forces_message forces;
        sb_gauges_message gauges;
        sb_frame_message part;
        sb_parity_message parity;
        sb_scene_piece_message piece;
        sb_reply_message reply;
    } m;
    sb_error errors[SB_CHANNELS] = {0};
    const sb_status statuses[SB_CHANNELS] = {
        sb_stream_decode_status(bytes, size, &m.status, &errors[0]),
        sb_stream_decode_forces(bytes, size, &m.forces, &errors[1]),
        sb_stream_decode_gauges(bytes, size, &m.gauges, &errors[2]),
        sb_stream_decode_frame(bytes, size, &m.part, &errors[3]),
        sb_stream_decode_parity(bytes, size, &m.parity, &errors[4]),
        sb_stream_decode_piece(bytes, size, &m.piece, &errors[5]),
        sb_stream_decode_reply(bytes, size, &m.reply, &errors[6]),
    };
    for (int i = 0; i < SB_CHANNELS; ++i)
        if (statuses[i] != SB_OK) fuzz_check_refusal(statuses[i], &errors[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned sum = 0;
    double time = 0;
    const sb_live_calls calls = {.user = &sum,
                                 .status = on_status,
                                 .forces = on_forces,
                                 .gauges = on_gauges,
                                 .frame = on_frame,
                                 .scene = on_scene,
                                 .reply = on_reply};
    sb_live *live = sb_live_create(&calls);
    FUZZ_CHECK(live);
    for (; size > 2; time += 0.7) {
        size_t length = (size_t)data[0] << 8 | data[1];
        data += 2;
        size -= 2;
        if (length > size) length = size;
        /* A block of exactly that size, so that a sanitizer detects a read beyond the end. */
        uint8_t *exact = malloc(length ? length : 1);
        FUZZ_CHECK(exact);
        memcpy(exact, data, length);
        try_errors(exact, length);
        try_scene(exact, length);
        for (int kind = 0; kind < SB_CHANNELS; ++kind) sb_live_take(live, (sb_channel_kind)kind, exact, length, time);
        free(exact);
        data += length;
        size -= length;
    }
    const sb_live_counts counts = sb_live_count(live);
    FUZZ_CHECK(counts.refused + counts.foreign <= counts.messages);
    sb_live_destroy(live);
    return 0;
}

/* One message of each channel, captured from a stream. */
#ifndef SB_TESTS_STREAM_CAPTURED_H
#define SB_TESTS_STREAM_CAPTURED_H

#include "stream_fixture.h"

typedef struct message {
    size_t size;
    unsigned char bytes[SB_STREAM_MESSAGE_MAX];
} message;

static message good[SB_CHANNELS]; /* by channel, the last one */

static inline void capture(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)user;
    message *to = &good[sb_channel_guess(channel)];
    to->size = received->data_size;
    memcpy(to->bytes, received->data, received->data_size);
}

/* A stream in memory whose messages are captured, with those of a scene, its rows at 4.5 s, a reply and a frame of
   `count` particles. Drains it. NULL if the scene cannot be set. */
static inline sb_stream *captured_stream(fixture_scene *f, size_t count)
{
    fixture_scene_make(f, 4, 3);
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    if (sb_stream_set_scene(stream, &f->scene, &f->model, NULL) != SB_OK) return NULL;
    lcm_subscribe(sb_stream_provider(stream), ".*", capture, NULL);
    sb_measure_records rows = fixture_rows(f, 4.5);
    sb_stream_measure(stream, &rows);
    fixture_rows_free(&rows);
    const sb_reply_message reply = {.id = 7, .counter = 8, .step = 9, .time = 4.5, .text = "paused"};
    sb_stream_reply(stream, &reply);
    sb_frame *frame = fixture_frame(3, 4.5, count, 4);
    fixture_publish(stream, frame);
    sb_frame_release(frame);
    fixture_drain(stream);
    return stream;
}

#endif

/* The state of a stream. Internal to src/stream. */
#ifndef SB_STREAM_STREAM_STATE_H
#define SB_STREAM_STREAM_STATE_H

#include "stream/points.h"
#include "stream/stream.h"

#include <pthread.h>

/* Rows that wait to be sent. */
typedef struct sb_stream_rows {
    sb_force_record *forces;
    sb_gauge_record *gauges;
    size_t force_count, force_capacity, gauge_count, gauge_capacity;
} sb_stream_rows;

struct sb_stream {
    sb_stream *previous_abandoned;
    sb_sender sender;
    char run[SB_STREAM_NAME];
    int64_t run_id;
    const char *url;
    double interval;
    const sb_scene *scene; /* NULL: no scene was set; then rows are not kept */
    const sb_model *model;

    pthread_mutex_t lock; /* protects the members below up to the next comment; never held while LCM is called */
    sb_stream_progress progress;
    sb_run_state state, sent_state; /* sent_state: of the last status */
    sb_stream_rows waiting;
    sb_stream_limits limits;
    size_t reply_count;
    sb_reply_message replies[SB_STREAM_REPLIES_WAITING];

    /* Of the stream's thread. */
    sb_stream_rows sending;
    int64_t last_interval;          /* number of the interval whose particles were sent last; -1: none yet */
    int64_t frame;                  /* the last frame that was sent */
    uint64_t skipped;               /* frames that the rate left out */
    double frame_time, status_time; /* sb_clock() when the last ones were sent; -1: never */
    double frame_end;               /* sb_clock() when all of the last frame was sent */
    double spread;                  /* s over which the parts of a frame are spread */
    unsigned char *encoded;         /* the scene; NULL: none */
    size_t encoded_size;
    int64_t scene_id;
    double cycle_begin; /* sb_clock() when the present cycle of pieces began; -1: not yet */
    int32_t next_piece;
    sb_points points;
    unsigned char buffer[SB_STREAM_MESSAGE_MAX], parity[SB_STREAM_POINT * SB_STREAM_POINTS];

    _Atomic uint64_t row_errors; /* rows and replies that were dropped */
};

/* stream_rows.c: sends the waiting rows. */
void sb_stream_send_rows(sb_stream *stream);
/* stream_reply.c: sends the waiting replies. */
void sb_stream_send_replies(sb_stream *stream);
/* stream_frame.c: sends the particles of a frame. */
void sb_stream_send_frame(sb_stream *stream, const sb_frame *frame);
/* Writes the vector's components. */
static inline void sb_stream_store(double out[3], sb_vec3 vector)
{
    out[0] = vector.x;
    out[1] = vector.y;
    out[2] = vector.z;
}

#endif

/* Keeps the replies to commands until the stream's thread sends them. */
#include "stream/stream_state.h"

#include "shorebreak_reply_t.h"

#include <string.h>

void sb_stream_reply(sb_stream *stream, const sb_reply_message *reply)
{
    pthread_mutex_lock(&stream->lock);
    const bool fits = stream->reply_count < SB_STREAM_REPLIES_WAITING;
    if (fits) stream->replies[stream->reply_count++] = *reply;
    pthread_mutex_unlock(&stream->lock);
    stream->row_errors += !fits;
}

/* Takes the oldest reply. False: none waits. */
static bool take(sb_stream *stream, sb_reply_message *reply)
{
    pthread_mutex_lock(&stream->lock);
    const bool any = stream->reply_count > 0;
    if (any) {
        *reply = stream->replies[0];
        stream->reply_count--;
        memmove(stream->replies, stream->replies + 1, stream->reply_count * sizeof *reply);
    }
    pthread_mutex_unlock(&stream->lock);
    return any;
}

void sb_stream_send_replies(sb_stream *stream)
{
    sb_reply_message reply;
    while (take(stream, &reply)) {
        shorebreak_reply_t message = {.version = SB_STREAM_VERSION,
                                      .run_id = stream->run_id,
                                      .id = reply.id,
                                      .counter = reply.counter,
                                      .result = reply.refused ? 1 : 0,
                                      .step = reply.step,
                                      .time = reply.time,
                                      .text = reply.text};
        sb_sender_send(&stream->sender, SB_CHANNEL_REPLY, stream->buffer,
                       shorebreak_reply_t_encode(stream->buffer, 0, sizeof stream->buffer, &message));
    }
}

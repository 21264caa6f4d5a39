/* Publishes a run on LCM channels. */
#include "app/frames/consumers.h"

/* Time at the end of a run in which the provider may accept the last messages, s. */
static const double STOP_TIMEOUT = 5;

static void note_trouble(sb_streamer *streamer)
{
    if (streamer->had_trouble || sb_stream_count(streamer->stream).errors == 0) return;
    streamer->had_trouble = true;
    sb_runlog_warning(streamer->log, "stream: the provider refused messages at t = %g s; the run continues",
                      streamer->time);
}

static sb_status publish(void *state, const sb_frame *frame, sb_error *error)
{
    (void)error;
    sb_streamer *streamer = state;
    streamer->time = frame->status.time;
    sb_stream_publish(streamer->stream, frame);
    note_trouble(streamer);
    return SB_OK;
}

static double serve(void *state)
{
    sb_streamer *streamer = state;
    const double pause = sb_stream_serve(streamer->stream);
    note_trouble(streamer);
    return pause;
}

static void close_streamer(void *state)
{
    sb_streamer *streamer = state;
    sb_stream_finish(streamer->stream);
    sb_stream_destroy(streamer->stream);
    streamer->stream = NULL;
}

static void abandon_streamer(void *state)
{
    sb_streamer *streamer = state;
    sb_stream_abandon(streamer->stream);
    streamer->stream = NULL;
}

sb_consumer_work sb_streamer_work(sb_streamer *streamer)
{
    return (sb_consumer_work){.name = "stream",
                              .state = streamer,
                              .handle = publish,
                              .idle = serve,
                              .close = close_streamer,
                              .abandon = abandon_streamer,
                              .stop_timeout = STOP_TIMEOUT};
}

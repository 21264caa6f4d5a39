/* Publishes frames on LCM channels. */
#include "app/consumers.h"

/* Time at the end of a run in which the provider may accept the last messages, s. */
static const double STOP_TIMEOUT = 5;

static sb_status publish(void *state, const sb_frame *frame, sb_error *error)
{
    (void)error;
    sb_streamer *streamer = state;
    const bool had_trouble = streamer->counters.errors > 0;
    sb_stream_publish(streamer->stream, frame);
    streamer->counters = sb_stream_count(streamer->stream);
    if (streamer->counters.errors > 0 && !had_trouble)
        sb_runlog_warning(streamer->log, "stream: the provider refused messages at t = %g s; the run continues",
                          frame->status.time);
    return SB_OK;
}

static void close_streamer(void *state)
{
    sb_streamer *streamer = state;
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
                              .close = close_streamer,
                              .abandon = abandon_streamer,
                              .stop_timeout = STOP_TIMEOUT};
}

/* Publishes a run over LCM: status, forces and particles (types in lcmtypes/, decoded by decode.h).
   Nothing here changes the run or stops it: trouble after creation is counted, never returned. */
#ifndef SB_STREAM_STREAM_H
#define SB_STREAM_STREAM_H

#include "base/status.h"
#include "frame/frame.h"
#include "scene/scene.h"

#include <stdint.h>

typedef struct sb_stream sb_stream;

/* Opens the provider of settings->url (empty: LCM_DEFAULT_URL, else LCM's default). run_name is
   copied, cut at 63 bytes. SB_FAILED with the remedy when there is no provider: warn and go on.
   LCM writes its complaints to stderr; they are caught and become part of the error, so create the
   stream before other threads print. */
sb_status sb_stream_create(const sb_stream_settings *settings, const char *run_name, sb_stream **stream,
                           sb_error *error);
void sb_stream_destroy(sb_stream *stream);

/* After a publish was cancelled: what LCM left of it, perhaps with its lock held, cannot be closed; it is kept until
   the process ends. */
void sb_stream_abandon(sb_stream *stream);

/* Sends status and forces of a frame, and its particles when settings->interval has passed since
   the last ones, in chunks of at most 60 kB, 0.1 ms apart (0.3 s per 2 M particles). For the
   streamer's own thread: some providers block on a stopped subscriber. */
void sb_stream_publish(sb_stream *stream, const sb_frame *frame);

/* Sends the status alone, one small message; from any thread. */
void sb_stream_status(sb_stream *stream, const sb_frame_status *status);

/* Messages and bytes handed to LCM, and messages it refused; from any thread. */
typedef struct sb_stream_counters {
    uint64_t messages, bytes, errors;
} sb_stream_counters;
sb_stream_counters sb_stream_count(const sb_stream *stream);

#endif

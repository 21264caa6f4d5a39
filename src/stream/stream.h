/* Publishes a run over LCM: status, forces and particles (types in lcmtypes/, decoded by decode.h). Streaming never
   changes or stops the run: failures after creation are counted and not returned. */
#ifndef SB_STREAM_STREAM_H
#define SB_STREAM_STREAM_H

#include "base/status.h"
#include "frame/frame.h"
#include "scene/scene.h"

#include <stdint.h>

typedef struct sb_stream sb_stream;

/* Opens the provider of settings->url (empty: LCM_DEFAULT_URL if it is set, else LCM's default). run_name is copied and
   truncated to 63 bytes. SB_FAILED, with the remedy, if the provider cannot be opened: the caller warns and continues.
   LCM writes its messages to stderr; they are captured and become part of the error, so the stream must be created
   before other threads print. */
sb_status sb_stream_create(const sb_stream_settings *settings, const char *run_name, sb_stream **stream,
                           sb_error *error);
void sb_stream_destroy(sb_stream *stream);

/* Keeps a stream until the process ends, after its thread was cancelled in a publish call: LCM may still hold its lock,
   so the provider cannot be closed. */
void sb_stream_abandon(sb_stream *stream);

/* Sends the status and the forces of a frame, and its particles if settings->interval has passed since particles were
   last sent. Particles are sent in chunks of at most 60 kB with pauses of 0.1 ms (0.3 s per 2 M particles). To be
   called from the stream's own thread, because some providers block when a subscriber is stopped. */
void sb_stream_publish(sb_stream *stream, const sb_frame *frame);

/* Sends the status alone, as one small message. May be called from any thread. */
void sb_stream_status(sb_stream *stream, const sb_frame_status *status);

/* Messages and bytes that LCM accepted, and messages that failed. May be called from any thread. */
typedef struct sb_stream_counters {
    uint64_t messages, bytes, errors;
} sb_stream_counters;
sb_stream_counters sb_stream_count(const sb_stream *stream);

#endif

/* Publishes a run over LCM (types in lcmtypes/, docs/live.md). Streaming never changes or stops the run: failures after
   creation are counted and not returned.

   The run's thread calls the functions that set values; they copy and never wait for LCM. One other thread, the
   stream's, calls those that send. */
#ifndef SB_STREAM_STREAM_H
#define SB_STREAM_STREAM_H

#include "base/status.h"
#include "frame/frame.h"
#include "frame/records.h"
#include "frame/stage_time.h"
#include "geometry/model/model.h"
#include "stream/decode.h"
#include "stream/sender.h"

#include <stdbool.h>

typedef struct sb_stream sb_stream;

/* Opens the provider of settings->url (empty: LCM_DEFAULT_URL if it is set, else LCM's default), which must outlive the
   stream. run_name is copied and truncated to 63 bytes. SB_FAILED, with the remedy, if the provider cannot be opened:
   the caller warns and continues. LCM writes its messages to stderr; they are captured and become part of the error, so
   the stream must be created before other threads print. */
sb_status sb_stream_create(const sb_stream_settings *settings, const char *run_name, sb_stream **stream,
                           sb_error *error);
void sb_stream_destroy(sb_stream *stream);

/* Keeps a stream until the process ends, after its thread was cancelled in a publish call: LCM may still hold its lock,
   so the provider cannot be closed. */
void sb_stream_abandon(sb_stream *stream);

/* Encodes the scene message. Call it before the stream's thread starts. scene and model must outlive the stream. On an
   error there is no scene message, and all else is sent. */
sb_status sb_stream_set_scene(sb_stream *stream, const sb_scene *scene, const sb_model *model, sb_error *error);

/* The id with which all messages of this stream begin: 0 to 2^53 - 1, drawn at the creation. */
int64_t sb_stream_run_id(const sb_stream *stream);
/* The URL of its provider. */
const char *sb_stream_url(const sb_stream *stream);

/* ---- from any thread ---- */

/* What a status message tells of the run, beside the stream's own counters. */
typedef struct sb_stream_progress {
    sb_frame_status status;
    double density_error_max, tolerance;
    uint64_t capped_steps, fluid_particles;
    uint64_t frames_dropped; /* by the queue before the stream */
    size_t stage_count;
    sb_stage_time stages[SB_STAGES_MAX];
} sb_stream_progress;
/* Sets what the next status messages report. */
void sb_stream_set_progress(sb_stream *stream, const sb_stream_progress *progress);
/* Sets the state that they report. The stream's thread keeps sending them while the run is paused. */
void sb_stream_set_state(sb_stream *stream, sb_run_state state);

/* Adds rows of forces and gauges to those that wait to be sent. Each row is sent once. When SB_STREAM_ROWS_WAITING rows
   wait because the provider blocks, new rows are dropped and counted as errors. */
enum { SB_STREAM_ROWS_WAITING = 1 << 20 };
void sb_stream_measure(sb_stream *stream, const sb_measure_records *records);

/* Adds a reply to those that wait to be sent; run and sequence number are the stream's. When SB_STREAM_REPLIES_WAITING
   replies wait, it is dropped and counted as an error. */
enum { SB_STREAM_REPLIES_WAITING = 64 };
void sb_stream_reply(sb_stream *stream, const sb_reply_message *reply);

/* How much is sent. */
typedef struct sb_stream_limits {
    double rate;             /* frames per second of wall time, at most; 0: no limit */
    int decimation;          /* one particle in `decimation` is sent; at least 1 */
    bool region;             /* only particles within [min, max] are sent */
    sb_vec3 min, max;        /* m */
    double bytes_per_second; /* within a frame, and of scene pieces, over UDP; 0: no limit */
} sb_stream_limits;
/* Sets the limits of the next frame; values out of range are moved to the nearest allowed value. */
void sb_stream_set_limits(sb_stream *stream, const sb_stream_limits *limits);
sb_stream_limits sb_stream_get_limits(sb_stream *stream);

/* The limits to set after subscribers have reported, for the last second or so, that this share of the messages was
   lost (0 to 1): slower when messages are lost, faster again when none are. Only bytes_per_second changes, between
   SB_STREAM_BYTES_MIN and SB_STREAM_BYTES_MAX: while a frame takes longer to send, the queue drops others. */
#define SB_STREAM_BYTES_MIN 2e6
#define SB_STREAM_BYTES_MAX 1.5e8
sb_stream_limits sb_stream_adapt(sb_stream_limits limits, double lost);

sb_stream_counters sb_stream_count(const sb_stream *stream);

/* ---- from the stream's thread ---- */

/* Sends the frame's particles if settings->interval has passed since particles were last sent, and the rate allows it;
   and all that sb_stream_serve sends. Some providers block when a subscriber is stopped. */
void sb_stream_publish(sb_stream *stream, const sb_frame *frame);

/* Sends what is due: waiting replies and rows, the status, the next pieces of the scene. Returns the seconds after
   which it is to be called again, at most SB_STREAM_SERVE. */
#define SB_STREAM_SERVE 0.1
double sb_stream_serve(sb_stream *stream);

/* Sends the rows that wait, and a last status in the state "done". */
void sb_stream_finish(sb_stream *stream);

#endif

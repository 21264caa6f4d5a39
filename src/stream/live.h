/* A subscriber's view of a run: takes the messages of a run's channels from untrusted bytes, checks them, and keeps the
   scene, the newest complete frame and the newest status. It reads no network itself: a listener (listen.h), a log
   (log.h) or a test passes the messages. */
#ifndef SB_STREAM_LIVE_H
#define SB_STREAM_LIVE_H

#include "stream/assembly.h"
#include "stream/channel.h"
#include "stream/scene.h"

typedef struct sb_live sb_live;

/* Callbacks, called from sb_live_take. A message is valid until the callback returns; scene and frame until the next
   one is complete. Any callback may be NULL. */
typedef struct sb_live_calls {
    void *user;
    /* Messages of another run follow: the run was resumed, or another one began. */
    void (*restarted)(void *user, int64_t run_id);
    void (*scene)(void *user, const sb_live_scene *scene);
    void (*status)(void *user, const sb_status_message *message);
    void (*forces)(void *user, const sb_forces_message *message);
    void (*gauges)(void *user, const sb_gauges_message *message);
    void (*part)(void *user, const sb_frame_message *message); /* of any frame, also of one that stays incomplete */
    void (*frame)(void *user, const sb_live_frame *frame);
    void (*reply)(void *user, const sb_reply_message *message); /* to a command */
} sb_live_calls;

/* NULL without memory. */
sb_live *sb_live_create(const sb_live_calls *calls);
void sb_live_destroy(sb_live *live);

/* Takes one message. time: s, on a clock of the caller's choice that does not go back, e.g. of the reception.
   SB_BAD_INPUT if the message is invalid; it is counted and has no other effect. Messages of a second run on the same
   channels are counted and ignored, until the first run has ended or has been silent for SB_LIVE_SILENCE seconds. */
#define SB_LIVE_SILENCE 2.0
sb_status sb_live_take(sb_live *live, sb_channel_kind kind, const void *data, size_t size, double time);

/* The newest ones; NULL: none yet. */
const sb_live_scene *sb_live_get_scene(const sb_live *live);
const sb_live_frame *sb_live_get_frame(const sb_live *live);
const sb_status_message *sb_live_get_status(const sb_live *live);

typedef struct sb_live_counts {
    uint64_t messages, bytes; /* taken, invalid ones included */
    uint64_t refused;         /* invalid */
    uint64_t foreign;         /* of another run */
    uint64_t lost;            /* by the sequence numbers: sent by the run since its first message here, and not taken */
    uint64_t restarts;
    uint64_t frames_complete, frames_partial, parts, parts_lost, parts_repaired; /* as in sb_assembly */
} sb_live_counts;
sb_live_counts sb_live_count(const sb_live *live);

#endif

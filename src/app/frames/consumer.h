/* A consumer of frames: a thread that takes frames from a bounded queue. It is given a frame at regular intervals of
   simulated time. */
#ifndef SB_APP_CONSUMER_H
#define SB_APP_CONSUMER_H

#include "frame/queue.h"

#include <pthread.h>
#include <stdbool.h>

/* Seconds without progress after which a consumer is abandoned. A consumer makes progress when it finishes a frame or
   its thread uses the processor. One that does neither for so long is taken to hang, for example because a library
   waits for a thread that could not be started. Its frames count as missed, and its thread is no longer waited for. The
   second value applies once a signal has told the process to stop. */
#define SB_CONSUMER_DEADLINE 120.0
#define SB_CONSUMER_STOP_DEADLINE 5.0

/* The work of a consumer, all of it in its own thread. When open fails, it is tried again with each frame. When handle
   fails, that frame is missed, and the next frame is handled as usual. handle and idle may be cancelled. */
typedef struct sb_consumer_work {
    const char *name;
    void *state;
    sb_status (*open)(void *state, sb_error *error);
    sb_status (*handle)(void *state, const sb_frame *frame, sb_error *error);
    double (*idle)(
        void *state); /* called while no frame comes: returns the s after which it is called again. NULL: none */
    void (*close)(void *state);
    void (*abandon)(void *state); /* instead of close, called by the thread that stops it, after handle was cancelled */
    double stop_timeout; /* s that stopping waits before it cancels handle; 0: waits as long as there is progress */
    double deadline;     /* s without progress after which it is abandoned; 0: SB_CONSUMER_DEADLINE */
} sb_consumer_work;

/* The failures of a consumer. Trouble lasts from an open or a frame that failed until a frame that succeeded. */
typedef struct sb_trouble {
    uint64_t missed;  /* frames */
    uint64_t changes; /* how often trouble began or ended: it lasts while this is odd */
    sb_error first;   /* why the first frame was missed */
    sb_error latest;  /* why the latest trouble began */
} sb_trouble;

typedef struct sb_consumer {
    sb_consumer_work work;
    sb_frame_queue *queue;
    pthread_t thread;
    bool started, given_up; /* given_up: it made no progress until its deadline, or did not end within stop_timeout */
    double interval, next;  /* simulated s between frames; time of the next frame */
    uint64_t handled;
    const sb_frame *frame; /* the frame that the thread works on */
    sb_error reason; /* of the thread's last failure; not on its stack, which a cancelled thread does not clean up */
    pthread_mutex_t lock; /* protects the members below */
    pthread_cond_t idle;
    uint64_t fed, done; /* frames given to it; frames that it has finished */
    bool ended;         /* its thread has finished all work */
    bool abandoned;     /* its thread, if it ever continues, must change nothing */
    sb_trouble trouble;
} sb_consumer;

/* Starts the thread. The interval must be above 0. */
sb_status sb_consumer_start(sb_consumer *consumer, const sb_consumer_work *work, double interval, size_t capacity,
                            sb_queue_policy policy, sb_error *error);

/* Whether a frame at this time is due. */
bool sb_consumer_due(const sb_consumer *consumer, double time);

/* Whether the consumer has finished all frames that it was given. */
bool sb_consumer_is_idle(sb_consumer *consumer);

/* Adds the frame to the queue and sets the time of the next one. Waits while the queue is full, unless the queue drops
   frames. The frame is missed when the consumer is abandoned during the wait or was abandoned before. */
void sb_consumer_feed(sb_consumer *consumer, const sb_frame *frame);

/* The failures so far; may be called after the consumer was stopped. */
sb_trouble sb_consumer_trouble(sb_consumer *consumer);

/* Waits until the consumer has finished all frames it was given, or is abandoned. The queue must be one that drops no
   frames. The consumer's files and counters may then be read. Does nothing when it was never started. */
void sb_consumer_drain(sb_consumer *consumer);

/* Waits until the consumer has finished its frames, and joins its thread. After stop_timeout it cancels the thread
   instead and calls abandon. The thread of an abandoned consumer remains. Does nothing when it was never started. */
void sb_consumer_stop(sb_consumer *consumer);

/* Processor time of the consumer's thread, s; 0 where the system does not report it. Call it before sb_consumer_stop.
 */
double sb_consumer_processor(const sb_consumer *consumer);

/* Whether the thread of an abandoned consumer still exists. Nothing that it was given may then be freed, and the
   process must end by _exit. */
bool sb_consumer_thread_remains(const sb_consumer *consumer);

#endif

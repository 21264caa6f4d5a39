/* A consumer of frames: its own thread behind a bounded queue, fed when its time has come. */
#ifndef SB_APP_CONSUMER_H
#define SB_APP_CONSUMER_H

#include "frame/queue.h"

#include <pthread.h>
#include <stdbool.h>

/* s. Whoever waits for a consumer waits while that makes progress: it ends a frame, or its thread uses the processor.
   One that does neither for so long never will, as a library that waits for a thread which could not be started, and is
   given up: its frames are missed, its thread is left to itself. The second deadline holds once a signal has asked
   the process to stop. */
#define SB_CONSUMER_DEADLINE 120.0
#define SB_CONSUMER_STOP_DEADLINE 5.0

/* What a consumer does, all of it in its own thread. open may fail: it is tried again with each frame. handle may fail:
   that frame is missed, and the next one is handled as if nothing had been. */
typedef struct sb_consumer_work {
    const char *name;
    void *state;
    sb_status (*open)(void *state, sb_error *error);
    sb_status (*handle)(void *state, const sb_frame *frame, sb_error *error);
    void (*close)(void *state);
    void (*abandon)(void *state); /* in the place of close, in the thread that stops it, after handle was cancelled */
    double patience; /* s that stopping waits for a handle which allows to be cancelled; 0: while there is progress */
    double deadline; /* s without progress after which it is given up; 0: SB_CONSUMER_DEADLINE */
} sb_consumer_work;

/* What went wrong. Trouble lasts from an open or a frame that failed until a frame that went well. */
typedef struct sb_trouble {
    uint64_t missed; /* frames */
    uint64_t turns;  /* how often trouble began or was over: it lasts when this is odd */
    sb_error first;  /* why the first frame was missed */
    sb_error latest; /* why the latest trouble began */
} sb_trouble;

typedef struct sb_consumer {
    sb_consumer_work work;
    sb_frame_queue *queue;
    pthread_t thread;
    bool started, given_up; /* given_up: it made no progress before a deadline, or stopping was out of patience */
    double interval, next;  /* s simulated between frames; time of the next one */
    uint64_t handled;
    const sb_frame *frame; /* that the thread is at work on */
    sb_error reason; /* the thread's own, of its last failure; here, for a cancelled one leaves its stack as it is */
    pthread_mutex_t lock; /* of what is below */
    pthread_cond_t idle;
    uint64_t fed, done; /* frames given to it, and those it is through with */
    bool ended;         /* its thread is through with everything */
    bool left;          /* its thread, should it ever go on, is to touch nothing any more */
    sb_trouble trouble;
} sb_consumer;

/* Starts the thread. The interval is above 0. */
sb_status sb_consumer_start(sb_consumer *consumer, const sb_consumer_work *work, double interval, size_t capacity,
                            sb_queue_policy policy, sb_error *error);

/* Whether a frame at this time is due. */
bool sb_consumer_due(const sb_consumer *consumer, double time);

/* Hands the frame over and sets the next due time. Waits for room where the queue drops nothing; the frame is missed
   when the consumer is given up meanwhile, or was before. */
void sb_consumer_feed(sb_consumer *consumer, const sb_frame *frame);

/* Its trouble so far, also after it was stopped. */
sb_trouble sb_consumer_trouble(sb_consumer *consumer);

/* Waits until it is through with all frames it was fed, or is given up; with a queue that drops none only. What it has
   written and counted may then be read. Fine when it never started. */
void sb_consumer_drain(sb_consumer *consumer);

/* Lets it finish what it has, and joins. Out of patience, it cancels the thread instead, and
   abandons what that has open. Where it is given up, its thread stays. Fine when it never started. */
void sb_consumer_stop(sb_consumer *consumer);

/* Whether the thread of a consumer that was given up still is there. What it may use, which is all that it ever had,
   must not be freed; the process ends by _exit. */
bool sb_consumer_left(const sb_consumer *consumer);

#endif

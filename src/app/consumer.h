/* A consumer of frames: its own thread behind a bounded queue, fed when its time has come. */
#ifndef SB_APP_CONSUMER_H
#define SB_APP_CONSUMER_H

#include "frame/queue.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

/* What a consumer does, all of it in its own thread. open may fail: the consumer is then out of the run,
   with the reason kept. handle may fail: it is not called again. */
typedef struct sb_consumer_work {
    const char *name;
    void *state;
    sb_status (*open)(void *state, sb_error *error);
    sb_status (*handle)(void *state, const sb_frame *frame, sb_error *error);
    void (*close)(void *state);
    void (*abandon)(void *state); /* in the place of close, in the thread that stops it, after handle was cancelled */
    double patience; /* s that stopping waits for a handle which allows to be cancelled; 0: for as long as it takes */
} sb_consumer_work;

typedef struct sb_consumer {
    sb_consumer_work work;
    sb_frame_queue *queue;
    pthread_t thread;
    bool started, given_up; /* given_up: stopping was out of patience */
    double interval, next;  /* s simulated between frames; time of the next one */
    sb_error error;         /* why it stopped; read after sb_consumer_stop */
    atomic_bool failed;
    uint64_t handled;
    const sb_frame *frame; /* that the thread is at work on */
    pthread_mutex_t lock;  /* of what is below */
    pthread_cond_t idle;
    uint64_t fed, done; /* frames given to it, and those it is through with */
    bool ended;         /* its thread is through with everything */
} sb_consumer;

/* Starts the thread. The interval is above 0. */
sb_status sb_consumer_start(sb_consumer *consumer, const sb_consumer_work *work, double interval, size_t capacity,
                            sb_queue_policy policy, sb_error *error);

/* Whether a frame at this time is due. */
bool sb_consumer_due(const sb_consumer *consumer, double time);

/* Hands the frame over and sets the next due time. */
void sb_consumer_feed(sb_consumer *consumer, const sb_frame *frame);

/* Waits until it is through with all frames it was fed; with a queue that drops none only. What it has written and
   counted may then be read. Fine when it never started. */
void sb_consumer_drain(sb_consumer *consumer);

/* Lets it finish what it has, and joins. Out of patience, it cancels the thread instead, and
   abandons what that has open. Fine when it never started. */
void sb_consumer_stop(sb_consumer *consumer);

#endif

/* A bounded queue that passes frames from the simulation's thread to one consumer's thread. */
#ifndef SB_FRAME_QUEUE_H
#define SB_FRAME_QUEUE_H

#include "frame/frame.h"

typedef struct sb_frame_queue sb_frame_queue;

/* The action of sb_frame_queue_push when the queue is full. */
typedef enum sb_queue_policy {
    SB_QUEUE_WAIT,        /* wait until there is room: the consumer gets every frame */
    SB_QUEUE_DROP_OLDEST, /* drop the oldest frame and count it: the producer never waits */
} sb_queue_policy;

/* Creates a queue of capacity >= 1 frames. NULL if memory runs out or capacity is 0. */
sb_frame_queue *sb_frame_queue_create(size_t capacity, sb_queue_policy policy);

/* Releases the frames that are still in the queue and frees it. No thread may be in push or pop. NULL has no effect. */
void sb_frame_queue_destroy(sb_frame_queue *queue);

/* Adds a frame and retains it for the consumer; the caller keeps its own reference. Returns false and retains nothing
   if the queue is closed, also when it is closed during the wait for room. */
bool sb_frame_queue_push(sb_frame_queue *queue, const sb_frame *frame);

/* Waits at most so many seconds until there is room, so that a push would not wait. Returns whether there is. The time
   counts as waiting in push. */
bool sb_frame_queue_wait(sb_frame_queue *queue, double seconds);

/* Waits for the next frame and removes it, oldest first; the caller must release it. NULL once the queue is closed and
   empty. */
const sb_frame *sb_frame_queue_pop(sb_frame_queue *queue);

/* The same, but waits at most so many seconds. NULL also when they are over; *closed tells which. */
const sb_frame *sb_frame_queue_pop_within(sb_frame_queue *queue, double seconds, bool *closed);

/* Closes the queue: no more frames can be pushed, and all waiting threads wake up. The frames in the queue can still be
   popped. */
void sb_frame_queue_close(sb_frame_queue *queue);

/* Return the number of frames dropped so far, and the seconds that push has spent waiting. */
uint64_t sb_frame_queue_dropped(sb_frame_queue *queue);
double sb_frame_queue_waited(sb_frame_queue *queue);

#endif

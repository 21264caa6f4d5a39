/* A bounded hand-over of frames from the simulation's thread to one consumer's thread. */
#ifndef SB_FRAME_QUEUE_H
#define SB_FRAME_QUEUE_H

#include "frame/frame.h"

typedef struct sb_frame_queue sb_frame_queue;

/* What push does when the queue is full. */
typedef enum sb_queue_policy {
    SB_QUEUE_WAIT,        /* wait for room: the consumer misses nothing */
    SB_QUEUE_DROP_OLDEST, /* drop the oldest and count it: the producer never waits */
} sb_queue_policy;

/* capacity >= 1 frames. NULL without memory or with capacity 0. */
sb_frame_queue *sb_frame_queue_create(size_t capacity, sb_queue_policy policy);

/* Releases the frames still inside; no thread may be in push or pop any more. NULL is fine. */
void sb_frame_queue_destroy(sb_frame_queue *queue);

/* Retains the frame for the consumer; the caller keeps its own reference. False, with nothing
   retained, once the queue is closed (also when that happens while waiting for room). */
bool sb_frame_queue_push(sb_frame_queue *queue, const sb_frame *frame);

/* Waits for the next frame, oldest first; the caller then holds a reference to release. NULL once
   the queue is closed and empty. */
const sb_frame *sb_frame_queue_pop(sb_frame_queue *queue);

/* No more frames will come: wakes whoever waits; what is inside may still be popped. */
void sb_frame_queue_close(sb_frame_queue *queue);

/* Frames dropped so far, and the seconds that push has spent waiting. */
uint64_t sb_frame_queue_dropped(sb_frame_queue *queue);
double sb_frame_queue_waited(sb_frame_queue *queue);

#endif

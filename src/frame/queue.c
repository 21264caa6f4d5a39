#include "frame/queue.h"

#include "base/clock.h"
#include "base/memory.h"

#include <pthread.h>

struct slot {
    const sb_frame *frame;
};

struct sb_frame_queue {
    pthread_mutex_t lock;
    pthread_cond_t has_frame, has_room;
    sb_queue_policy policy;
    bool closed;
    size_t capacity, first, count;
    struct slot *ring; /* `count` frames from `first` on, wrapping at `capacity` */
    uint64_t dropped;
    double waited; /* s */
};

sb_frame_queue *sb_frame_queue_create(size_t capacity, sb_queue_policy policy)
{
    if (capacity == 0) return NULL;
    sb_frame_queue *queue = sb_alloc(1, sizeof *queue);
    if (!queue) return NULL;
    queue->ring = sb_alloc(capacity, sizeof *queue->ring);
    if (!queue->ring) {
        sb_free(queue);
        return NULL;
    }
    queue->policy = policy;
    queue->capacity = capacity;
    pthread_mutex_init(&queue->lock, NULL);
    sb_clock_init_condition(&queue->has_frame);
    sb_clock_init_condition(&queue->has_room);
    return queue;
}

static const sb_frame *take(sb_frame_queue *queue)
{
    const sb_frame *frame = queue->ring[queue->first].frame;
    queue->first = (queue->first + 1) % queue->capacity;
    queue->count--;
    return frame;
}

void sb_frame_queue_destroy(sb_frame_queue *queue)
{
    if (!queue) return;
    while (queue->count) sb_frame_release(take(queue));
    pthread_cond_destroy(&queue->has_room);
    pthread_cond_destroy(&queue->has_frame);
    pthread_mutex_destroy(&queue->lock);
    sb_free(queue->ring);
    sb_free(queue);
}

static bool has_room(const sb_frame_queue *queue)
{
    return queue->closed || queue->count < queue->capacity || queue->policy != SB_QUEUE_WAIT;
}

static void wait_for_room(sb_frame_queue *queue)
{
    if (has_room(queue)) return;
    double start = sb_clock();
    while (!has_room(queue)) pthread_cond_wait(&queue->has_room, &queue->lock);
    queue->waited += sb_clock() - start;
}

bool sb_frame_queue_wait(sb_frame_queue *queue, double seconds)
{
    pthread_mutex_lock(&queue->lock);
    bool room = has_room(queue);
    if (!room) {
        const double start = sb_clock();
        const struct timespec end = sb_clock_after(seconds);
        int late = 0;
        while (!has_room(queue) && !late) late = pthread_cond_timedwait(&queue->has_room, &queue->lock, &end);
        queue->waited += sb_clock() - start;
        room = has_room(queue);
    }
    pthread_mutex_unlock(&queue->lock);
    return room;
}

bool sb_frame_queue_push(sb_frame_queue *queue, const sb_frame *frame)
{
    const sb_frame *oldest = NULL;
    pthread_mutex_lock(&queue->lock);
    wait_for_room(queue);
    bool open = !queue->closed;
    if (open) {
        if (queue->count == queue->capacity) {
            oldest = take(queue);
            queue->dropped++;
        }
        queue->ring[(queue->first + queue->count++) % queue->capacity].frame = sb_frame_retain(frame);
        pthread_cond_signal(&queue->has_frame);
    }
    pthread_mutex_unlock(&queue->lock);
    /* Freeing a large frame takes time, so it is done without the lock. */
    sb_frame_release(oldest);
    return open;
}

const sb_frame *sb_frame_queue_pop(sb_frame_queue *queue)
{
    const sb_frame *frame = NULL;
    pthread_mutex_lock(&queue->lock);
    while (queue->count == 0 && !queue->closed) pthread_cond_wait(&queue->has_frame, &queue->lock);
    if (queue->count) {
        frame = take(queue);
        pthread_cond_signal(&queue->has_room);
    }
    pthread_mutex_unlock(&queue->lock);
    return frame;
}

const sb_frame *sb_frame_queue_pop_within(sb_frame_queue *queue, double seconds, bool *closed)
{
    const sb_frame *frame = NULL;
    const struct timespec end = sb_clock_after(seconds);
    int late = 0;
    pthread_mutex_lock(&queue->lock);
    while (queue->count == 0 && !queue->closed && !late)
        late = pthread_cond_timedwait(&queue->has_frame, &queue->lock, &end);
    if (queue->count) {
        frame = take(queue);
        pthread_cond_signal(&queue->has_room);
    }
    *closed = !frame && queue->closed;
    pthread_mutex_unlock(&queue->lock);
    return frame;
}

void sb_frame_queue_close(sb_frame_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->closed = true;
    pthread_cond_broadcast(&queue->has_frame);
    pthread_cond_broadcast(&queue->has_room);
    pthread_mutex_unlock(&queue->lock);
}

uint64_t sb_frame_queue_dropped(sb_frame_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    uint64_t dropped = queue->dropped;
    pthread_mutex_unlock(&queue->lock);
    return dropped;
}

double sb_frame_queue_waited(sb_frame_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    double waited = queue->waited;
    pthread_mutex_unlock(&queue->lock);
    return waited;
}

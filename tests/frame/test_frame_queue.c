/* Frames and their reference counts; queues between threads. */
#include "base/clock.h"
#include "base/memory.h"
#include "frame/queue.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static sb_frame *numbered(uint64_t index)
{
    sb_frame *frame = sb_frame_create(10, 1);
    assert_non_null(frame);
    frame->index = index;
    for (size_t i = 0; i < 30; i++) frame->position[i] = (float)index;
    return frame;
}

static void frame_counts_its_references(void **state)
{
    (void)state;
    sb_frame *frame = sb_frame_create(5, 2);
    assert_non_null(frame);
    assert_int_equal(frame->count, 5);
    assert_int_equal(frame->body_count, 2);
    assert_int_equal(frame->references, 1);
    assert_true(frame->bodies[1].displacement.x == 0);
    assert_ptr_equal(sb_frame_retain(frame), frame);
    assert_int_equal(frame->references, 2);
    sb_frame_release(frame);
    assert_int_equal(frame->references, 1);
    sb_frame_release(frame);
    assert_null(sb_frame_retain(NULL));
    sb_frame_release(NULL);
    assert_null(sb_frame_create(SIZE_MAX / 2, 0));
}

static void frame_fails_cleanly_without_memory(void **state)
{
    (void)state;
    for (long n = 1; n <= 6; n++) {
        sb_memory_fail_at(n);
        assert_null(sb_frame_create(10, 3));
    }
    sb_memory_fail_at(0);
    for (long n = 1; n <= 2; n++) {
        sb_memory_fail_at(n);
        assert_null(sb_frame_queue_create(4, SB_QUEUE_WAIT));
    }
    sb_memory_fail_at(0);
    assert_null(sb_frame_queue_create(0, SB_QUEUE_WAIT));
}

static void drops_the_oldest(void **state)
{
    (void)state;
    sb_frame_queue *queue = sb_frame_queue_create(2, SB_QUEUE_DROP_OLDEST);
    for (uint64_t i = 1; i <= 5; i++) {
        sb_frame *frame = numbered(i);
        assert_true(sb_frame_queue_push(queue, frame));
        sb_frame_release(frame);
    }
    assert_int_equal(sb_frame_queue_dropped(queue), 3);
    assert_true(sb_frame_queue_waited(queue) == 0);
    sb_frame_queue_close(queue);
    for (uint64_t i = 4; i <= 5; i++) {
        const sb_frame *frame = sb_frame_queue_pop(queue);
        assert_int_equal(frame->index, i);
        assert_int_equal(frame->references, 1);
        sb_frame_release(frame);
    }
    assert_null(sb_frame_queue_pop(queue));
    sb_frame *late = numbered(6);
    assert_false(sb_frame_queue_push(queue, late));
    assert_int_equal(late->references, 1);
    sb_frame_release(late);
    sb_frame_queue_destroy(queue);
}

static void destroy_releases_the_remaining_frames(void **state)
{
    (void)state;
    sb_frame_queue *queue = sb_frame_queue_create(3, SB_QUEUE_WAIT);
    sb_frame *frame = numbered(1);
    assert_true(sb_frame_queue_push(queue, frame));
    assert_true(sb_frame_queue_push(queue, frame));
    assert_int_equal(frame->references, 3);
    sb_frame_queue_destroy(queue);
    assert_int_equal(frame->references, 1);
    sb_frame_release(frame);
    sb_frame_queue_destroy(NULL);
}

struct consumer {
    sb_frame_queue *queue;
    int pause; /* us after each frame */
    size_t count, wrong;
    uint64_t last;
};

static void *consume(void *argument)
{
    struct consumer *consumer = argument;
    const sb_frame *frame;
    while ((frame = sb_frame_queue_pop(consumer->queue)) != NULL) {
        if (frame->index <= consumer->last) consumer->wrong++;
        for (size_t i = 0; i < 30; i++)
            if (frame->position[i] != (float)frame->index) consumer->wrong++;
        consumer->last = frame->index;
        consumer->count++;
        sb_frame_release(frame);
        if (consumer->pause) {
            struct timespec time = {0, consumer->pause * 1000L};
            nanosleep(&time, NULL);
        }
    }
    return NULL;
}

static void produce(sb_queue_policy policy, int pause, struct consumer *consumer)
{
    enum { FRAMES = 300 };
    *consumer = (struct consumer){.queue = sb_frame_queue_create(3, policy), .pause = pause};
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, consume, consumer), 0);
    for (uint64_t i = 1; i <= FRAMES; i++) {
        sb_frame *frame = numbered(i);
        assert_true(sb_frame_queue_push(consumer->queue, frame));
        sb_frame_release(frame);
    }
    sb_frame_queue_close(consumer->queue);
    pthread_join(thread, NULL);
    assert_int_equal(consumer->wrong, 0);
    assert_int_equal(consumer->last, FRAMES);
    assert_int_equal(consumer->count + sb_frame_queue_dropped(consumer->queue), FRAMES);
}

static void waiting_loses_nothing_between_threads(void **state)
{
    (void)state;
    struct consumer consumer;
    produce(SB_QUEUE_WAIT, 500, &consumer);
    assert_int_equal(consumer.count, 300);
    /* At least 297 pauses of 0.5 ms lie between the first push and the last. */
    assert_true(sb_frame_queue_waited(consumer.queue) > 0.1);
    sb_frame_queue_destroy(consumer.queue);
}

static void dropping_never_waits(void **state)
{
    (void)state;
    struct consumer consumer;
    produce(SB_QUEUE_DROP_OLDEST, 2000, &consumer);
    assert_true(sb_frame_queue_waited(consumer.queue) == 0);
    assert_true(sb_frame_queue_dropped(consumer.queue) > 0);
    sb_frame_queue_destroy(consumer.queue);
}

static void *close_later(void *queue)
{
    struct timespec time = {0, 20000000};
    nanosleep(&time, NULL);
    sb_frame_queue_close(queue);
    return NULL;
}

static void closing_wakes_a_waiting_push(void **state)
{
    (void)state;
    sb_frame_queue *queue = sb_frame_queue_create(1, SB_QUEUE_WAIT);
    sb_frame *frame = numbered(1);
    assert_true(sb_frame_queue_push(queue, frame));
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, close_later, queue), 0);
    assert_false(sb_frame_queue_push(queue, frame));
    pthread_join(thread, NULL);
    assert_int_equal(frame->references, 2);
    sb_frame_queue_destroy(queue);
    sb_frame_release(frame);
}

static void a_pop_waits_for_a_limited_time(void **state)
{
    (void)state;
    bool closed = true;
    sb_frame_queue *queue = sb_frame_queue_create(1, SB_QUEUE_WAIT);
    sb_frame *frame = numbered(1);
    const double begun = sb_clock();
    assert_null(sb_frame_queue_pop_within(queue, 0.05, &closed));
    assert_false(closed);
    assert_true(sb_clock() - begun >= 0.05);
    assert_true(sb_frame_queue_push(queue, frame));
    sb_frame_queue_close(queue);
    assert_ptr_equal(sb_frame_queue_pop_within(queue, 5, &closed), frame);
    assert_false(closed);
    assert_null(sb_frame_queue_pop_within(queue, 100, &closed));
    assert_true(closed);
    sb_frame_release(frame);
    sb_frame_release(frame);
    sb_frame_queue_destroy(queue);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frame_counts_its_references),
        cmocka_unit_test(frame_fails_cleanly_without_memory),
        cmocka_unit_test(drops_the_oldest),
        cmocka_unit_test(destroy_releases_the_remaining_frames),
        cmocka_unit_test(waiting_loses_nothing_between_threads),
        cmocka_unit_test(dropping_never_waits),
        cmocka_unit_test(closing_wakes_a_waiting_push),
        cmocka_unit_test(a_pop_waits_for_a_limited_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A consumer without progress is abandoned; a slow one is waited for. */
#include "app/frames/consumer.h"

#include "../check.h"
#include "base/clock.h"

#include <unistd.h>

static const double DEADLINE = 0.3; /* s */

/* State of a consumer. It hangs by waiting for the lock, which the test releases at its end. */
typedef struct worker {
    pthread_mutex_t lock;
    int frames;   /* frames that it has begun */
    int hangs_at; /* the frame in which it hangs; 0: none */
    double busy;  /* processor time of each frame, s */
    bool closed;
    int idle_calls;
} worker;

static sb_status handle(void *state, const sb_frame *frame, sb_error *error)
{
    (void)frame;
    (void)error;
    worker *h = state;
    struct timespec used;
    double begin = -1, now;
    if (++h->frames == h->hangs_at) pthread_mutex_lock(&h->lock);
    do {
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
        now = (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
        if (begin < 0) begin = now;
    } while (now - begin < h->busy);
    return SB_OK;
}

static void close_worker(void *state)
{
    ((worker *)state)->closed = true;
}

static void start(sb_consumer *consumer, worker *h)
{
    const sb_consumer_work work = {
        .name = "pictures", .state = h, .handle = handle, .close = close_worker, .deadline = DEADLINE};
    sb_error error = {0};
    pthread_mutex_init(&h->lock, NULL);
    pthread_mutex_lock(&h->lock);
    assert_int_equal(sb_consumer_start(consumer, &work, 1, 2, SB_QUEUE_WAIT, &error), SB_OK);
}

static void feed(sb_consumer *consumer, int count)
{
    for (int i = 0; i < count; i++) {
        sb_frame *frame = sb_frame_create(1, 0);
        assert_non_null(frame);
        sb_consumer_feed(consumer, frame);
        sb_frame_release(frame);
    }
}

/* An abandoned consumer is reported. If its thread continues later, it takes no frame and does not call close. */
static void check_given_up(sb_consumer *consumer, worker *h, uint64_t missed)
{
    const sb_trouble trouble = sb_consumer_trouble(consumer);
    assert_true(consumer->given_up && sb_consumer_thread_remains(consumer));
    assert_int_equal(trouble.missed, missed);
    assert_int_equal(trouble.changes, 1);
    assert_string_equal(trouble.latest.text, "no progress for 0.3 s");
    if (missed > 0) assert_string_equal(trouble.first.text, trouble.latest.text);
    pthread_mutex_unlock(&h->lock);
    pthread_join(consumer->thread, NULL);
    assert_int_equal(h->frames, h->hangs_at);
    assert_false(h->closed);
    assert_int_equal(sb_consumer_trouble(consumer).missed, missed);
    sb_frame_release(consumer->frame);
    sb_frame_queue_destroy(consumer->queue);
}

static void feeding_one_that_hangs(void **state)
{
    (void)state;
    worker h = {.hangs_at = 2};
    sb_consumer consumer;
    start(&consumer, &h);
    const double begin = sb_clock();
    feed(&consumer, 7); /* one is finished, one hangs, two wait, three do not fit into the queue */
    assert_true(sb_clock() - begin >= DEADLINE);
    sb_consumer_drain(&consumer);
    sb_consumer_stop(&consumer);
    check_given_up(&consumer, &h, 6);
}

static void draining_one_that_hangs(void **state)
{
    (void)state;
    worker h = {.hangs_at = 1};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 2);
    sb_consumer_drain(&consumer);
    check_given_up(&consumer, &h, 2);
}

static void stopping_one_that_hangs(void **state)
{
    (void)state;
    worker h = {.hangs_at = 3};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 3);
    sb_consumer_stop(&consumer);
    check_given_up(&consumer, &h, 1);
}

/* Each frame takes longer than the deadline, with progress: nothing is missed. */
static void one_that_is_slow(void **state)
{
    (void)state;
    worker h = {.busy = 2 * DEADLINE};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 4);
    sb_consumer_drain(&consumer);
    assert_int_equal(consumer.handled, 4);
    feed(&consumer, 1);
    sb_consumer_stop(&consumer);
    assert_int_equal(consumer.handled, 5);
    assert_true(h.closed);
    assert_false(consumer.given_up || sb_consumer_thread_remains(&consumer));
    assert_int_equal(sb_consumer_trouble(&consumer).missed, 0);
}

static double count_call(void *state)
{
    ((worker *)state)->idle_calls++;
    return 0.02;
}

static void one_that_works_between_frames(void **state)
{
    (void)state;
    sb_consumer consumer;
    worker h = {0};
    const sb_consumer_work work = {
        .name = "stream", .state = &h, .handle = handle, .idle = count_call, .close = close_worker};
    assert_int_equal(sb_consumer_start(&consumer, &work, 1, 2, SB_QUEUE_DROP_OLDEST, NULL), SB_OK);
    usleep(300000);
    feed(&consumer, 1);
    sb_consumer_stop(&consumer);
    assert_int_equal(h.frames, 1);
    assert_in_range(h.idle_calls, 5, 18);
    assert_true(h.closed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(feeding_one_that_hangs),        cmocka_unit_test(draining_one_that_hangs),
        cmocka_unit_test(stopping_one_that_hangs),       cmocka_unit_test(one_that_is_slow),
        cmocka_unit_test(one_that_works_between_frames),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

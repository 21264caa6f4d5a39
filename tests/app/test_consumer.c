/* A consumer's thread that makes no progress is given up; one that is slow is waited for. */
#include "app/consumer.h"

#include "../check.h"
#include "base/clock.h"

#include <unistd.h>

static const double DEADLINE = 0.3; /* s */

/* One that hangs holds it; the test frees it at its end. */
typedef struct hands {
    pthread_mutex_t lock;
    int frames;   /* that it has begun */
    int hangs_at; /* the frame it never ends; 0: none */
    double busy;  /* s of processor that each frame takes */
    bool closed;
} hands;

static sb_status handle(void *state, const sb_frame *frame, sb_error *error)
{
    (void)frame;
    (void)error;
    hands *h = state;
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

static void close_hands(void *state)
{
    ((hands *)state)->closed = true;
}

static void start(sb_consumer *consumer, hands *h)
{
    const sb_consumer_work work = {
        .name = "pictures", .state = h, .handle = handle, .close = close_hands, .deadline = DEADLINE};
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

/* What was given up is told, and its thread, should it go on after all, neither takes a frame nor closes. */
static void check_given_up(sb_consumer *consumer, hands *h, uint64_t missed)
{
    const sb_trouble trouble = sb_consumer_trouble(consumer);
    assert_true(consumer->given_up && sb_consumer_left(consumer));
    assert_int_equal(trouble.missed, missed);
    assert_int_equal(trouble.turns, 1);
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
    hands h = {.hangs_at = 2};
    sb_consumer consumer;
    start(&consumer, &h);
    const double begin = sb_clock();
    feed(&consumer, 7); /* one is ended, one in its hands, two wait, three find no room */
    assert_true(sb_clock() - begin >= DEADLINE);
    sb_consumer_drain(&consumer);
    sb_consumer_stop(&consumer);
    check_given_up(&consumer, &h, 6);
}

static void draining_one_that_hangs(void **state)
{
    (void)state;
    hands h = {.hangs_at = 1};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 2);
    sb_consumer_drain(&consumer);
    check_given_up(&consumer, &h, 2);
}

static void stopping_one_that_hangs(void **state)
{
    (void)state;
    hands h = {.hangs_at = 3};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 3);
    sb_consumer_stop(&consumer);
    check_given_up(&consumer, &h, 1);
}

/* Each frame takes more than the deadline: nothing is missed. */
static void one_that_is_slow(void **state)
{
    (void)state;
    hands h = {.busy = 2 * DEADLINE};
    sb_consumer consumer;
    start(&consumer, &h);
    feed(&consumer, 4);
    sb_consumer_drain(&consumer);
    assert_int_equal(consumer.handled, 4);
    feed(&consumer, 1);
    sb_consumer_stop(&consumer);
    assert_int_equal(consumer.handled, 5);
    assert_true(h.closed);
    assert_false(consumer.given_up || sb_consumer_left(&consumer));
    assert_int_equal(sb_consumer_trouble(&consumer).missed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(feeding_one_that_hangs),
        cmocka_unit_test(draining_one_that_hangs),
        cmocka_unit_test(stopping_one_that_hangs),
        cmocka_unit_test(one_that_is_slow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

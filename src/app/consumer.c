#include "app/consumer.h"

#include "base/clock.h"

#include <math.h>
#include <signal.h>
#include <unistd.h>

/* Trouble begins with the first failure, and is over with the first frame that went well. */
static void note(sb_consumer *consumer, bool good, bool is_frame)
{
    sb_trouble *trouble = &consumer->trouble;
    pthread_mutex_lock(&consumer->lock);
    const bool lasts = trouble->turns % 2;
    if (!good && !lasts) trouble->latest = consumer->reason;
    if (!good && is_frame && trouble->missed++ == 0) trouble->first = consumer->reason;
    trouble->turns += good == lasts;
    pthread_mutex_unlock(&consumer->lock);
}

static bool is_open(sb_consumer *consumer)
{
    return !consumer->work.open || consumer->work.open(consumer->work.state, &consumer->reason) == SB_OK;
}

static void *serve(void *argument)
{
    sb_consumer *consumer = argument;
    const sb_consumer_work *work = &consumer->work;
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL);
    bool open = is_open(consumer);
    if (!open) note(consumer, false, false);
    while ((consumer->frame = sb_frame_queue_pop(consumer->queue))) {
        open = open || is_open(consumer);
        const bool good = open && work->handle(work->state, consumer->frame, &consumer->reason) == SB_OK;
        note(consumer, good, true);
        consumer->handled += good;
        sb_frame_release(consumer->frame);
        pthread_mutex_lock(&consumer->lock);
        consumer->done++;
        pthread_cond_signal(&consumer->idle);
        pthread_mutex_unlock(&consumer->lock);
    }
    if (work->close) work->close(work->state);
    pthread_mutex_lock(&consumer->lock);
    consumer->ended = true;
    pthread_mutex_unlock(&consumer->lock);
    return NULL;
}

sb_status sb_consumer_start(sb_consumer *consumer, const sb_consumer_work *work, double interval, size_t capacity,
                            sb_queue_policy policy, sb_error *error)
{
    *consumer = (sb_consumer){.work = *work, .interval = interval};
    consumer->queue = sb_frame_queue_create(capacity, policy);
    if (!consumer->queue) return sb_fail_memory(error, "a frame queue");
    pthread_mutex_init(&consumer->lock, NULL);
    pthread_cond_init(&consumer->idle, NULL);
    /* Signals are for the main thread. */
    sigset_t all, old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    int refused = pthread_create(&consumer->thread, NULL, serve, consumer);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    if (refused) {
        sb_frame_queue_destroy(consumer->queue);
        pthread_cond_destroy(&consumer->idle);
        pthread_mutex_destroy(&consumer->lock);
        consumer->queue = NULL;
        return sb_fail(error, SB_FAILED, "%s: the system refuses a thread", work->name);
    }
    consumer->started = true;
    return SB_OK;
}

/* Steps that end on a multiple of the interval may fall short of it by what sums round. */
static const double ROUNDING = 1e-9;

bool sb_consumer_due(const sb_consumer *consumer, double time)
{
    return consumer->started && time + ROUNDING * consumer->interval >= consumer->next;
}

void sb_consumer_feed(sb_consumer *consumer, const sb_frame *frame)
{
    consumer->fed += sb_frame_queue_push(consumer->queue, frame);
    consumer->next = consumer->interval * (floor(frame->status.time / consumer->interval + ROUNDING) + 1);
}

sb_trouble sb_consumer_trouble(sb_consumer *consumer)
{
    if (!consumer->started) return consumer->trouble;
    pthread_mutex_lock(&consumer->lock);
    const sb_trouble trouble = consumer->trouble;
    pthread_mutex_unlock(&consumer->lock);
    return trouble;
}

void sb_consumer_drain(sb_consumer *consumer)
{
    if (!consumer->started) return;
    pthread_mutex_lock(&consumer->lock);
    while (consumer->done < consumer->fed) pthread_cond_wait(&consumer->idle, &consumer->lock);
    pthread_mutex_unlock(&consumer->lock);
}

/* Whether the thread is through with all it has while there is patience. */
static bool ends_in_time(sb_consumer *consumer)
{
    enum { POLL = 5000 }; /* us */
    const double end = sb_clock() + consumer->work.patience;
    for (;;) {
        pthread_mutex_lock(&consumer->lock);
        const bool through = consumer->ended;
        pthread_mutex_unlock(&consumer->lock);
        if (through || !(consumer->work.patience > 0)) return true;
        if (sb_clock() > end) return false;
        usleep(POLL);
    }
}

void sb_consumer_stop(sb_consumer *consumer)
{
    if (!consumer->started) return;
    sb_frame_queue_close(consumer->queue);
    consumer->given_up = !ends_in_time(consumer);
    if (consumer->given_up) pthread_cancel(consumer->thread);
    void *end;
    pthread_join(consumer->thread, &end);
    if (end == PTHREAD_CANCELED) {
        sb_frame_release(consumer->frame);
        if (consumer->work.abandon) consumer->work.abandon(consumer->work.state);
    }
    sb_frame_queue_destroy(consumer->queue);
    pthread_cond_destroy(&consumer->idle);
    pthread_mutex_destroy(&consumer->lock);
    consumer->queue = NULL;
    consumer->started = false;
}

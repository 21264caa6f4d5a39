#include "app/frames/consumer.h"

#include "base/clock.h"
#include "base/stop.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <unistd.h>

/* Trouble begins with the first failure and ends with the first frame that succeeds. The caller holds the lock. */
static void note_locked(sb_consumer *consumer, const sb_error *reason, uint64_t missed)
{
    sb_trouble *trouble = &consumer->trouble;
    const bool lasts = trouble->changes % 2;
    if (reason && !lasts) trouble->latest = *reason;
    if (reason && missed > 0 && trouble->missed == 0) trouble->first = *reason;
    trouble->missed += missed;
    trouble->changes += !reason == lasts;
}

/* Records the result of an open or a frame. False: the consumer was abandoned in the meantime. */
static bool note(sb_consumer *consumer, bool good, bool is_frame)
{
    pthread_mutex_lock(&consumer->lock);
    const bool abandoned = consumer->abandoned;
    if (!abandoned) note_locked(consumer, good ? NULL : &consumer->reason, !good && is_frame);
    pthread_mutex_unlock(&consumer->lock);
    return !abandoned;
}

static bool is_open(sb_consumer *consumer)
{
    return !consumer->work.open || consumer->work.open(consumer->work.state, &consumer->reason) == SB_OK;
}

/* Waits for the next frame. False: there are no more. */
static bool next_frame(sb_consumer *consumer)
{
    const sb_consumer_work *work = &consumer->work;
    bool closed = false;
    consumer->frame = NULL;
    if (!work->idle) {
        consumer->frame = sb_frame_queue_pop(consumer->queue);
        return consumer->frame != NULL;
    }
    while (!consumer->frame && !closed) {
        const double pause = work->idle(work->state);
        consumer->frame = sb_frame_queue_pop_within(consumer->queue, pause, &closed);
    }
    return !closed;
}

static void *serve(void *argument)
{
    sb_consumer *consumer = argument;
    const sb_consumer_work *work = &consumer->work;
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL);
    bool open = is_open(consumer);
    if (!open && !note(consumer, false, false)) return NULL;
    while (next_frame(consumer)) {
        open = open || is_open(consumer);
        const bool good = open && work->handle(work->state, consumer->frame, &consumer->reason) == SB_OK;
        if (!note(consumer, good, true)) return NULL;
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
    sb_clock_init_condition(&consumer->idle);
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

/* A step that ends on a multiple of the interval may end slightly before it, because sums of time steps are rounded. */
static const double ROUNDING = 1e-9;

bool sb_consumer_due(const sb_consumer *consumer, double time)
{
    return consumer->started && time + ROUNDING * consumer->interval >= consumer->next;
}

sb_trouble sb_consumer_trouble(sb_consumer *consumer)
{
    if (!consumer->started) return consumer->trouble;
    pthread_mutex_lock(&consumer->lock);
    const sb_trouble trouble = consumer->trouble;
    pthread_mutex_unlock(&consumer->lock);
    return trouble;
}

/* ---- waiting for a consumer ---- */

static const double SLICE = 0.1; /* s between two checks of progress */

/* The progress of the thread at the last check, and how long it has made none. */
typedef struct watch {
    uint64_t done;
    double processor, idle; /* s */
} watch;

double sb_consumer_processor(const sb_consumer *consumer)
{
    clockid_t clock;
    struct timespec used;
    if (pthread_getcpuclockid(consumer->thread, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* Abandons the thread. The frame that it works on and those that it has not begun count as missed. */
static void give_up(sb_consumer *consumer, double seconds)
{
    sb_error reason = {0};
    sb_fail(&reason, SB_FAILED, "no progress for %g s", seconds);
    pthread_mutex_lock(&consumer->lock);
    consumer->abandoned = true;
    note_locked(consumer, &reason, consumer->fed - consumer->done);
    pthread_mutex_unlock(&consumer->lock);
    consumer->given_up = true;
    sb_frame_queue_close(consumer->queue);
    for (const sb_frame *frame; (frame = sb_frame_queue_pop(consumer->queue));) sb_frame_release(frame);
}

/* Checks the progress after `seconds` of waiting, and abandons the consumer when its deadline is over. The waiting is
   counted in slices and not measured by the clock, so that the time for which the process was suspended does not count.
 */
static void watch_on(sb_consumer *consumer, watch *w, double seconds)
{
    static const double SHARE = 0.01; /* of a processor: a smaller share counts as no progress */
    double deadline = consumer->work.deadline > 0 ? consumer->work.deadline : SB_CONSUMER_DEADLINE;
    if (sb_stop_signal()) deadline = fmin(deadline, SB_CONSUMER_STOP_DEADLINE);
    const double processor = sb_consumer_processor(consumer);
    pthread_mutex_lock(&consumer->lock);
    const uint64_t done = consumer->done;
    pthread_mutex_unlock(&consumer->lock);
    const bool goes_on = done != w->done || processor - w->processor > SHARE * seconds;
    *w = (watch){done, processor, goes_on ? 0 : w->idle + seconds};
    if (w->idle >= deadline) give_up(consumer, deadline);
}

void sb_consumer_feed(sb_consumer *consumer, const sb_frame *frame)
{
    watch w = {0};
    while (!consumer->given_up && !sb_frame_queue_wait(consumer->queue, SLICE)) watch_on(consumer, &w, SLICE);
    const bool pushed = sb_frame_queue_push(consumer->queue, frame);
    pthread_mutex_lock(&consumer->lock);
    consumer->fed += pushed;
    consumer->trouble.missed += !pushed;
    pthread_mutex_unlock(&consumer->lock);
    consumer->next = consumer->interval * (floor(frame->status.time / consumer->interval + ROUNDING) + 1);
}

bool sb_consumer_is_idle(sb_consumer *consumer)
{
    pthread_mutex_lock(&consumer->lock);
    const bool idle = consumer->done == consumer->fed;
    pthread_mutex_unlock(&consumer->lock);
    return idle;
}

void sb_consumer_drain(sb_consumer *consumer)
{
    watch w = {0};
    if (!consumer->started) return;
    while (!consumer->given_up) {
        const struct timespec end = sb_clock_after(SLICE);
        int late = 0;
        pthread_mutex_lock(&consumer->lock);
        while (consumer->done < consumer->fed && !late)
            late = pthread_cond_timedwait(&consumer->idle, &consumer->lock, &end);
        pthread_mutex_unlock(&consumer->lock);
        if (!late) return;
        watch_on(consumer, &w, SLICE);
    }
}

/* Waits until the thread has ended: for its stop_timeout, or as long as it makes progress. False: it has not ended. */
static bool ends_in_time(sb_consumer *consumer)
{
    enum { POLL = 5000 }; /* us */
    const double end = sb_clock() + consumer->work.stop_timeout;
    for (watch w = {0}; !consumer->given_up;) {
        pthread_mutex_lock(&consumer->lock);
        const bool through = consumer->ended;
        pthread_mutex_unlock(&consumer->lock);
        if (through) return true;
        if (consumer->work.stop_timeout > 0 && sb_clock() > end) return false;
        usleep(POLL);
        if (!(consumer->work.stop_timeout > 0)) watch_on(consumer, &w, 1e-6 * POLL);
    }
    return false;
}

/* Cancels the thread, which ends at once where it permits cancellation. False: it still exists. */
static bool cancel(sb_consumer *consumer)
{
    enum { POLL = 5000 }; /* us */
    void *result = NULL;
    int busy;
    pthread_cancel(consumer->thread);
    const double end = sb_clock() + consumer->work.stop_timeout;
    while ((busy = pthread_tryjoin_np(consumer->thread, &result)) == EBUSY && sb_clock() < end) usleep(POLL);
    if (busy) return false;
    if (result == PTHREAD_CANCELED) {
        sb_frame_release(consumer->frame);
        if (consumer->work.abandon) consumer->work.abandon(consumer->work.state);
    }
    return true;
}

void sb_consumer_stop(sb_consumer *consumer)
{
    if (!consumer->started) return;
    sb_frame_queue_close(consumer->queue);
    if (ends_in_time(consumer)) {
        pthread_join(consumer->thread, NULL);
    } else if (!consumer->given_up) {
        consumer->given_up = true;
        if (!cancel(consumer)) give_up(consumer, 2 * consumer->work.stop_timeout);
    }
    if (consumer->abandoned) return; /* the thread may still use its queue and its lock */
    sb_frame_queue_destroy(consumer->queue);
    pthread_cond_destroy(&consumer->idle);
    pthread_mutex_destroy(&consumer->lock);
    consumer->queue = NULL;
    consumer->started = false;
}

bool sb_consumer_thread_remains(const sb_consumer *consumer)
{
    return consumer->abandoned;
}

#include "watch.h"

#include "base/memory.h"
#include "base/stop.h"
#include "process.h"
#include "stream/listen.h"
#include "stream/live.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct sb_soak_watch {
    const sb_soak_run *run;
    char prefix[32];
    sb_listener *listener;
    sb_live *live;
    sb_soak_life *life; /* the current process */
    uint64_t step;      /* the last one that was streamed */
    uint64_t frames;    /* complete frames before the current process */
};

static const double grace = 120;     /* s that a run may take to stop after SIGTERM */
static const double start_up = 1800; /* s that a run may take to its first frame */

static void on_status(void *user, const sb_status_message *message)
{
    sb_soak_watch *w = user;
    w->step = (uint64_t)(message->step > 0 ? message->step : 0);
    if (w->life->first_step == 0) w->life->first_step = w->step;
    w->life->last_step = w->step;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const sb_soak_watch *w = user;
    sb_live_take(w->live, kind, data, size, time);
}

sb_status sb_soak_watch_create(const sb_soak_run *run, sb_soak_watch **watch, sb_error *error)
{
    sb_soak_watch *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the subscriber");
    made->run = run;
    snprintf(made->prefix, sizeof made->prefix, "soak-%ld", (long)getpid());
    const sb_live_calls calls = {.user = made, .status = on_status};
    const sb_listener_calls messages = {.user = made, .message = on_message};
    made->live = sb_live_create(&calls);
    sb_status status = made->live ? SB_OK : sb_fail_memory(error, "the subscriber");
    if (status == SB_OK) status = sb_listener_create(NULL, made->prefix, &messages, &made->listener, error);
    if (status != SB_OK) {
        sb_soak_watch_destroy(made);
        return status;
    }
    sb_stop_watch();
    *watch = made;
    return SB_OK;
}

void sb_soak_watch_destroy(sb_soak_watch *watch)
{
    if (!watch) return;
    sb_listener_destroy(watch->listener);
    sb_live_destroy(watch->live);
    sb_free(watch);
}

static sb_status start(const sb_soak_watch *w, bool resume, sb_process *process, sb_error *error)
{
    const sb_soak_run *run = w->run;
    char spacing[48], duration[48], prefix[64];
    const char *const settings[] = {spacing, duration, prefix, "stream.enabled=true"};
    snprintf(spacing, sizeof spacing, "resolution=%.9g", run->spacing);
    snprintf(duration, sizeof duration, "duration=%.9g", run->duration);
    snprintf(prefix, sizeof prefix, "stream.prefix=%s", w->prefix);
    *process = (sb_process){.death_signal = SIGTERM, .grace = grace};
    snprintf(process->output, sizeof process->output, "%s", run->output);
    sb_process_shorebreak(process, run->program, run->scene, run->out);
    sb_process_set(process, settings, sizeof settings / sizeof *settings);
    sb_process_add(process, resume ? "--resume" : "--overwrite", NULL);
    return sb_process_start(process, error);
}

/* Takes a sample if the process still exists. */
static sb_status take_sample(sb_soak_watch *w, const sb_process *process, sb_error *error)
{
    sb_soak_sample sample = {.seconds = process->wall, .step = w->step};
    return sb_soak_measure(process->id, &sample, NULL) == SB_OK ? sb_soak_add(w->life, &sample, error) : SB_OK;
}

/* After SIGTERM a run ends with 128 + SIGTERM, or with 0 if it had just finished. */
static void note_end(sb_soak_watch *w, const sb_process *process)
{
    char reason[240];
    const int status = sb_process_status(process);
    w->life->seconds = process->stop_sent ? process->stop_time : process->wall;
    w->life->end = status == 0                                     ? SB_SOAK_FINISHED
                   : process->stop_sent && status == 128 + SIGTERM ? SB_SOAK_STOPPED
                                                                   : SB_SOAK_FAILED;
    if (w->life->end != SB_SOAK_FAILED) return;
    sb_process_reason(process, ": ", "no output", reason, sizeof reason);
    snprintf(w->life->message, sizeof w->life->message, "%sended with %s", process->killed ? "did not stop, " : "",
             reason);
}

/* Whether the process has run for so many seconds since its first frame. */
static bool is_time(const sb_soak_watch *w, double now, double seconds, double *first)
{
    if (sb_live_count(w->live).frames_complete > w->frames && *first < 0) *first = now;
    return *first < 0 ? now >= seconds + start_up : now - *first >= seconds;
}

/* Receives messages and takes samples until the process has ended. */
static sb_status follow(sb_soak_watch *w, sb_process *process, double seconds, sb_error *error)
{
    const double pause = fmin(fmax(seconds / 200, 0.02), 2);
    double first = -1; /* s; time of the first frame */
    sb_status status = SB_OK;
    while (!sb_process_poll(process)) {
        if (sb_stop_signal() || is_time(w, process->wall, seconds, &first) || status != SB_OK)
            sb_process_stop(process, SIGTERM);
        if (!process->stop_sent) status = take_sample(w, process, error);
        sb_listener_poll(w->listener, pause);
    }
    note_end(w, process);
    return status;
}

sb_status sb_soak_live(sb_soak_watch *w, bool resume, double seconds, sb_soak_life *life, sb_error *error)
{
    sb_process process;
    const uint64_t lost = sb_live_count(w->live).parts_lost;
    w->frames = sb_live_count(w->live).frames_complete;
    w->life = life;
    w->step = 0;
    life->resumed = resume;
    sb_status status = start(w, resume, &process, error);
    if (status == SB_OK) status = follow(w, &process, seconds, error);
    life->frames = sb_live_count(w->live).frames_complete - w->frames;
    life->chunks_lost = sb_live_count(w->live).parts_lost - lost;
    if (status == SB_OK && sb_stop_signal()) status = sb_fail(error, SB_INTERRUPTED, "stopped by a signal");
    return status;
}

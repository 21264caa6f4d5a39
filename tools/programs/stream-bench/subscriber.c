#include "subscriber.h"

#include "base/clock.h"
#include "stream/listen.h"

#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct view {
    sb_live *live;
    double begun;
    sb_bench_result result;
} view;

static void on_scene(void *user, const sb_live_scene *scene)
{
    (void)scene;
    view *v = user;
    v->result.scene_seconds = sb_clock() - v->begun;
}

static void on_status(void *user, const sb_status_message *message)
{
    view *v = user;
    v->result.ended = message->state == SB_RUN_DONE;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const view *v = user;
    sb_live_take(v->live, kind, data, size, time);
}

static double processor_time(void)
{
    struct timespec used;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* The work of the process. Its result is the struct on the pipe, after one byte when it has subscribed. */
static void receive(const char *url, const char *prefix, double seconds, int out)
{
    view v = {.begun = sb_clock(), .result.scene_seconds = -1};
    const sb_live_calls calls = {.user = &v, .scene = on_scene, .status = on_status};
    const sb_listener_calls messages = {.user = &v, .message = on_message};
    sb_listener *listener = NULL;
    sb_error error = {0};
    v.live = sb_live_create(&calls);
    if (!v.live || sb_listener_create(url, prefix, &messages, &listener, &error) != SB_OK) {
        fprintf(stderr, "subscriber: %s\n", error.text);
        _exit(1);
    }
    if (write(out, "!", 1) != 1) _exit(1);
    const double end = v.begun + seconds;
    while (!v.result.ended && sb_clock() < end) sb_listener_poll(listener, 0.1);
    v.result.counts = sb_live_count(v.live);
    v.result.processor = processor_time();
    _exit(write(out, &v.result, sizeof v.result) == (ssize_t)sizeof v.result ? 0 : 1);
}

sb_status sb_bench_subscribe(const char *url, const char *prefix, double seconds, sb_bench_subscriber *subscriber,
                             sb_error *error)
{
    int ends[2];
    char byte;
    if (pipe(ends) != 0) return sb_fail(error, SB_FAILED, "a subscriber: the system has no pipe");
    fflush(NULL);
    subscriber->process = fork();
    if (subscriber->process == 0) {
        close(ends[0]);
        receive(url, prefix, seconds, ends[1]);
    }
    close(ends[1]);
    subscriber->pipe = ends[0];
    if (subscriber->process < 0 || read(ends[0], &byte, 1) != 1)
        return sb_fail(error, SB_FAILED, "a subscriber could not be started");
    return SB_OK;
}

sb_status sb_bench_result_of(sb_bench_subscriber *subscriber, sb_bench_result *result, sb_error *error)
{
    const ssize_t got = read(subscriber->pipe, result, sizeof *result);
    close(subscriber->pipe);
    waitpid(subscriber->process, NULL, 0);
    return got == (ssize_t)sizeof *result ? SB_OK : sb_fail(error, SB_FAILED, "a subscriber ended without a result");
}

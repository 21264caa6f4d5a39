#include "watch.h"

#include "process.h"

#include "base/clock.h"
#include "base/memory.h"
#include "stream/listen.h"
#include "stream/live.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SAMPLE 0.25    /* s */
#define START_UP 600.0 /* s that a run may take to its first frame */
#define GRACE 60.0     /* s that it may take to stop */

typedef struct state {
    sb_bench_watch *watch;
    sb_live *live;
    sb_listener *listener;
    sb_process process;
    sb_bench_clients *clients;
    double first_frame, sampled; /* s, of sb_clock; 0: none yet */
    double last_step;
    char prefix[48];
} state;

static void on_status(void *user, const sb_status_message *message)
{
    ((state *)user)->last_step = (double)message->step;
}

static void on_frame(void *user, const sb_live_frame *frame)
{
    state *s = user;
    sb_bench_arrivals *arrivals = &s->watch->arrivals;
    const double now = sb_clock();
    if (!(s->first_frame > 0)) s->first_frame = now;
    arrivals->time[frame->frame % SB_BENCH_FRAMES] = now;
    arrivals->newest = frame->frame;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const state *s = user;
    sb_live_take(s->live, kind, data, size, time);
}

/* s of user and system time of a process itself; negative: it has ended. */
static double processor_of(pid_t process)
{
    char path[64], text[1024] = "";
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (!file) return -1;
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = '\0';
    const char *at = strrchr(text, ')'); /* the name may have blanks */
    unsigned long user = 0, system = 0;
    if (!at || sscanf(at + 1, " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &user, &system) != 2) return -1;
    return (double)(user + system) / (double)sysconf(_SC_CLK_TCK);
}

static double memory_of(pid_t process)
{
    char path[64];
    long pages = 0;
    snprintf(path, sizeof path, "/proc/%ld/statm", (long)process);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
    if (file) fclose(file);
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

static pid_t child_of(pid_t process)
{
    char path[80];
    long child = 0;
    snprintf(path, sizeof path, "/proc/%ld/task/%ld/children", (long)process, (long)process);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%ld", &child) != 1) child = 0;
    if (file) fclose(file);
    return (pid_t)child;
}

/* The port that the run has printed; 0: none yet. */
static int port_of(const char *output)
{
    static const char before[] = "live: http://127.0.0.1:";
    char *text = NULL;
    size_t length;
    int port = 0;
    if (sb_file_read(output, 1 << 24, &text, &length, NULL) != SB_OK) return 0;
    const char *at = strstr(text, before);
    if (at) port = atoi(at + sizeof before - 1);
    sb_free(text);
    return port;
}

static void take_sample(state *s, double now)
{
    sb_bench_watch *w = s->watch;
    const double processor = processor_of(s->process.id);
    if (now < s->sampled + SAMPLE || processor < 0) return;
    s->sampled = now;
    if (w->samples < SB_BENCH_SAMPLES && (w->samples == 0 || s->last_step > w->step[w->samples - 1])) {
        w->step[w->samples] = s->last_step;
        w->processor[w->samples++] = processor;
    }
    const pid_t server = child_of(s->process.id), guard = child_of(server), receiver = child_of(guard);
    const double memory = memory_of(server);
    if (!(memory > 0)) return;
    w->memory_end = memory;
    if (s->first_frame > 0 && now < s->first_frame + w->seconds / 4) w->memory_settled = memory;
    w->server_processor = processor_of(server) + fmax(processor_of(receiver), 0);
}

static sb_status start(state *s, sb_error *error)
{
    const sb_bench_watch *w = s->watch;
    const sb_live_calls calls = {.user = s, .status = on_status, .frame = on_frame};
    const sb_listener_calls messages = {.user = s, .message = on_message};
    char prefix[64];
    const char *const settings[] = {prefix, "render.interval=0", "output.particle_interval=0"};
    snprintf(s->prefix, sizeof s->prefix, "live-bench-%ld", (long)getpid());
    snprintf(prefix, sizeof prefix, "stream.prefix=%s", s->prefix);
    s->live = sb_live_create(&calls);
    if (!s->live) return sb_fail_memory(error, "the subscriber");
    sb_status status = sb_listener_create(NULL, s->prefix, &messages, &s->listener, error);
    if (status != SB_OK) return status;
    s->process = (sb_process){.death_signal = SIGTERM, .grace = GRACE};
    snprintf(s->process.output, sizeof s->process.output, "%s", w->output);
    sb_process_shorebreak(&s->process, w->program, w->scene, w->out);
    sb_process_set(&s->process, settings, sizeof settings / sizeof *settings);
    sb_process_add(&s->process, "--overwrite", "--live", (const char *)NULL);
    return sb_process_start(&s->process, error);
}

static void measure_interval(state *s)
{
    const sb_bench_arrivals *a = &s->watch->arrivals;
    double first = 0, last = 0;
    size_t count = 0;
    for (int64_t n = a->newest - 200 > 0 ? a->newest - 200 : 1; n <= a->newest; n++) {
        const double time = a->time[n % SB_BENCH_FRAMES];
        if (!(time > 0)) continue;
        if (count++ == 0) first = time;
        last = time;
    }
    if (count < 2) return;
    s->watch->interval = (last - first) / (double)(count - 1);
    if (s->clients) sb_bench_clients_interval(s->clients, s->watch->interval);
}

/* Watches until the time is over or the run has ended. */
static sb_status follow(state *s, sb_error *error)
{
    sb_bench_watch *w = s->watch;
    const double begun = sb_clock();
    double measured = begun;
    while (!sb_process_poll(&s->process)) {
        sb_listener_poll(s->listener, 0.002);
        const double now = sb_clock();
        if (!(s->first_frame > 0) && now > begun + START_UP) return sb_fail(error, SB_FAILED, "the run sent no frame");
        take_sample(s, now);
        if (s->first_frame > 0 && now > s->first_frame + w->seconds) sb_process_stop(&s->process, SIGTERM);
        const int port = w->clients > 0 && !s->clients && s->first_frame > 0 ? port_of(w->output) : 0;
        if (port > 0 && sb_bench_clients_create(port, w->clients, &s->clients, error) != SB_OK) return SB_FAILED;
        if (s->clients) sb_bench_clients_read(s->clients, &w->arrivals);
        if (now < measured + 1) continue;
        measured = now;
        measure_interval(s);
    }
    return SB_OK;
}

sb_status sb_bench_watch_run(sb_bench_watch *watch, sb_error *error)
{
    state s = {.watch = watch};
    char reason[240];
    sb_status status = start(&s, error);
    if (status == SB_OK) status = follow(&s, error);
    if (status == SB_OK && (watch->samples < 2 || !(s.first_frame > 0))) {
        sb_process_reason(&s.process, ": ", "no output", reason, sizeof reason);
        status = sb_fail(error, SB_FAILED, "the run ended with %s", reason);
    }
    if (s.process.id) {
        sb_process_stop(&s.process, SIGKILL);
        sb_process_wait(&s.process);
    }
    if (s.clients) watch->reception = sb_bench_clients_result(s.clients);
    sb_bench_clients_destroy(s.clients);
    sb_listener_destroy(s.listener);
    sb_live_destroy(s.live);
    return status;
}

double sb_bench_processor_at(const sb_bench_watch *watch, double step)
{
    size_t k = 0;
    while (k + 2 < watch->samples && watch->step[k + 1] < step) k++;
    const double part = (step - watch->step[k]) / (watch->step[k + 1] - watch->step[k]);
    return watch->processor[k] + part * (watch->processor[k + 1] - watch->processor[k]);
}

/* tools/stream-bench: publishes synthetic frames to subscribers in processes of their own. */
#include "arguments.h"
#include "subscriber.h"

#include "base/clock.h"
#include "base/memory.h"
#include "stream/stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { SUBSCRIBERS_MAX = 16, BODIES = 12, FRAMES = 4 }; /* FRAMES: made before, and sent in turns */

static const char help[] =
    "usage: tools/stream-bench [OPTIONS]\n"
    "Publishes frames of synthetic particles over LCM to subscribers in processes of their own. Prints the losses and\n"
    "the processor time of the publisher. Exit status 0: every frame arrived whole, at this rate.\n\n"
    "  --particles N     particles of a frame (default: 1000000)\n"
    "  --rate R          frames per second (default: 10)\n"
    "  --seconds S       duration (default: 10)\n"
    "  --subscribers N   number of subscribers (default: 3)\n"
    "  --url URL         LCM provider of all (default: udpm://239.255.76.67:7667, with the system's receive buffer)\n"
    "  --help            this text\n";

typedef struct options {
    sb_common_options common;
    int particles, subscribers;
    double rate, seconds;
    const char *url;
} options;

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){
        .particles = 1000000, .subscribers = 3, .rate = 10, .seconds = 10, .url = "udpm://239.255.76.67:7667"};
    const sb_argument table[] = {{.name = "--particles", .count = &o->particles, .most = SB_STREAM_TOTAL_MAX},
                                 {.name = "--subscribers", .count = &o->subscribers, .most = SUBSCRIBERS_MAX},
                                 {.name = "--rate", .number = &o->rate, .most = 1000},
                                 {.name = "--seconds", .number = &o->seconds, .most = 3600},
                                 {.name = "--url", .text = &o->url}};
    const sb_command_line line = {.tool = "stream-bench",
                                  .help = help,
                                  .options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .user = o};
    return sb_command_line_read(&line, count, arguments, &o->common, error);
}

/* ---- what is published ---- */

/* A layer of particles, ten spacings deep, in which a wave travels. */
static void fill(sb_frame *frame, double time)
{
    frame->spacing = 1;
    const size_t depth = 10, length = (size_t)sqrt((double)frame->count / (double)depth) + 1;
    for (size_t i = 0; i < frame->count; i++) {
        const double x = (double)(i / depth / length), y = (double)(i / depth % length), z = (double)(i % depth);
        const double rise = sin(0.05 * x - time);
        frame->position[3 * i] = (float)x;
        frame->position[3 * i + 1] = (float)y;
        frame->position[3 * i + 2] = (float)(z * (1 + 0.2 * rise) + 3);
        frame->velocity[3 * i] = (float)rise;
        frame->velocity[3 * i + 1] = frame->velocity[3 * i + 2] = 0;
        frame->pressure[i] = (float)(9810 * ((double)depth - z));
        frame->id[i] = (uint32_t)i;
    }
}

typedef struct source {
    sb_scene scene;
    sb_model model;
    sb_model_body bodies[BODIES];
    sb_force_record forces[BODIES];
} source;

static void set_source(source *s)
{
    s->scene =
        (sb_scene){.dimensions = 3, .resolution = 1, .duration = 1e6, .fluid = {.density = 1000, .gravity = 9.81}};
    s->scene.domain.max = sb_vec(1000, 1000, 20);
    s->scene.render = (sb_render_settings){.width = 1280, .height = 720};
    s->model = (sb_model){.spacing = 1, .still_depth = 10, .body_count = BODIES, .bodies = s->bodies};
    for (int b = 0; b < BODIES; b++) {
        snprintf(s->bodies[b].name, sizeof s->bodies[b].name, "building-%d", b);
        s->bodies[b].report = true;
        s->bodies[b].wavemaker = -1;
    }
}

static double thread_time(void)
{
    struct timespec used;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* Serves the stream until that time, as the stream's thread does between two frames. */
static void wait_until(sb_stream *stream, double time)
{
    for (double now = sb_clock(); now < time; now = sb_clock()) {
        const double pause = fmin(sb_stream_serve(stream), time - now);
        usleep((useconds_t)(1e6 * pause) + 1);
    }
}

/* One second passes before the first frame and after the last one: they hold a cycle of the scene's pieces. */
typedef struct cost {
    uint64_t frames;
    double processor, longest; /* s: of all publishing; of the slowest frame, wall time */
    double seconds;            /* from the first frame to the end of the last one */
} cost;

static void publish(sb_stream *stream, source *s, sb_frame **frames, const options *o, cost *c)
{
    const double begin = sb_clock() + 1;
    wait_until(stream, begin);
    for (uint64_t k = 0; (double)k < o->seconds * o->rate; k++) {
        const double time = (double)k / o->rate;
        sb_frame *frame = frames[k % FRAMES];
        frame->index = k + 1;
        frame->status = (sb_frame_status){.step = k, .time = time, .duration = o->seconds};
        for (size_t b = 0; b < BODIES; b++)
            s->forces[b] = (sb_force_record){.body = b, .time = time, .force = sb_vec(time, 0, 0)};
        const sb_measure_records rows = {.force_count = BODIES, .forces = s->forces};
        sb_stream_measure(stream, &rows);
        wait_until(stream, begin + time);
        const double used = thread_time(), started = sb_clock();
        sb_stream_publish(stream, frame);
        c->processor += thread_time() - used;
        c->longest = fmax(c->longest, sb_clock() - started);
        c->frames++;
    }
    c->seconds = sb_clock() - begin;
    wait_until(stream, sb_clock() + 1);
    sb_stream_finish(stream);
}

/* ---- */

static bool report(const options *o, const cost *c, const sb_bench_result *results, sb_stream_counters sent)
{
    bool whole = sent.errors == 0 && c->seconds < 1.05 * o->seconds + 0.1; /* the publisher kept the rate */
    printf("%d particles, %.3g frames/s, %d subscribers, %s\n", o->particles, o->rate, o->subscribers, o->url);
    printf("publisher: %llu frames in %.2f s, %llu messages, %.1f MB/s, %llu errors, processor %.2f ms per frame, "
           "slowest frame %.0f ms\n",
           (unsigned long long)c->frames, c->seconds, (unsigned long long)sent.messages,
           1e-6 * (double)sent.bytes / c->seconds, (unsigned long long)sent.errors,
           1e3 * c->processor / (double)c->frames, 1e3 * c->longest);
    for (int i = 0; i < o->subscribers; i++) {
        const sb_live_counts *n = &results[i].counts;
        printf("subscriber %d: %llu of %llu frames, %llu messages lost, %llu parts repaired, %llu refused, scene after "
               "%.2f s, processor %.2f ms per frame\n",
               i + 1, (unsigned long long)n->frames_complete, (unsigned long long)c->frames,
               (unsigned long long)n->lost, (unsigned long long)n->parts_repaired, (unsigned long long)n->refused,
               results[i].scene_seconds, 1e3 * results[i].processor / (double)c->frames);
        whole = whole && n->frames_complete == c->frames && n->refused == 0 && results[i].ended;
    }
    return whole;
}

static sb_status measure(const options *o, sb_stream *stream, source *s, cost *c, sb_error *error)
{
    sb_frame *frames[FRAMES] = {NULL};
    sb_status status = sb_stream_set_scene(stream, &s->scene, &s->model, error);
    for (int i = 0; i < FRAMES && status == SB_OK; i++) {
        frames[i] = sb_frame_create((size_t)o->particles, BODIES);
        if (frames[i])
            fill(frames[i], 0.5 * i);
        else
            status = sb_fail_memory(error, "frames");
    }
    if (status == SB_OK) publish(stream, s, frames, o, c);
    for (int i = 0; i < FRAMES; i++) sb_frame_release(frames[i]);
    return status;
}

static sb_status bench(const options *o, bool *whole, sb_error *error)
{
    sb_bench_subscriber subscribers[SUBSCRIBERS_MAX];
    sb_bench_result results[SUBSCRIBERS_MAX];
    char prefix[32];
    static source s;
    cost c = {0};
    sb_stream *stream = NULL;
    snprintf(prefix, sizeof prefix, "bench-%ld", (long)getpid());
    sb_stream_settings settings = {.enabled = true, .decimation = 1};
    snprintf(settings.prefix, sizeof settings.prefix, "%s", prefix);
    settings.url = sb_strdup(o->url);
    if (!settings.url) return sb_fail_memory(error, "the address");
    set_source(&s);
    sb_status status = SB_OK;
    for (int i = 0; i < o->subscribers && status == SB_OK; i++)
        status = sb_bench_subscribe(o->url, prefix, 3 * o->seconds + 20, &subscribers[i], error);
    if (status == SB_OK) status = sb_stream_create(&settings, "bench", &stream, error);
    if (status == SB_OK) status = measure(o, stream, &s, &c, error);
    for (int i = 0; i < o->subscribers && status == SB_OK; i++)
        status = sb_bench_result_of(&subscribers[i], &results[i], error);
    if (status == SB_OK) *whole = report(o, &c, results, sb_stream_count(stream));
    sb_stream_destroy(stream);
    sb_free(settings.url);
    return status;
}

int main(int count, char **arguments)
{
    options o;
    sb_error error = {0};
    bool whole = false;
    sb_status status = parse(count, arguments, &o, &error);
    if (o.common.answered) return 0;
    if (status == SB_OK) status = bench(&o, &whole, &error);
    return sb_tool_end("stream-bench", status, whole ? 0 : 1, &error);
}

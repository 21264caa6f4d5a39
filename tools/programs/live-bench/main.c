/* tools/live-bench: a run without and with clients of its web server. */
#include "arguments.h"
#include "process.h"
#include "watch.h"

#include "base/memory.h"
#include "base/stop.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char help[] =
    "usage: tools/live-bench [OPTIONS]\n"
    "Runs a scene with --live twice: without clients, and with clients that read frames. The first one stops reading,\n"
    "the second one reads 1 kB/s, and half of the others leave and join again. Prints the run's processor time up to\n"
    "the same step, delays of frames and the server's memory. Exit status 0: the clients cost at most 3 % of the "
    "run's\n"
    "processor time, no frame is more than one interval late, and the memory is flat.\n\n"
    "  --seconds S   of each run, after its first frame (default: 300)\n"
    "  --clients N   (default: 8)\n"
    "  --scene FILE  (default: assets/scenes/plant.yaml)\n"
    "  --out DIR     folder of the runs (default: runs/live-bench)\n"
    "  --help        this text\n";

typedef struct options {
    sb_common_options common;
    double seconds;
    int clients;
    const char *scene;
} options;

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.seconds = 300, .clients = 8, .scene = SB_SOURCE_DIR "/assets/scenes/plant.yaml"};
    const sb_argument table[] = {{.name = "--seconds", .number = &o->seconds, .most = 86400},
                                 {.name = "--clients", .count = &o->clients, .most = 30},
                                 {.name = "--scene", .text = &o->scene}};
    const sb_command_line line = {.tool = "live-bench",
                                  .help = help,
                                  .has = SB_HAS_OUT,
                                  .options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .user = o};
    return sb_command_line_read(&line, count, arguments, &o->common, error);
}

static bool judge(const sb_bench_watch *alone, const sb_bench_watch *shown)
{
    const sb_bench_reception *r = &shown->reception;
    const double step = fmin(alone->step[alone->samples - 1], shown->step[shown->samples - 1]);
    const double a = sb_bench_processor_at(alone, step), b = sb_bench_processor_at(shown, step);
    const double grown = shown->memory_end - shown->memory_settled;
    const bool cheap = b <= 1.03 * a, prompt = r->frames > 0 && r->late == 0;
    const bool flat = grown <= 0.03 * shown->memory_settled + 4e6;
    printf("processor time of the run up to step %.0f: %.2f s without clients, %.2f s with %zu, %+.1f %%: %s\n", step,
           a, b, shown->clients, 100 * (b / a - 1), cheap ? "met" : "missed");
    printf("frames: %llu at the clients that read well, %.3f s apart; %llu late, at most by %.3f s: %s\n",
           (unsigned long long)r->frames, shown->interval, (unsigned long long)r->late, r->latest,
           prompt ? "met" : "missed");
    printf("memory of the server: %.1f MB after a quarter, %.1f MB at the end: %s\n", 1e-6 * shown->memory_settled,
           1e-6 * shown->memory_end, flat ? "met" : "missed");
    printf("clients joined %llu times, %llu were dropped by the server; %.1f MB were read; server: %.1f s of processor "
           "time\n",
           (unsigned long long)r->joins, (unsigned long long)r->dropped, 1e-6 * (double)r->bytes,
           shown->server_processor);
    return cheap && prompt && flat;
}

static sb_status measure(const options *o, sb_bench_watch *watches, bool *met, sb_error *error)
{
    char program[SB_PATH_MAX], folder[2][SB_PATH_MAX], output[2][SB_PATH_MAX];
    const char *top = o->common.out ? o->common.out : "runs/live-bench";
    sb_status status = sb_process_beside("shorebreak", program, error);
    for (int i = 0; i < 2 && status == SB_OK; i++) {
        sb_bench_watch *w = &watches[i];
        status = sb_path_join(folder[i], top, i ? "shown" : "alone", error);
        if (status == SB_OK) status = sb_path_join(output[i], top, i ? "shown.txt" : "alone.txt", error);
        if (status == SB_OK) status = sb_make_directories(top, error);
        w->program = program;
        w->scene = o->scene;
        w->out = folder[i];
        w->output = output[i];
        w->seconds = o->seconds;
        w->clients = i ? (size_t)o->clients : 0;
        if (status == SB_OK) status = sb_bench_watch_run(w, error);
        if (status == SB_OK && sb_stop_signal()) status = SB_INTERRUPTED;
    }
    if (status == SB_OK) *met = judge(&watches[0], &watches[1]);
    return status;
}

int main(int count, char **arguments)
{
    options o;
    sb_error error = {0};
    bool met = true;
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && !o.common.answered) {
        sb_bench_watch *watches = sb_alloc(2, sizeof *watches);
        sb_stop_watch();
        status = watches ? measure(&o, watches, &met, &error) : sb_fail_memory(&error, "the samples");
        sb_free(watches);
    }
    return sb_tool_end("live-bench", status, met ? 0 : 1, &error);
}

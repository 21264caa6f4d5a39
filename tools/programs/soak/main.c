/* tools/soak: stops and resumes a run for hours; checks that its memory does not grow and that it does not fail. */
#include "base/clock.h"
#include "base/memory.h"
#include "markdown.h"
#include "options.h"
#include "report.h"
#include "watch.h"

#include <stdio.h>

enum { PROCESS_FAILED = 4, NO_ROUTE = 77 }; /* exit statuses */

typedef struct soak {
    sb_soak_options options;
    sb_store store;
    char scene[SB_PATH_MAX], out[SB_PATH_MAX], output[SB_PATH_MAX];
    sb_soak_life *lives;
    size_t count, capacity;
    double start;
} soak;

static sb_status name_files(soak *s, sb_error *error)
{
    sb_status status = sb_store_open(&s->store, &s->options.common, "runs/soak", "assets/scenes", false, error);
    if (status == SB_OK) status = sb_path_join(s->scene, s->store.assets, "plant.yaml", error);
    if (status == SB_OK) status = sb_path_join(s->out, s->store.out, "run", error);
    return status == SB_OK ? sb_path_join(s->output, s->store.out, "output.txt", error) : status;
}

/* Runs until the time is over and a run was resumed, or until a process fails: a resumed run would hide the failure. */
static sb_status run_all(soak *s, sb_soak_watch *watch, sb_error *error)
{
    sb_status status = SB_OK;
    bool resume = false, failed = false;
    while (status == SB_OK && !failed) {
        const double gone = sb_clock() - s->start, left = 60 * s->options.minutes - gone;
        if (left <= 0 && s->count >= 2) return SB_OK;
        if (sb_grow((void **)&s->lives, &s->capacity, s->count + 1, sizeof *s->lives) != 0)
            return sb_fail_memory(error, "lives");
        sb_soak_life *life = &s->lives[s->count++];
        *life = (sb_soak_life){.begun = gone};
        status = sb_soak_live(watch, resume, left > 0 && left < s->options.life ? left : s->options.life, life, error);
        resume = life->end == SB_SOAK_STOPPED;
        failed = life->end == SB_SOAK_FAILED;
    }
    return status;
}

/* The report of a stopped soak goes to the folder of its run; docs/results has only complete ones. */
static sb_status write_reports(const soak *s, bool whole, sb_soak_report *report, sb_error *error)
{
    char why[400];
    *report = (sb_soak_report){.options = &s->options,
                               .store = &s->store,
                               .lives = s->lives,
                               .count = s->count,
                               .seconds = sb_clock() - s->start};
    for (size_t i = 0; i < s->count; i++) {
        report->failed += !sb_soak_passed(&s->lives[i], why);
        report->frames += s->lives[i].frames;
        report->judged += sb_soak_growth_of(&s->lives[i]).judged;
    }
    const char *out = s->store.out, *folder = whole ? s->store.report : out;
    sb_status status = sb_report_write(out, "samples.csv", sb_soak_put_samples, report, error);
    return status == SB_OK ? sb_report_write(folder, "soak.md", sb_soak_put, report, error) : status;
}

static int print_result(const soak *s, const sb_soak_report *report)
{
    char why[400];
    for (size_t i = 0; i < s->count; i++)
        if (!sb_soak_passed(&s->lives[i], why))
            printf("process %zu, started at minute %.1f: %s\n", i + 1, s->lives[i].begun / 60, why);
    printf("%zu processes, %zu of them long enough to judge their growth, %zu failed; %llu frames received\n", s->count,
           report->judged, report->failed, (unsigned long long)report->frames);
    return report->failed > 0 || report->frames == 0 ? PROCESS_FAILED : 0;
}

static void free_all(soak *s, sb_soak_watch *watch)
{
    sb_soak_watch_destroy(watch);
    for (size_t i = 0; i < s->count; i++) sb_free(s->lives[i].samples);
    sb_free(s->lives);
}

int main(int count, char **arguments)
{
    static soak s;
    s.start = sb_clock();
    sb_error error = {0};
    sb_soak_watch *watch = NULL;
    sb_soak_report report = {0};
    sb_status status = sb_soak_options_parse(count, arguments, &s.options, &error);
    if (status == SB_OK && s.options.common.answered) return 0;
    if (status == SB_OK) status = name_files(&s, &error);
    const sb_soak_run run = {.program = s.store.program,
                             .scene = s.scene,
                             .out = s.out,
                             .output = s.output,
                             .spacing = s.options.spacing,
                             .duration = s.options.duration};
    if (status == SB_OK && sb_soak_watch_create(&run, &watch, &error) != SB_OK) {
        fprintf(stderr, "soak: %s\n", error.text);
        return NO_ROUTE;
    }
    if (status == SB_OK) status = run_all(&s, watch, &error);
    if (s.count > 0 && (status == SB_OK || status == SB_INTERRUPTED)) {
        sb_status written = write_reports(&s, status == SB_OK, &report, status == SB_OK ? &error : NULL);
        status = status == SB_OK ? written : status;
    }
    const int result = sb_tool_end("soak", status, status == SB_OK ? print_result(&s, &report) : 0, &error);
    free_all(&s, watch);
    return result;
}

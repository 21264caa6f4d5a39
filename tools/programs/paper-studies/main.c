/* tools/paper-studies: repeats the published studies of time step, tolerance and spacing on our plant. */
#include "arguments.h"
#include "studies.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double QUICK_SCALE = 4;

typedef struct options {
    const char *out, *report, *program;
    bool quick, report_only, help;
    int jobs;
    char command[64];
} options;

static const char help[] =
    "usage: tools/paper-studies [OPTIONS]\n"
    "Repeats the studies of Sampath et al. (2016, Tables 1 to 10) with assets/scenes/plant.yaml and\n"
    "compares the figures with the published ones: time step, tolerance, and spacings of 5, 4, 3 and\n"
    "2 m. At 1 m, some steps are run and the rest is extrapolated, as the report says.\n\n"
    "  --quick          spacings four times as large; the report goes to OUT/quick\n"
    "  --jobs N         N runs at a time with one thread each; 1: one run with all cores (1)\n"
    "  --report-only    runs nothing; writes the report again from stored runs\n"
    "  --out DIR        folder of stored runs (build/paper-studies)\n"
    "  --report DIR     folder of the report (docs/results)\n"
    "  --shorebreak F   program that runs the scene (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Finished runs are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 done, 1 bad input, 2 a run failed, 130 stopped.\n";

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.jobs = 1};
    const sb_argument table[] = {{.name = "--quick", .flag = &o->quick},
                                 {.name = "--report-only", .flag = &o->report_only},
                                 {.name = "--jobs", .count = &o->jobs, .most = 256},
                                 {.name = "--out", .text = &o->out},
                                 {.name = "--report", .text = &o->report},
                                 {.name = "--shorebreak", .text = &o->program}};
    const sb_command_line line = {.options = table, .option_count = sizeof table / sizeof *table, .help = &o->help};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    snprintf(o->command, sizeof o->command, "tools/paper-studies%s --jobs %d", o->quick ? " --quick" : "", o->jobs);
    return status;
}

static sb_status run(const options *o, sb_paper_studies *studies, size_t *failed, sb_error *error)
{
    sb_store store;
    char folder[SB_PATH_MAX];
    sb_status status = sb_trials_store(&store, o->out ? o->out : SB_SOURCE_DIR "/build/paper-studies", o->program,
                                       SB_SOURCE_DIR, error);
    if (status != SB_OK) return status;
    sb_paper_begin(studies, &store, o->quick ? QUICK_SCALE : 1, o->command);
    status = sb_trials_make(&store, studies->trials, studies->count, o->jobs, o->report_only, failed, error);
    if (status == SB_OK) status = sb_paper_costs(studies, error);
    snprintf(folder, sizeof folder, "%s", o->report ? o->report : SB_SOURCE_DIR "/docs/results");
    if (status == SB_OK && o->quick && !o->report) status = sb_path_join(folder, store.out, "quick", error);
    if (status == SB_OK) status = sb_paper_write(studies, folder, error);
    if (status == SB_OK) printf("%s/paper-studies.md\n", folder);
    return status;
}

int main(int count, char **arguments)
{
    static sb_paper_studies studies;
    options o;
    sb_error error = {0};
    size_t failed = 0;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count == 2 && strcmp(arguments[1], "--version") == 0) {
        printf("shorebreak-paper-studies %s\n", SB_VERSION);
        return 0;
    }
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && o.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = run(&o, &studies, &failed, &error);
    sb_paper_free(&studies);
    if (status != SB_OK) fprintf(stderr, "paper-studies: %s\n", error.text);
    if (status != SB_OK) return status == SB_INTERRUPTED ? 130 : (int)status;
    return failed ? SB_FAILED : 0;
}

/* tools/paper-studies: repeats the published studies of time step, tolerance and spacing on our plant. */
#include "arguments.h"
#include "studies.h"

static const double QUICK_SCALE = 4;

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

static sb_status run(sb_common_options *o, sb_paper_studies *studies, int *result, sb_error *error)
{
    static sb_store store;
    if (!o->jobs) o->jobs = 1;
    snprintf(o->command, sizeof o->command, "tools/paper-studies%s --jobs %d", o->quick ? " --quick" : "", o->jobs);
    sb_status status =
        sb_store_open(&store, o, SB_SOURCE_DIR "/build/paper-studies", "assets/validation", false, error);
    if (status != SB_OK) return status;
    sb_paper_begin(studies, &store, o->quick ? QUICK_SCALE : 1);
    status = sb_runs_make(&store, studies->trials, studies->count, error);
    if (status == SB_OK) status = sb_paper_costs(studies, error);
    if (status == SB_OK) status = sb_paper_write(studies, error);
    sb_results_free(studies->trials, studies->count);
    *result = store.failed ? SB_FAILED : 0;
    return status;
}

int main(int count, char **arguments)
{
    static sb_paper_studies studies;
    sb_common_options o;
    sb_error error = {0};
    int result = 0;
    const sb_command_line line = {.tool = "paper-studies",
                                  .help = help,
                                  .has = SB_HAS_QUICK | SB_HAS_REPORT_ONLY | SB_HAS_JOBS | SB_HAS_OUT | SB_HAS_REPORT |
                                         SB_HAS_PROGRAM};
    sb_status status = sb_command_line_read(&line, count, arguments, &o, &error);
    if (status == SB_OK && !o.answered) status = run(&o, &studies, &result, &error);
    return sb_tool_end("paper-studies", status, result, &error);
}

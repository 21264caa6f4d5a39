/* tools/tradeoff: compares run time and error of choices of solver and parameters. */
#include "arguments.h"
#include "contest_report.h"
#include "origin.h"

#include "base/memory.h"

typedef struct options {
    sb_common_options common;
    sb_contest_selection selection;
    sb_selection subjects; /* rows of sb_subjects */
} options;

static const char help[] =
    "usage: tools/tradeoff [SCENE...] [OPTIONS]\n"
    "Runs scenes that have a reference with many choices of solver and parameters, and reports run\n"
    "time and error of each. Without a SCENE: all scenes.\n\n"
    "  --quick          fewer choices at coarse spacings, one seed; the report goes to OUT/quick\n"
    "  --few            fewer choices at the spacings of the full form\n"
    "  --spacings N     only the N coarsest spacings of each scene\n"
    "  --spacing R      only this spacing, in m, and its reference\n"
    "  --choice TEXT    only `default` and the choices whose names contain TEXT, in any form\n"
    "  --list           lists scenes and choices\n"
    "  --seeds N        start seeds of every run (3; quick: 1)\n"
    "  --references N   start seeds of the reference run of the plant, 1 or 2 (default: --seeds)\n"
    "  --reference R    spacing of this run, in m (2; quick: 6)\n"
    "  --jobs N         N runs at a time with one thread each, compared by processor time; 1: one run\n"
    "                   with all cores, compared by run time (1; quick: the number of cores)\n"
    "  --report-only    runs nothing; writes the report again from stored runs\n"
    "  --out DIR        folder of stored runs (build/tradeoff)\n"
    "  --report DIR     folder of the report (docs/results; for some of the scenes OUT/some)\n"
    "  --shorebreak F   program that runs the scenes (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Finished runs are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 done, 1 bad input, 2 a run failed, 130 stopped.\n";

static const char *subject_name(size_t row)
{
    return sb_subjects[row].name;
}

static void list(void)
{
    puts("scenes:");
    for (const sb_subject *s = sb_subjects; s->name; s++) printf("  %-16s %s\n", s->name, s->title);
    puts("choices (*: also in the quick forms):");
    for (const sb_choice *c = sb_choices; c->name; c++) printf("%c %s\n", c->quick ? '*' : ' ', c->name);
}

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.subjects = {.what = "scene", .name = subject_name}};
    sb_contest_selection *s = &o->selection;
    const sb_argument table[] = {
        {.name = "--few", .flag = &s->few, .repeated = true},
        {.name = "--spacings", .count = &s->spacings, .most = 64, .repeated = true},
        {.name = "--spacing", .number = &s->spacing, .most = 1e6, .repeated = true},
        {.name = "--choice", .text = &s->choice, .repeated = true},
        {.name = "--report-only", .flag = &o->common.report_only},
        {.name = "--seeds", .count = &s->seeds, .most = SB_ENTRY_SEEDS, .repeated = true},
        {.name = "--references", .count = &s->references, .most = SB_REFERENCE_SEEDS, .repeated = true},
        {.name = "--reference", .number = &s->reference, .most = 1e6, .repeated = true}};
    const sb_command_line line = {.tool = "tradeoff",
                                  .help = help,
                                  .list = list,
                                  .has = SB_HAS_QUICK | SB_HAS_LIST | SB_HAS_JOBS | SB_HAS_OUT | SB_HAS_REPORT |
                                         SB_HAS_PROGRAM,
                                  .options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .selection = &o->subjects};
    sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    s->quick = o->common.quick;
    if (!s->seeds) s->seeds = s->quick ? 1 : 3;
    if (!o->common.jobs) o->common.jobs = s->quick ? sb_origin_cores() : 1;
    if (!o->subjects.count) sb_selection_all(&o->subjects);
    return status;
}

/* Prepares the contests of the selected scenes that have the selected spacing. */
static sb_status begin(const options *o, const sb_store *store, sb_contest_report *report, sb_contest *contests,
                       sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < o->subjects.count; i++) {
        sb_contest *c = &contests[report->count];
        status = sb_contest_begin(c, &sb_subjects[o->subjects.rows[i]], store, &o->selection, error);
        if (status == SB_OK && c->trial_count > 0)
            report->count++;
        else
            sb_contest_free(c);
    }
    if (status == SB_OK && report->count == 0 && o->selection.choice)
        status =
            sb_fail(error, SB_BAD_INPUT,
                    "--choice %s: no selected scene has such a choice at the selected spacings, expected a part of a "
                    "name of --list",
                    o->selection.choice);
    else if (status == SB_OK && report->count == 0 && !(o->selection.spacing > 0))
        status = sb_fail(error, SB_BAD_INPUT, "--quick: %s has no quick form, expected a scene that has one",
                         sb_subjects[o->subjects.rows[0]].name);
    else if (status == SB_OK && report->count == 0)
        status = sb_fail(error, SB_BAD_INPUT,
                         "--spacing %g: no selected scene has this spacing, expected one of the report's tables (m)",
                         o->selection.spacing);
    return status;
}

static sb_status run(const options *o, sb_contest *contests, int *result, sb_error *error)
{
    static sb_store store;
    sb_contest_report report = {.store = &store, .contests = contests};
    sb_status status =
        sb_store_open(&store, &o->common, SB_SOURCE_DIR "/build/tradeoff", "assets/validation", false, error);
    if (status == SB_OK) status = begin(o, &store, &report, contests, error);
    for (sb_contest *c = contests; status == SB_OK && c < contests + report.count; c++) {
        status = sb_contest_make(c, &store, error);
        if (status == SB_OK) status = sb_contest_judge(c, sb_contest_cpu(&store), error);
    }
    /* A report of some scenes or choices must not replace that of all. */
    if (status == SB_OK && (o->selection.choice || (!o->common.quick && sb_subjects[report.count].name)))
        status = sb_store_report(&store, "some", error);
    *result = store.failed ? SB_FAILED : 0;
    return status == SB_OK ? sb_contest_write(&report, error) : status;
}

int main(int count, char **arguments)
{
    options o;
    sb_contest contests[SB_ROWS_MAX] = {{0}};
    sb_error error = {0};
    int result = 0;
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && !o.common.answered) status = run(&o, contests, &result, &error);
    for (size_t i = 0; i < SB_ROWS_MAX; i++) sb_contest_free(&contests[i]);
    return sb_tool_end("tradeoff", status, result, &error);
}

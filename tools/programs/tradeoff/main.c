/* tools/tradeoff: compares run time and error of choices of solver and parameters. */
#include "arguments.h"
#include "contest_report.h"

#include "base/memory.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { SUBJECTS = 16 };

typedef struct options {
    const char *out, *report, *program;
    bool report_only, list, help;
    sb_contest_selection selection;
    int jobs;
    const sb_subject *subjects[SUBJECTS];
    size_t subject_count;
    char command[512];
} options;

static const char help[] =
    "usage: tools/tradeoff [SCENE...] [OPTIONS]\n"
    "Runs scenes that have a reference with many choices of solver and parameters, and reports run\n"
    "time and error of each. Without a SCENE: all scenes.\n\n"
    "  --quick          fewer choices at coarse spacings, one seed; the report goes to OUT/quick\n"
    "  --few            fewer choices at the spacings of the full form\n"
    "  --spacings N     only the N coarsest spacings of each scene\n"
    "  --spacing R      only this spacing, in m, and its reference\n"
    "  --list           lists scenes and choices\n"
    "  --seeds N        start seeds of every run (3; quick: 1)\n"
    "  --references N   start seeds of the reference run of the plant, 1 or 2 (default: --seeds)\n"
    "  --jobs N         N runs at a time with one thread each, compared by processor time; 1: one run\n"
    "                   with all cores, compared by run time (1; quick: the number of cores)\n"
    "  --report-only    runs nothing; writes the report again from stored runs\n"
    "  --out DIR        folder of stored runs (build/tradeoff)\n"
    "  --report DIR     folder of the report (docs/results; for some of the scenes OUT/some)\n"
    "  --shorebreak F   program that runs the scenes (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Finished runs are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 done, 1 bad input, 2 a run failed, 130 stopped.\n";

static sb_status take_subject(void *user, const char *name, sb_error *error)
{
    options *o = user;
    for (const sb_subject *s = sb_subjects; s->name; s++)
        if (strcmp(s->name, name) == 0 && o->subject_count < SUBJECTS) {
            o->subjects[o->subject_count++] = s;
            return SB_OK;
        }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such scene; --list shows the scenes", name);
}

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.command = "tools/tradeoff"};
    const sb_argument table[] = {
        {.name = "--quick", .flag = &o->selection.quick, .repeated = true},
        {.name = "--few", .flag = &o->selection.few, .repeated = true},
        {.name = "--spacings", .count = &o->selection.spacings, .most = 64, .repeated = true},
        {.name = "--spacing", .number = &o->selection.spacing, .most = 1e6, .repeated = true},
        {.name = "--report-only", .flag = &o->report_only},
        {.name = "--list", .flag = &o->list},
        {.name = "--seeds", .count = &o->selection.seeds, .most = SB_ENTRY_SEEDS, .repeated = true},
        {.name = "--references", .count = &o->selection.references, .most = SB_REFERENCE_SEEDS, .repeated = true},
        {.name = "--jobs", .count = &o->jobs, .most = 256, .repeated = true},
        {.name = "--out", .text = &o->out},
        {.name = "--report", .text = &o->report},
        {.name = "--shorebreak", .text = &o->program}};
    const sb_command_line line = {.options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .operand = take_subject,
                                  .user = o,
                                  .help = &o->help,
                                  .command = o->command,
                                  .command_size = sizeof o->command};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    if (!o->selection.seeds) o->selection.seeds = o->selection.quick ? 1 : 3;
    if (!o->jobs) o->jobs = o->selection.quick ? (int)sysconf(_SC_NPROCESSORS_ONLN) : 1;
    if (!o->subject_count)
        for (const sb_subject *s = sb_subjects; s->name; s++) o->subjects[o->subject_count++] = s;
    return status;
}

static void list(void)
{
    puts("scenes:");
    for (const sb_subject *s = sb_subjects; s->name; s++) printf("  %-16s %s\n", s->name, s->title);
    puts("choices (*: also in the quick forms):");
    for (const sb_choice *c = sb_choices; c->name; c++) printf("%c %s\n", c->quick ? '*' : ' ', c->name);
}

static size_t all_subjects(void)
{
    size_t count = 0;
    while (sb_subjects[count].name) count++;
    return count;
}

static sb_status report(const options *o, const sb_store *store, const sb_contest *contests, size_t count,
                        sb_error *error)
{
    char folder[SB_PATH_MAX];
    const sb_contest_report what = {.store = store,
                                    .contests = contests,
                                    .count = count,
                                    .command = o->command,
                                    .quick = o->selection.quick,
                                    .cpu = o->jobs > 1};
    sb_status status = SB_OK;
    snprintf(folder, sizeof folder, "%s", o->report ? o->report : SB_SOURCE_DIR "/docs/results");
    if (!o->report && (o->selection.quick || count < all_subjects()))
        status = sb_path_join(folder, store->out, o->selection.quick ? "quick" : "some", error);
    if (status == SB_OK) status = sb_contest_write(&what, folder, error);
    if (status == SB_OK) printf("%s/tradeoff.md\n", folder);
    return status;
}

static sb_status run(const options *o, sb_contest *contests, size_t *failed, sb_error *error)
{
    sb_store store;
    size_t count = 0;
    sb_status status =
        sb_trials_store(&store, o->out ? o->out : SB_SOURCE_DIR "/build/tradeoff", o->program, SB_SOURCE_DIR, error);
    for (size_t i = 0; status == SB_OK && i < o->subject_count; i++) {
        status = sb_contest_begin(&contests[count], o->subjects[i], &store, &o->selection, error);
        if (status == SB_OK && contests[count].trial_count > 0)
            count++;
        else
            sb_contest_free(&contests[count]);
    }
    if (status == SB_OK && count == 0)
        status = sb_fail(error, SB_BAD_INPUT,
                         "--spacing %g: no selected scene has this spacing, expected one of the report's tables (m)",
                         o->selection.spacing);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        size_t these = 0;
        status =
            sb_trials_make(&store, contests[i].trials, contests[i].trial_count, o->jobs, o->report_only, &these, error);
        *failed += these;
        if (status == SB_OK) status = sb_contest_judge(&contests[i], o->jobs > 1, error);
    }
    return status == SB_OK ? report(o, &store, contests, count, error) : status;
}

int main(int count, char **arguments)
{
    options o;
    sb_contest contests[SUBJECTS] = {{0}};
    sb_error error = {0};
    size_t failed = 0;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count == 2 && strcmp(arguments[1], "--version") == 0) {
        printf("shorebreak-tradeoff %s\n", SB_VERSION);
        return 0;
    }
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && (o.help || o.list)) {
        if (o.help) fputs(help, stdout);
        if (!o.help) list();
        return 0;
    }
    if (status == SB_OK) status = run(&o, contests, &failed, &error);
    for (size_t i = 0; i < SUBJECTS; i++) sb_contest_free(&contests[i]);
    if (status != SB_OK) fprintf(stderr, "tradeoff: %s\n", error.text);
    if (status != SB_OK) return status == SB_INTERRUPTED ? 130 : (int)status;
    return failed ? SB_FAILED : 0;
}

/* Command line of the validation. */
#include "launch.h"
#include "report.h"
#include "sensitivity.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CASES_MAX = 64, SHORT_OF_REACH = 4 };

typedef struct options {
    const char *out, *report, *program;
    bool all, quick, list, report_only, sensitivity, help;
    int jobs;
    const sb_case *cases[CASES_MAX];
    size_t count;
    char command[1024];
} options;

static const char help[] =
    "usage: tools/validate [CASE...|--all] [OPTIONS]\n"
    "Runs the cases, compares them with experiment and theory, and writes the report.\n\n"
    "  --all            every case\n"
    "  --quick          cheap forms; the report goes to OUT/quick\n"
    "  --sensitivity    what 25 % of every numeric default does to the cases' quick forms\n"
    "  --list           names the cases\n"
    "  --report-only    runs nothing; remakes the report from what was run\n"
    "  --out DIR        where runs are kept (build/validation)\n"
    "  --report DIR     where the report goes (docs/results)\n"
    "  --jobs N         N runs at a time with one thread each; 1: one with all cores (1; quick: "
    "as\n"
    "                   many as cores)\n"
    "  --shorebreak F   the program that runs (the one built beside this)\n"
    "  --help, --version\n\n"
    "Finished runs are kept and not repeated while program and scene stay the same.\n"
    "Exit status: 0 all judged figures within reach, 1 bad input, 2 a run failed, 4 some figure "
    "is\n"
    "short of its reach, 130 stopped.\n";

static const sb_case *find_case(const char *name)
{
    for (size_t i = 0; sb_cases[i]; i++)
        if (strcmp(sb_cases[i]->name, name) == 0) return sb_cases[i];
    return NULL;
}

static sb_status take_case(options *o, const char *name, sb_error *error)
{
    const sb_case *of = find_case(name);
    if (!of) return sb_fail(error, SB_BAD_INPUT, "%.200s: no such case; --list names them", name);
    if (o->count == CASES_MAX) return sb_fail(error, SB_BAD_INPUT, "too many cases");
    o->cases[o->count++] = of;
    return SB_OK;
}

static sb_status take_value(options *o, const char *name, const char *value, sb_error *error)
{
    if (!value) return sb_fail(error, SB_BAD_INPUT, "%s: a value is missing; see --help", name);
    if (strcmp(name, "--out") == 0) o->out = value;
    if (strcmp(name, "--report") == 0) o->report = value;
    if (strcmp(name, "--shorebreak") == 0) o->program = value;
    if (strcmp(name, "--jobs") != 0) return SB_OK;
    char *end;
    long jobs = strtol(value, &end, 10);
    if (end == value || *end || jobs < 1 || jobs > 256)
        return sb_fail(error, SB_BAD_INPUT, "--jobs: %.50s is no number from 1 to 256", value);
    o->jobs = (int)jobs;
    return SB_OK;
}

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {{"--all", &o->all},
                 {"--quick", &o->quick},
                 {"--list", &o->list},
                 {"--report-only", &o->report_only},
                 {"--sensitivity", &o->sensitivity},
                 {"--help", &o->help}};
    static const char *const valued[] = {"--out", "--report", "--shorebreak", "--jobs"};
    sb_status status = SB_OK;
    size_t length = (size_t)snprintf(o->command, sizeof o->command, "tools/validate");
    for (int i = 1; status == SB_OK && i < count; i++) {
        const char *argument = arguments[i];
        bool known = false;
        if (length < sizeof o->command)
            length += (size_t)snprintf(o->command + length, sizeof o->command - length, " %.200s",
                                       argument);
        for (size_t k = 0; k < sizeof flags / sizeof *flags; k++)
            if (strcmp(argument, flags[k].name) == 0) known = *flags[k].flag = true;
        for (size_t k = 0; !known && k < sizeof valued / sizeof *valued; k++)
            if (strcmp(argument, valued[k]) == 0) {
                known = true;
                status = take_value(o, argument, i + 1 < count ? arguments[++i] : NULL, error);
            }
        if (!known && argument[0] == '-')
            status = sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", argument);
        else if (!known)
            status = take_case(o, argument, error);
    }
    return status;
}

static void list_cases(void)
{
    for (size_t i = 0; sb_cases[i]; i++)
        printf("%-24s %s\n", sb_cases[i]->name, sb_cases[i]->title);
}

/* Turns in which runs are made: what is learnt first is learnt of all cases. */
static int turn_of(const sb_request *request)
{
    return request->seed > 1 ? 2 : request->paper ? 1 : 0;
}

/* Appends the requests of a case that belong to this turn. */
static sb_status gather(const sb_case *of, bool quick, int turn, sb_request **all, size_t *count,
                        size_t *capacity, sb_error *error)
{
    sb_request *requests = NULL;
    size_t found = 0;
    sb_status status = sb_case_requests(of, quick, &requests, &found, error);
    for (size_t i = 0; status == SB_OK && i < found; i++) {
        if (turn_of(&requests[i]) != turn) continue;
        if (sb_grow((void **)all, capacity, *count + 1, sizeof **all) != 0)
            status = sb_fail_memory(error, "runs");
        else
            (*all)[(*count)++] = requests[i];
    }
    sb_free(requests);
    return status;
}

static sb_status run_cases(const sb_store *store, const options *o, size_t *failed, sb_error *error)
{
    sb_request *all = NULL;
    size_t count = 0, capacity = 0;
    sb_status status = SB_OK;
    for (int turn = 0; turn < 3; turn++)
        for (size_t c = 0; status == SB_OK && c < o->count; c++)
            status = gather(o->cases[c], o->quick, turn, &all, &count, &capacity, error);
    if (status == SB_OK) status = sb_launch(store, all, count, o->jobs, failed, error);
    sb_free(all);
    return status;
}

/* Of every case there is, run now or not; *short_of: how many judged figures of the chosen cases
 * fail. */
static sb_status report(const sb_store *store, const options *o, size_t *short_of, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_case_results results[CASES_MAX] = {{0}};
    size_t count = 0;
    sb_status status = SB_OK;
    for (; status == SB_OK && sb_cases[count] && count < CASES_MAX; count++)
        status = sb_results_collect(store, sb_cases[count], o->quick, true, &results[count], error);
    const sb_report what = {
        .store = store, .cases = results, .count = count, .command = o->command, .quick = o->quick};
    snprintf(folder, sizeof folder, "%s", o->report ? o->report : SB_SOURCE_DIR "/docs/results");
    if (status == SB_OK && o->quick && !o->report)
        status = sb_path_join(folder, store->out, "quick", error);
    if (status == SB_OK) status = sb_report_write(&what, folder, error);
    if (status == SB_OK) printf("%s/validation.md\n", folder);
    for (size_t c = 0; c < count; c++) {
        size_t limited, passed;
        sb_results_count(&results[c], &limited, &passed);
        for (size_t k = 0; k < o->count; k++)
            if (o->cases[k] == results[c].of) *short_of += limited - passed;
        sb_results_free(&results[c]);
    }
    return status;
}

static sb_status validate(const options *o, size_t *failed, size_t *short_of, sb_error *error)
{
    sb_store store;
    char own[SB_PATH_MAX] = "", program[SB_PATH_MAX], path[SB_PATH_MAX];
    sb_status status = SB_OK;
    if (!realpath("/proc/self/exe", own)) own[0] = '\0';
    sb_path_folder(path, own);
    status = sb_path_join(program, path, "shorebreak", error);
    if (status == SB_OK)
        status = sb_store_open(&store, o->out ? o->out : SB_SOURCE_DIR "/build/validation",
                               o->program ? o->program : program, SB_SOURCE_DIR, error);
    if (status == SB_OK && o->sensitivity) {
        status = sb_path_join(path, o->report ? o->report : SB_SOURCE_DIR "/docs/results",
                              "sensitivity.md", error);
        if (status == SB_OK)
            status = sb_sensitivity(&store, o->cases, o->count, o->jobs, o->report_only, o->command,
                                    path, failed, error);
        if (status == SB_OK) printf("%s\n", path);
        return status;
    }
    if (status == SB_OK && !o->report_only) status = run_cases(&store, o, failed, error);
    return status == SB_OK ? report(&store, o, short_of, error) : status;
}

int main(int count, char **arguments)
{
    options o = {0};
    sb_error error = {0};
    size_t failed = 0, short_of = 0;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count == 2 && strcmp(arguments[1], "--version") == 0) {
        printf("shorebreak-validate %s\n", SB_VERSION);
        return 0;
    }
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && o.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK && o.list) {
        list_cases();
        return 0;
    }
    if (status == SB_OK && (o.all || ((o.report_only || o.sensitivity) && !o.count)))
        for (o.count = 0; sb_cases[o.count] && o.count < CASES_MAX; o.count++)
            o.cases[o.count] = sb_cases[o.count];
    if (!o.jobs) o.jobs = o.quick || o.sensitivity ? (int)sysconf(_SC_NPROCESSORS_ONLN) : 1;
    if (status == SB_OK && !o.count)
        status = sb_fail(&error, SB_BAD_INPUT, "no case named; --list names them, --all takes all");
    if (status == SB_OK) status = validate(&o, &failed, &short_of, &error);
    if (status != SB_OK) fprintf(stderr, "validate: %s\n", error.text);
    if (status != SB_OK) return status == SB_INTERRUPTED ? 130 : (int)status;
    return failed ? SB_FAILED : short_of ? SHORT_OF_REACH : 0;
}

#include "options.h"

#include "arguments.h"

#include <string.h>
#include <unistd.h>

const char sb_validate_help[] =
    "usage: tools/validate [CASE...|--all] [OPTIONS]\n"
    "Runs the cases, compares them with experiments and theory, and writes the report.\n\n"
    "  --all            every case\n"
    "  --quick          cheap forms; the report goes to OUT/quick\n"
    "  --spacings N     only the N coarsest spacings of each case\n"
    "  --spacing R      only this spacing, in m, as in the tables of the report\n"
    "  --once           only the first seed of the default preset\n"
    "  --sensitivity    effect of a 25 % change of every numeric default on the quick forms\n"
    "  --list           lists the cases\n"
    "  --report-only    runs nothing; writes the report again from stored runs\n"
    "  --out DIR        folder of stored runs (build/validation)\n"
    "  --report DIR     folder of the report (docs/results)\n"
    "  --jobs N         N runs at a time with one thread each; 1: one run with all cores\n"
    "                   (default 1; --quick and --sensitivity: the number of cores)\n"
    "  --shorebreak F   program that runs the cases (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Finished runs are stored and not repeated as long as program and scene stay the same. A run\n"
    "that was stopped continues from its checkpoint.\n"
    "Exit status: 0 all judged figures within their targets, 1 bad input, 2 a run failed, 4 some\n"
    "figures missed their targets, 130 stopped.\n";

static const sb_case *find_case(const char *name)
{
    for (size_t i = 0; sb_cases[i]; i++)
        if (strcmp(sb_cases[i]->name, name) == 0) return sb_cases[i];
    return NULL;
}

static sb_status take_case(void *user, const char *name, sb_error *error)
{
    sb_validate_options *o = user;
    const sb_case *of = find_case(name);
    if (!of) return sb_fail(error, SB_BAD_INPUT, "%.200s: no such case; --list shows the cases", name);
    if (o->count == SB_CASES_MAX) return sb_fail(error, SB_BAD_INPUT, "too many cases");
    o->cases[o->count++] = of;
    return SB_OK;
}

static void take_all(sb_validate_options *o)
{
    for (o->count = 0; sb_cases[o->count] && o->count < SB_CASES_MAX; o->count++)
        o->cases[o->count] = sb_cases[o->count];
}

sb_status sb_validate_parse(int count, char **arguments, sb_validate_options *o, sb_error *error)
{
    *o = (sb_validate_options){.command = "tools/validate"};
    const sb_argument options[] = {{.name = "--all", .flag = &o->all, .repeated = true},
                                   {.name = "--quick", .flag = &o->quick, .repeated = true},
                                   {.name = "--list", .flag = &o->list},
                                   {.name = "--report-only", .flag = &o->report_only, .repeated = true},
                                   {.name = "--sensitivity", .flag = &o->sensitivity, .repeated = true},
                                   {.name = "--spacings", .count = &o->spacings, .most = 64, .repeated = true},
                                   {.name = "--spacing", .number = &o->spacing, .most = 1e6, .repeated = true},
                                   {.name = "--once", .flag = &o->once, .repeated = true},
                                   {.name = "--jobs", .count = &o->jobs, .most = 256, .repeated = true},
                                   {.name = "--out", .text = &o->out},
                                   {.name = "--report", .text = &o->report},
                                   {.name = "--shorebreak", .text = &o->program}};
    const sb_command_line line = {.options = options,
                                  .option_count = sizeof options / sizeof *options,
                                  .operand = take_case,
                                  .user = o,
                                  .help = &o->help,
                                  .command = o->command,
                                  .command_size = sizeof o->command};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    if (status != SB_OK || o->help || o->list) return status;
    if (o->all || ((o->report_only || o->sensitivity) && !o->count)) take_all(o);
    if (!o->jobs) o->jobs = o->quick || o->sensitivity ? (int)sysconf(_SC_NPROCESSORS_ONLN) : 1;
    return o->count ? SB_OK : sb_fail(error, SB_BAD_INPUT, "no case given; --list shows the cases, --all selects all");
}

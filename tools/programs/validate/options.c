#include "options.h"

#include "cases.h"
#include "origin.h"

#include <stdio.h>

static const char help[] =
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

static const char *case_name(size_t row)
{
    return sb_cases[row] ? sb_cases[row]->name : NULL;
}

static void list(void)
{
    for (size_t i = 0; sb_cases[i]; i++) printf("%-24s %s\n", sb_cases[i]->name, sb_cases[i]->title);
}

sb_status sb_validate_parse(int count, char **arguments, sb_validate_options *o, sb_error *error)
{
    *o = (sb_validate_options){.cases = {.what = "case", .name = case_name}};
    const sb_argument options[] = {{.name = "--sensitivity", .flag = &o->sensitivity, .repeated = true},
                                   {.name = "--spacings", .count = &o->spacings, .most = 64, .repeated = true},
                                   {.name = "--spacing", .number = &o->spacing, .most = 1e6, .repeated = true},
                                   {.name = "--once", .flag = &o->once, .repeated = true}};
    const sb_command_line line = {.tool = "validate",
                                  .help = help,
                                  .list = list,
                                  .has = SB_HAS_ALL | SB_HAS_QUICK | SB_HAS_LIST | SB_HAS_REPORT_ONLY | SB_HAS_JOBS |
                                         SB_HAS_OUT | SB_HAS_REPORT | SB_HAS_PROGRAM,
                                  .options = options,
                                  .option_count = sizeof options / sizeof *options,
                                  .selection = &o->cases};
    sb_common_options *c = &o->common;
    sb_status status = sb_command_line_read(&line, count, arguments, c, error);
    if (status != SB_OK || c->answered) return status;
    if (c->all || ((c->report_only || o->sensitivity) && !o->cases.count)) sb_selection_all(&o->cases);
    if (!c->jobs) c->jobs = c->quick || o->sensitivity ? sb_origin_cores() : 1;
    return sb_selection_check(&o->cases, error);
}

#include "battery.h"

#include "arguments.h"

#include <string.h>
#include <unistd.h>

const char sb_battery_help[] =
    "usage: tools/stress [CASE...|--all] [OPTIONS]\n"
    "Runs stress cases, judges each trial by the rules, and writes the report stability.md.\n\n"
    "  --all            every case\n"
    "  --quick          few and cheap forms; the report goes to OUT/quick\n"
    "  --list           lists the cases\n"
    "  --report-only    runs nothing; writes the report again from stored trials\n"
    "  --out DIR        folder of stored trials (build/stress)\n"
    "  --report DIR     folder of the report (docs/results)\n"
    "  --jobs N         N trials at a time with one thread each (default: the number of cores)\n"
    "  --shorebreak F   program that runs the trials (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Trials are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 all trials of the named cases pass, 1 bad input, 2 the tool itself failed, 4 a\n"
    "trial fails, 130 stopped.\n";

static sb_status take_case(void *user, const char *name, sb_error *error)
{
    sb_battery_options *o = user;
    for (size_t i = 0; sb_stresses[i]; i++) {
        if (strcmp(sb_stresses[i]->name, name) != 0) continue;
        if (o->count == SB_STRESSES_MAX) return sb_fail(error, SB_BAD_INPUT, "too many cases");
        o->cases[o->count++] = sb_stresses[i];
        return SB_OK;
    }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such case; --list shows the cases", name);
}

sb_status sb_battery_parse(int count, char **arguments, sb_battery_options *o, sb_error *error)
{
    *o = (sb_battery_options){.command = "tools/stress"};
    const sb_argument options[] = {{.name = "--all", .flag = &o->all, .repeated = true},
                                   {.name = "--quick", .flag = &o->quick, .repeated = true},
                                   {.name = "--list", .flag = &o->list},
                                   {.name = "--report-only", .flag = &o->report_only, .repeated = true},
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
    if (o->all || (o->report_only && !o->count))
        for (o->count = 0; sb_stresses[o->count] && o->count < SB_STRESSES_MAX; o->count++)
            o->cases[o->count] = sb_stresses[o->count];
    if (!o->jobs) o->jobs = (int)sysconf(_SC_NPROCESSORS_ONLN);
    return o->count ? SB_OK : sb_fail(error, SB_BAD_INPUT, "no case given; --list shows the cases, --all selects all");
}

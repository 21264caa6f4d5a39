#include "battery.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char sb_battery_help[] =
    "usage: tools/stress [CASE...|--all] [OPTIONS]\n"
    "Runs stress cases, judges each by its rule, and writes the report stability.md.\n\n"
    "  --all            every case\n"
    "  --quick          few and cheap forms; the report goes to OUT/quick\n"
    "  --list           names the cases\n"
    "  --report-only    runs nothing; remakes the report from what was run\n"
    "  --out DIR        where trials are kept (build/stress)\n"
    "  --report DIR     where the report goes (docs/results)\n"
    "  --jobs N         N trials at a time with one thread each (as many as cores)\n"
    "  --shorebreak F   the program that runs (the one built beside this)\n"
    "  --help, --version\n\n"
    "Trials that were run are kept and not repeated while program and scene stay the same.\n"
    "Exit status: 0 all of the named cases pass, 1 bad input, 2 the battery itself failed, 4 a trial\n"
    "fails, 130 stopped.\n";

static sb_status take_case(sb_battery_options *o, const char *name, sb_error *error)
{
    for (size_t i = 0; sb_stresses[i]; i++) {
        if (strcmp(sb_stresses[i]->name, name) != 0) continue;
        if (o->count == SB_STRESSES_MAX) return sb_fail(error, SB_BAD_INPUT, "too many cases");
        o->cases[o->count++] = sb_stresses[i];
        return SB_OK;
    }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such case; --list names them", name);
}

static sb_status take_value(sb_battery_options *o, const char *name, const char *value, sb_error *error)
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

/* The command as it may be repeated anywhere: without folders. */
static void note(sb_battery_options *o, const char *text)
{
    size_t length = strlen(o->command);
    snprintf(o->command + length, sizeof o->command - length, " %.200s", text);
}

static sb_status take_argument(sb_battery_options *o, const char *argument, const char *next, bool *takes_next,
                               sb_error *error)
{
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {{"--all", &o->all},
                 {"--quick", &o->quick},
                 {"--list", &o->list},
                 {"--report-only", &o->report_only},
                 {"--help", &o->help}};
    static const char *const valued[] = {"--jobs", "--out", "--report", "--shorebreak"};
    for (size_t k = 0; k < sizeof valued / sizeof *valued; k++) {
        if (strcmp(argument, valued[k]) != 0) continue;
        *takes_next = true;
        if (k == 0 && next) note(o, argument);
        if (k == 0 && next) note(o, next);
        return take_value(o, argument, next, error);
    }
    note(o, argument);
    for (size_t k = 0; k < sizeof flags / sizeof *flags; k++) {
        if (strcmp(argument, flags[k].name) != 0) continue;
        *flags[k].flag = true;
        return SB_OK;
    }
    if (argument[0] == '-')
        return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", argument);
    return take_case(o, argument, error);
}

sb_status sb_battery_parse(int count, char **arguments, sb_battery_options *o, sb_error *error)
{
    sb_status status = SB_OK;
    *o = (sb_battery_options){.command = "tools/stress"};
    for (int i = 1; status == SB_OK && i < count; i++) {
        bool takes_next = false;
        const char *next = i + 1 < count ? arguments[i + 1] : NULL;
        status = take_argument(o, arguments[i], next, &takes_next, error);
        i += takes_next;
    }
    if (status != SB_OK || o->help || o->list) return status;
    if (o->all || (o->report_only && !o->count))
        for (o->count = 0; sb_stresses[o->count] && o->count < SB_STRESSES_MAX; o->count++)
            o->cases[o->count] = sb_stresses[o->count];
    if (!o->jobs) o->jobs = (int)sysconf(_SC_NPROCESSORS_ONLN);
    return o->count ? SB_OK
                    : sb_fail(error, SB_BAD_INPUT, "no case named; --list names them, --all takes all");
}

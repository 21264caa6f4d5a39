#include "options.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { REPEATS = 7, REPEATS_QUICK = 2 };

const char sb_bench_help[] =
    "usage: tools/bench [kernels|scenes|scaling|memory|large|runs|island|all]... [OPTIONS]\n"
    "Measures what the simulation costs on this machine and writes tables and benchmarks.md.\n\n"
    "  kernels        each stage and pass of a step, beside this machine's bandwidth and arithmetic\n"
    "  scenes         steps of the scenes delivered, stage by stage\n"
    "  scaling        cost per particle, 50 thousand to 4 million particles, one thread and more\n"
    "  memory         bytes per particle, array by array; what dry land costs\n"
    "  large          the plant at 1 m (18 million particles): set-up, 20 steps, peak memory\n"
    "  runs           whole runs: the plant at 4 m, by both presets, and the column at 1 cm\n"
    "  island         a whole run of the conical island of the validation\n"
    "  tradeoff       run time against error: tools/tradeoff, with the options of that\n"
    "  all            kernels, scenes, scaling, memory; what is measured when nothing is named\n\n"
    "  --quick        small sizes, for a look; goes to build/bench instead\n"
    "  --out DIR      where benchmarks.md and bench/*.csv go (docs/results)\n"
    "  --repeats N    of each measure, 1 to 100 (7; quick: 2)\n"
    "  --threads N    the most to use (all cores)\n"
    "  --report-only  measures nothing; writes benchmarks.md again from the tables\n"
    "  --help, --version\n\n"
    "Let nothing else run meanwhile: a machine that is not quiet is said in the tables and the report.\n"
    "Exit status: 0 done, 1 bad input, 2 a measure failed.\n";

static sb_status take_section(sb_bench_options *o, const char *name, sb_error *error)
{
    const bool all = strcmp(name, "all") == 0;
    const sb_bench_section *named = sb_bench_section_find(name);
    if (!named && !all) return sb_fail(error, SB_BAD_INPUT, "%.200s: no such section; see --help", name);
    for (const sb_bench_section *s = sb_bench_sections; s->name; s++) {
        bool there = false;
        for (size_t k = 0; k < o->count; k++) there |= o->sections[k] == s;
        if (!there && (s == named || (all && s->in_all))) o->sections[o->count++] = s;
    }
    return SB_OK;
}

static sb_status take_count(const char *name, const char *value, long most, int *into, sb_error *error)
{
    char *end;
    const long count = strtol(value, &end, 10);
    if (end == value || *end || count < 1 || count > most)
        return sb_fail(error, SB_BAD_INPUT, "%s: %.50s is no number from 1 to %ld", name, value, most);
    *into = (int)count;
    return SB_OK;
}

static sb_status take_value(sb_bench_options *o, const char *name, const char *value, sb_error *error)
{
    if (!value) return sb_fail(error, SB_BAD_INPUT, "%s: a value is missing; see --help", name);
    if (strcmp(name, "--repeats") == 0) return take_count(name, value, SB_BENCH_REPEATS_MAX, &o->repeats, error);
    if (strcmp(name, "--threads") == 0) return take_count(name, value, 1024, &o->threads, error);
    o->out = value;
    return SB_OK;
}

static sb_status take(sb_bench_options *o, const char *argument, const char *next, bool *takes_next, sb_error *error)
{
    static const char *const valued[] = {"--repeats", "--threads", "--out"};
    for (size_t v = 0; v < sizeof valued / sizeof valued[0]; v++)
        if (strcmp(argument, valued[v]) == 0) {
            *takes_next = true;
            return take_value(o, argument, next, error);
        }
    if (strcmp(argument, "--quick") == 0)
        o->quick = true;
    else if (strcmp(argument, "--report-only") == 0)
        o->report_only = true;
    else if (strcmp(argument, "--help") == 0)
        o->help = true;
    else if (argument[0] == '-')
        return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", argument);
    else
        return take_section(o, argument, error);
    return SB_OK;
}

sb_status sb_bench_parse(int count, char **arguments, sb_bench_options *o, sb_error *error)
{
    sb_status status = SB_OK;
    *o = (sb_bench_options){.count = 0};
    for (int i = 1; i < count && status == SB_OK; i++) {
        bool takes_next = false;
        status = take(o, arguments[i], i + 1 < count ? arguments[i + 1] : NULL, &takes_next, error);
        i += takes_next;
    }
    if (status == SB_OK && o->count == 0) status = take_section(o, "all", error);
    if (o->repeats == 0) o->repeats = o->quick ? REPEATS_QUICK : REPEATS;
    if (o->threads == 0) o->threads = (int)sysconf(_SC_NPROCESSORS_ONLN);
    return status;
}

#include "options.h"

#include "origin.h"

#include <string.h>

enum { REPEATS = 7, REPEATS_QUICK = 2 };

static const char help[] =
    "usage: tools/bench [kernels|scenes|scaling|memory|pictures|large|runs|island|all]... [OPTIONS]\n"
    "Measures run time and memory of the simulation on this machine; writes tables and benchmarks.md.\n\n"
    "  kernels        each stage and pass of a step, compared with this machine's limits\n"
    "  scenes         steps of the delivered scenes, stage by stage\n"
    "  scaling        cost per particle, 50 thousand to 4 million particles, one thread and more\n"
    "  memory         bytes per particle, array by array; cost of dry land\n"
    "  pictures       pictures of 1280 x 720 px, PNG file included\n"
    "  large          the plant at 1 m (18 million particles): set-up, 20 steps, peak memory\n"
    "  runs           whole runs: the plant at 4 m by two presets, the column at 1 cm by two settings\n"
    "  island         a whole run of the conical island of the validation\n"
    "  tradeoff       run time against error: runs tools/tradeoff with its options\n"
    "  all            kernels, scenes, scaling, memory and pictures (the default)\n\n"
    "  --quick        small sizes, for a first look; goes to build/bench\n"
    "  --out DIR      folder of benchmarks.md and bench/<machine>/*.csv (docs/results)\n"
    "  --machine NAME folder of this machine's tables (default: from its processor's name and cores)\n"
    "  --repeats N    repeats of each measurement, 1 to 100 (7; quick: 2)\n"
    "  --threads N    largest number of threads (all cores)\n"
    "  --report-only  measures nothing; writes benchmarks.md again from the tables of all machines\n"
    "  --help, --version\n\n"
    "Run nothing else at the same time: the tables contain the load and the use by other programs.\n"
    "Exit status: 0 done, 1 bad input, 2 a measurement failed, 130 stopped.\n";

static sb_status take_section(void *user, const char *name, sb_error *error)
{
    sb_bench_options *o = user;
    const bool all = strcmp(name, "all") == 0;
    const sb_bench_section *named = sb_bench_section_find(name);
    if (strcmp(name, "tradeoff") == 0)
        return sb_fail(error, SB_BAD_INPUT, "tradeoff: expected as the first argument, before its options");
    if (!named && !all) return sb_fail(error, SB_BAD_INPUT, "%.200s: no such section; see --help", name);
    for (const sb_bench_section *s = sb_bench_sections; s->name; s++) {
        bool there = false;
        for (size_t k = 0; k < o->count; k++) there |= o->sections[k] == s;
        if (!there && (s == named || (all && s->in_all))) o->sections[o->count++] = s;
    }
    return SB_OK;
}

sb_status sb_bench_parse(int count, char **arguments, sb_bench_options *o, sb_error *error)
{
    *o = (sb_bench_options){.count = 0};
    const sb_argument options[] = {{.name = "--repeats", .count = &o->repeats, .most = SB_BENCH_REPEATS_MAX},
                                   {.name = "--threads", .count = &o->threads, .most = 1024},
                                   {.name = "--machine", .text = &o->machine}};
    const sb_command_line line = {.tool = "bench",
                                  .help = help,
                                  .has = SB_HAS_QUICK | SB_HAS_REPORT_ONLY | SB_HAS_OUT,
                                  .options = options,
                                  .option_count = sizeof options / sizeof *options,
                                  .operand = take_section,
                                  .user = o};
    sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    if (status == SB_OK && o->machine &&
        (!*o->machine || strspn(o->machine, "abcdefghijklmnopqrstuvwxyz0123456789-") != strlen(o->machine)))
        status = sb_fail(error, SB_BAD_INPUT, "--machine: \"%.100s\": expected lower-case letters, digits and -",
                         o->machine);
    if (status == SB_OK && o->count == 0) status = take_section(o, "all", error);
    if (o->repeats == 0) o->repeats = o->common.quick ? REPEATS_QUICK : REPEATS;
    if (o->threads == 0) o->threads = sb_origin_cores();
    return status;
}

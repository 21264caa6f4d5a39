#include "study_options.h"

#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: tools/study SCENE --resolutions A,B,C [OPTIONS]\n"
    "Runs a scene at several spacings and start seeds. Reports the order of convergence, the value\n"
    "extrapolated to spacing 0 and an error bar, for the load on every body, crests at gauges, run-up\n"
    "and volumes through planes. Writes study.md, runs.csv, orders.csv and study.png.\n\n"
    "  --resolutions A,B,C  spacings in m; three or more for an observed order\n"
    "  --seeds N            start seeds at each spacing (1); two or more show the scatter\n"
    "  --set KEY=VALUE      as in `shorebreak run`; may be repeated\n"
    "  --preset NAME        default or paper\n"
    "  --quantity PATTERN   only matching quantities: a part of the name, or the whole name with * and ?;\n"
    "                       may be repeated\n"
    "  --out DIR            folder of stored runs and of the report (runs/study/<scene>)\n"
    "  --jobs N             N runs at a time with one thread each; 1: one run with all cores (1)\n"
    "  --report-only        runs nothing; writes the report again from stored runs\n"
    "  --shorebreak F       program that runs the scene (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Finished runs are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 done, 1 bad input, 2 a run failed, 130 stopped.\n";

static sb_status take_spacings(void *user, const char *text, sb_error *error)
{
    sb_study_options *o = user;
    o->spacing_count = 0;
    for (const char *at = text;;) {
        char *end;
        double spacing = strtod(at, &end);
        if (end == at || !(spacing > 0) || !isfinite(spacing) || (*end && *end != ','))
            return sb_fail(error, SB_BAD_INPUT, "--resolutions %.200s: expected metres > 0, for example 4,3,2", text);
        if (o->spacing_count == SB_STUDY_LEVELS)
            return sb_fail(error, SB_BAD_INPUT, "--resolutions: expected at most %d spacings", SB_STUDY_LEVELS);
        o->spacings[o->spacing_count++] = spacing;
        if (!*end) break;
        at = end + 1;
    }
    for (size_t i = 1; i < o->spacing_count; i++)
        for (size_t k = i; k > 0 && o->spacings[k] >= o->spacings[k - 1]; k--) {
            double spacing = o->spacings[k];
            if (spacing == o->spacings[k - 1])
                return sb_fail(error, SB_BAD_INPUT, "--resolutions: %g is given twice", spacing);
            o->spacings[k] = o->spacings[k - 1];
            o->spacings[k - 1] = spacing;
        }
    return SB_OK;
}

/* The study sets these keys itself. */
static sb_status take_set(void *user, const char *text, sb_error *error)
{
    sb_study_options *o = user;
    static const char *const own[] = {"resolution=", "numerics.seed=", "numerics.preset="};
    const char *equals = strchr(text, '=');
    if (!equals || equals == text) return sb_fail(error, SB_BAD_INPUT, "--set %.200s: expected KEY=VALUE", text);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strncmp(text, own[i], strlen(own[i])) == 0)
            return sb_fail(error, SB_BAD_INPUT, "--set %.200s: use --resolutions, --seeds or --preset for this key",
                           text);
    if (o->set_count == SB_STUDY_SETS)
        return sb_fail(error, SB_BAD_INPUT, "--set: expected at most %d settings", SB_STUDY_SETS);
    o->sets[o->set_count++] = text;
    return SB_OK;
}

static sb_status take_preset(void *user, const char *name, sb_error *error)
{
    sb_study_options *o = user;
    o->preset = name;
    o->paper = strcmp(name, "paper") == 0;
    return o->paper || strcmp(name, "default") == 0
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--preset %.50s: expected default or paper", name);
}

static sb_status take_pattern(void *user, const char *pattern, sb_error *error)
{
    sb_study_options *o = user;
    if (o->pattern_count == SB_STUDY_PATTERNS)
        return sb_fail(error, SB_BAD_INPUT, "--quantity: expected at most %d patterns", SB_STUDY_PATTERNS);
    o->patterns[o->pattern_count++] = pattern;
    return SB_OK;
}

static sb_status take_scene(void *user, const char *path, sb_error *error)
{
    sb_study_options *o = user;
    if (o->scene) return sb_fail(error, SB_BAD_INPUT, "%.200s: expected only one scene", path);
    o->scene = path;
    return SB_OK;
}

sb_status sb_study_parse(int count, char **arguments, sb_study_options *o, sb_error *error)
{
    *o = (sb_study_options){.seeds = 1};
    const sb_argument options[] = {{.name = "--resolutions", .take = take_spacings, .repeated = true},
                                   {.name = "--set", .take = take_set, .repeated = true},
                                   {.name = "--seeds", .count = &o->seeds, .most = SB_STUDY_SEEDS, .repeated = true},
                                   {.name = "--preset", .take = take_preset, .repeated = true},
                                   {.name = "--quantity", .take = take_pattern, .repeated = true},
                                   {.name = "--report-only", .flag = &o->common.report_only}};
    const sb_command_line line = {.tool = "study",
                                  .help = help,
                                  .has = SB_HAS_JOBS | SB_HAS_OUT | SB_HAS_PROGRAM,
                                  .options = options,
                                  .option_count = sizeof options / sizeof *options,
                                  .operand = take_scene,
                                  .user = o};
    sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    if (status != SB_OK || o->common.answered) return status;
    if (!o->common.jobs) o->common.jobs = 1;
    if (!o->scene) return sb_fail(error, SB_BAD_INPUT, "no scene given; see --help");
    return o->spacing_count > 1
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--resolutions: expected two spacings or more, for example 4,3,2");
}

bool sb_study_selects(const sb_study_options *o, const char *quantity)
{
    for (size_t i = 0; i < o->pattern_count; i++)
        if (fnmatch(o->patterns[i], quantity, 0) == 0 || strstr(quantity, o->patterns[i])) return true;
    return o->pattern_count == 0;
}

#include "study_options.h"

#include "trials.h"

#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char sb_study_help[] =
    "usage: tools/study SCENE --resolutions A,B,C [OPTIONS]\n"
    "Runs a scene at several spacings and start seeds; tells the order of convergence, the value\n"
    "extrapolated to spacing 0 and an error bar, for the load on every body, gauges' crests, run-up\n"
    "and volumes through planes. Leaves study.md, runs.csv, orders.csv and study.png.\n\n"
    "  --resolutions A,B,C  spacings in m; three or more for an observed order\n"
    "  --seeds N            start seeds at each spacing (1); two or more for the scatter\n"
    "  --set KEY=VALUE      as of `shorebreak run`; may be given again\n"
    "  --preset NAME        default or paper\n"
    "  --quantity PATTERN   only these: a part of the name, or with * and ? all of it; again for more\n"
    "  --out DIR            where runs are kept and the report goes (runs/study/<scene>)\n"
    "  --jobs N             N runs at a time with one thread each; 1: one with all cores (1)\n"
    "  --report-only        runs nothing; remakes the report from what was run\n"
    "  --shorebreak F       the program that runs (the one built beside this)\n"
    "  --help, --version\n\n"
    "Finished runs are kept and not repeated while program and scene stay the same.\n"
    "Exit status: 0 done, 1 bad input, 2 a run failed, 130 stopped.\n";

static sb_status take_spacings(sb_study_options *o, const char *text, sb_error *error)
{
    o->spacing_count = 0;
    for (const char *at = text;;) {
        char *end;
        double spacing = strtod(at, &end);
        if (end == at || !(spacing > 0) || !isfinite(spacing) || (*end && *end != ','))
            return sb_fail(error, SB_BAD_INPUT, "--resolutions %.200s: expected metres > 0, as 4,3,2",
                           text);
        if (o->spacing_count == SB_STUDY_LEVELS)
            return sb_fail(error, SB_BAD_INPUT, "--resolutions: more than %d", SB_STUDY_LEVELS);
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

/* These the study gives itself. */
static sb_status take_set(sb_study_options *o, const char *text, sb_error *error)
{
    static const char *const own[] = {"resolution=", "numerics.seed=", "numerics.preset="};
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return sb_fail(error, SB_BAD_INPUT, "--set %.200s: expected KEY=VALUE", text);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strncmp(text, own[i], strlen(own[i])) == 0)
            return sb_fail(error, SB_BAD_INPUT,
                           "--set %.200s: --resolutions, --seeds and --preset say this", text);
    if (o->set_count == SB_STUDY_SETS)
        return sb_fail(error, SB_BAD_INPUT, "--set: more than %d of them", SB_STUDY_SETS);
    o->sets[o->set_count++] = text;
    return SB_OK;
}

static sb_status take_value(sb_study_options *o, const char *name, const char *value, sb_error *error)
{
    if (strcmp(name, "--resolutions") == 0) return take_spacings(o, value, error);
    if (strcmp(name, "--set") == 0) return take_set(o, value, error);
    if (strcmp(name, "--seeds") == 0)
        return sb_trial_count(name, value, SB_STUDY_SEEDS, &o->seeds, error);
    if (strcmp(name, "--jobs") == 0) return sb_trial_count(name, value, 256, &o->jobs, error);
    if (strcmp(name, "--out") == 0) o->out = value;
    if (strcmp(name, "--shorebreak") == 0) o->program = value;
    if (strcmp(name, "--preset") == 0) {
        o->paper = strcmp(value, "paper") == 0;
        if (!o->paper && strcmp(value, "default") != 0)
            return sb_fail(error, SB_BAD_INPUT, "--preset %.50s: expected default or paper", value);
    }
    if (strcmp(name, "--quantity") == 0) {
        if (o->pattern_count == SB_STUDY_PATTERNS)
            return sb_fail(error, SB_BAD_INPUT, "--quantity: more than %d", SB_STUDY_PATTERNS);
        o->patterns[o->pattern_count++] = value;
    }
    return SB_OK;
}

static const char *const valued[] = {"--resolutions", "--set", "--seeds", "--jobs", "--preset",
                                     "--quantity",    "--out", "--shorebreak"};
enum { TELLING = 6 }; /* of those, that belong into the command as it is shown */

static void note(sb_study_options *o, const char *text)
{
    size_t length = strlen(o->command);
    const char *quote = strpbrk(text, " *?[{\"") ? "'" : "";
    snprintf(o->command + length, sizeof o->command - length, " %s%.200s%s", quote, text, quote);
}

static sb_status take(sb_study_options *o, const char *argument, const char *next, int *taken,
                      sb_error *error)
{
    for (size_t k = 0; k < sizeof valued / sizeof *valued; k++) {
        if (strcmp(argument, valued[k]) != 0) continue;
        if (!next) return sb_fail(error, SB_BAD_INPUT, "%s: a value is missing; see --help", argument);
        *taken = 2;
        if (k < TELLING) note(o, argument);
        if (k < TELLING) note(o, next);
        return take_value(o, argument, next, error);
    }
    if (strcmp(argument, "--report-only") == 0) {
        o->report_only = true;
        return SB_OK;
    }
    if (strcmp(argument, "--help") == 0) {
        o->help = true;
        return SB_OK;
    }
    if (argument[0] == '-')
        return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", argument);
    if (o->scene) return sb_fail(error, SB_BAD_INPUT, "%.200s: one scene only", argument);
    o->scene = argument;
    note(o, argument);
    return SB_OK;
}

sb_status sb_study_parse(int count, char **arguments, sb_study_options *o, sb_error *error)
{
    sb_status status = SB_OK;
    *o = (sb_study_options){.seeds = 1, .jobs = 1, .command = "tools/study"};
    for (int i = 1, taken; status == SB_OK && i < count; i += taken) {
        taken = 1;
        status = take(o, arguments[i], i + 1 < count ? arguments[i + 1] : NULL, &taken, error);
    }
    if (status != SB_OK || o->help) return status;
    if (!o->scene) return sb_fail(error, SB_BAD_INPUT, "no scene named; see --help");
    return o->spacing_count > 1
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--resolutions: expected two spacings or more, as 4,3,2");
}

bool sb_study_wants(const sb_study_options *o, const char *quantity)
{
    for (size_t i = 0; i < o->pattern_count; i++)
        if (fnmatch(o->patterns[i], quantity, 0) == 0 || strstr(quantity, o->patterns[i])) return true;
    return o->pattern_count == 0;
}

#include "options.h"

#include <stdlib.h>
#include <string.h>

const char sb_kill_help[] =
    "usage: tools/kill-test [SCENE] [OPTIONS]\n"
    "Kills a run with SIGKILL at random moments, resumes it each time, and compares its final state and all of\n"
    "its files with those of a run that was never disturbed. Exit status 0: all equal.\n\n"
    "  SCENE             a scene of some seconds' work (default: a small one with every kind of file)\n"
    "  --kills N         how often (default: 100)\n"
    "  --seed N          of the moments (default: 1)\n"
    "  --out DIR         the runs go here (default: runs/kill-test)\n"
    "  --no-pictures     else every fourth run has pictures, where the scene has a camera\n"
    "  --help            this text\n";

static sb_status take_number(const char *flag, const char *value, unsigned long long least, unsigned long long *number,
                             sb_error *error)
{
    char *end = NULL;
    *number = value ? strtoull(value, &end, 10) : 0;
    if (!value || end == value || *end || strchr(value, '-') || *number < least || *number > 1000000)
        return sb_fail(error, SB_BAD_INPUT, "%s: expected a number from %llu to 1000000", flag, least);
    return SB_OK;
}

sb_status sb_kill_options_parse(int count, char **arguments, sb_kill_options *options, sb_error *error)
{
    *options = (sb_kill_options){.scene = SB_KILL_SCENE, .out = "runs/kill-test", .kills = 100, .seed = 1, .pictures = true};
    for (int i = 1; i < count; i++) {
        const char *flag = arguments[i], *value = i + 1 < count ? arguments[i + 1] : NULL;
        unsigned long long number = 0;
        sb_status status = SB_OK;
        if (strcmp(flag, "--help") == 0) {
            options->help = true;
            return SB_OK;
        }
        if (strcmp(flag, "--no-pictures") == 0) {
            options->pictures = false;
        } else if (strcmp(flag, "--out") == 0 && value) {
            options->out = arguments[++i];
        } else if (strcmp(flag, "--kills") == 0) {
            status = take_number(flag, value, 1, &number, error);
            options->kills = (int)number;
            i++;
        } else if (strcmp(flag, "--seed") == 0) {
            status = take_number(flag, value, 0, &number, error);
            options->seed = number;
            i++;
        } else if (flag[0] != '-') {
            options->scene = flag;
        } else {
            return sb_fail(error, SB_BAD_INPUT, "%s: no such option, or no value behind it; --help lists them", flag);
        }
        if (status != SB_OK)
            return status;
    }
    return SB_OK;
}

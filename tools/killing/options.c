#include "options.h"

#include "arguments.h"

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

static sb_status take_seed(void *user, const char *value, sb_error *error)
{
    sb_kill_options *options = user;
    char *end;
    options->seed = strtoull(value, &end, 10);
    return end != value && !*end && !strchr(value, '-')
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--seed: %.50s is no number from 0", value);
}

static sb_status take_scene(void *user, const char *path, sb_error *error)
{
    sb_kill_options *options = user;
    (void)error;
    options->scene = path;
    return SB_OK;
}

sb_status sb_kill_options_parse(int count, char **arguments, sb_kill_options *options, sb_error *error)
{
    bool plain = false;
    *options = (sb_kill_options){.scene = SB_KILL_SCENE, .out = "runs/kill-test", .kills = 100, .seed = 1};
    const sb_argument table[] = {{.name = "--kills", .count = &options->kills, .most = 1e6},
                                 {.name = "--seed", .take = take_seed},
                                 {.name = "--out", .text = &options->out},
                                 {.name = "--no-pictures", .flag = &plain}};
    const sb_command_line line = {.options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .word = take_scene,
                                  .user = options,
                                  .help = &options->help};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    options->pictures = !plain;
    return status;
}

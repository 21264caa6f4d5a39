#include "options.h"

#include "arguments.h"

#include <stdlib.h>
#include <string.h>

const char sb_kill_help[] =
    "usage: tools/kill-test [SCENE] [OPTIONS]\n"
    "Kills a run with SIGKILL at random times and resumes it each time. Compares its final state and all its\n"
    "files with those of an undisturbed run. Exit status 0: all are equal.\n\n"
    "  SCENE             a scene that runs for some seconds (default: a small one with every kind of file)\n"
    "  --kills N         number of kills (default: 100)\n"
    "  --seed N          seed of the random times (default: 1)\n"
    "  --out DIR         folder of the runs (default: runs/kill-test)\n"
    "  --no-pictures     no pictures; without it every fourth run draws them if the scene has a camera\n"
    "  --help            this text\n";

static sb_status take_seed(void *user, const char *value, sb_error *error)
{
    sb_kill_options *options = user;
    char *end;
    options->seed = strtoull(value, &end, 10);
    return end != value && !*end && !strchr(value, '-')
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--seed: %.50s is not a whole number >= 0", value);
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
    *options = (sb_kill_options){.scene = SB_SOURCE_DIR "/tools/programs/kill-test/scene.yaml", .out = "runs/kill-test", .kills = 100, .seed = 1};
    const sb_argument table[] = {{.name = "--kills", .count = &options->kills, .most = 1e6},
                                 {.name = "--seed", .take = take_seed},
                                 {.name = "--out", .text = &options->out},
                                 {.name = "--no-pictures", .flag = &plain}};
    const sb_command_line line = {.options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .operand = take_scene,
                                  .user = options,
                                  .help = &options->help};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    options->pictures = !plain;
    return status;
}

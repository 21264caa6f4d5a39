/* tools/kill-test: kills a run at random times and resumes it; the result must equal that of an undisturbed run. */
#include "arguments.h"
#include "compare.h"
#include "process.h"
#include "round.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A run is killed within this fraction of the undisturbed run time, so that kills are in all parts of a run. */
static const double LONGEST = 0.6;

enum { WITH_PICTURES = 4 }; /* every fourth round has pictures */

typedef struct options {
    sb_common_options common;
    const char *scene; /* a scene file */
    int kills;
    uint64_t seed; /* of the random times */
    bool plain;    /* no pictures */
} options;

static const char help[] =
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
    options *o = user;
    char *end;
    o->seed = strtoull(value, &end, 10);
    return end != value && !*end && !strchr(value, '-')
               ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "--seed: %.50s is not a whole number >= 0", value);
}

static sb_status take_scene(void *user, const char *path, sb_error *error)
{
    (void)error;
    ((options *)user)->scene = path;
    return SB_OK;
}

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.scene = SB_SOURCE_DIR "/tools/programs/kill-test/scene.yaml", .kills = 100, .seed = 1};
    const sb_argument table[] = {{.name = "--kills", .count = &o->kills, .most = 1e6},
                                 {.name = "--seed", .take = take_seed},
                                 {.name = "--no-pictures", .flag = &o->plain}};
    const sb_command_line line = {.tool = "kill-test",
                                  .help = help,
                                  .has = SB_HAS_OUT,
                                  .options = table,
                                  .option_count = sizeof table / sizeof *table,
                                  .operand = take_scene,
                                  .user = o};
    const sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    if (!o->common.out) o->common.out = "runs/kill-test";
    return status;
}

typedef struct test {
    options options;
    char program[SB_PATH_MAX];
    double seconds[2]; /* run times of undisturbed runs without and with pictures; 0: not run yet */
    int kills, rounds;
    size_t files;
} test;

static sb_status name_run(const test *t, const char *name, bool pictures, char out[SB_PATH_MAX], sb_kill_run *run,
                          sb_error *error)
{
    char folder[64];
    snprintf(folder, sizeof folder, "%s%s", name, pictures ? "-pictures" : "");
    *run = (sb_kill_run){.program = t->program, .scene = t->options.scene, .out = out, .pictures = pictures};
    return sb_path_join(out, t->options.common.out, folder, error);
}

/* Removes checkpoints, from which a run would resume, and the summary, which marks a run as finished. */
static sb_status remove_run(const char *out, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, out, "checkpoints", error);
    if (status == SB_OK) status = sb_remove_numbered(path, ".state", 0, error);
    if (status == SB_OK) status = sb_path_join(path, out, "summary.json", error);
    if (status == SB_OK && unlink(path) != 0 && errno != ENOENT)
        status = sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    return status;
}

/* Makes the undisturbed run once. */
static sb_status run_whole(test *t, const sb_kill_run *run, sb_error *error)
{
    double *seconds = &t->seconds[run->pictures];
    if (*seconds > 0) return SB_OK;
    sb_status status = remove_run(run->out, error);
    return status == SB_OK ? sb_kill_none(run, seconds, error) : status;
}

static sb_status one_round(test *t, sb_kill_moments *moments, sb_error *error)
{
    char whole[SB_PATH_MAX], killed[SB_PATH_MAX];
    const bool pictures = !t->options.plain && t->rounds % WITH_PICTURES == WITH_PICTURES - 1;
    sb_kill_run run;
    sb_status status = name_run(t, "whole", pictures, whole, &run, error);
    if (status == SB_OK) status = run_whole(t, &run, error);
    if (status == SB_OK) status = name_run(t, "killed", pictures, killed, &run, error);
    if (status == SB_OK) status = remove_run(killed, error);
    moments->longest = LONGEST * t->seconds[pictures];
    if (status == SB_OK) status = sb_kill_some(&run, moments, t->options.kills - t->kills, &t->kills, error);
    t->rounds++;
    return status == SB_OK ? sb_kill_compare(whole, killed, &t->files, error) : status;
}

int main(int count, char **arguments)
{
    test t = {.rounds = 0};
    sb_error error = {0};
    sb_status status = parse(count, arguments, &t.options, &error);
    if (status == SB_OK && t.options.common.answered) return 0;
    sb_kill_moments moments = {.seed = t.options.seed};
    if (status == SB_OK) status = sb_process_beside("shorebreak", t.program, &error);
    if (status == SB_OK) status = sb_make_directories(t.options.common.out, &error);
    while (status == SB_OK && t.kills < t.options.kills) status = one_round(&t, &moments, &error);
    if (status != SB_OK)
        fprintf(stderr, "kill-test: after %d kills in %d runs: %s\n", t.kills, t.rounds, error.text);
    else
        printf("%d kills in %d runs, each resumed: states and %zu files equal those of undisturbed runs\n", t.kills,
               t.rounds, t.files);
    return (int)status;
}

/* kill -9 at random moments, --resume each time: the end must be that of a run that was never disturbed. */
#include "base/file.h"
#include "compare.h"
#include "options.h"
#include "process.h"
#include "round.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Share of an undisturbed run's time within which a run is killed: beginnings, middles and ends all come. */
static const double LONGEST = 0.6;

enum { WITH_PICTURES = 4 }; /* in every so many rounds */

typedef struct test {
    sb_kill_options options;
    char program[SB_PATH_MAX];
    double seconds[2]; /* of undisturbed runs, without and with pictures; 0: not yet run */
    int kills, rounds;
    size_t files;
} test;

static sb_status name_run(const test *t, const char *name, bool pictures, char out[SB_PATH_MAX], sb_kill_run *run,
                          sb_error *error)
{
    char folder[64];
    snprintf(folder, sizeof folder, "%s%s", name, pictures ? "-pictures" : "");
    *run = (sb_kill_run){.program = t->program, .scene = t->options.scene, .out = out, .pictures = pictures};
    return sb_path_join(out, t->options.out, folder, error);
}

/* Or a run would go on from an earlier one's checkpoint, or not begin where one is finished. */
static sb_status forget_run(const char *out, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, out, "checkpoints", error);
    if (status == SB_OK) status = sb_remove_numbered(path, ".state", 0, error);
    if (status == SB_OK) status = sb_path_join(path, out, "summary.json", error);
    if (status == SB_OK && unlink(path) != 0 && errno != ENOENT)
        status = sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    return status;
}

/* The run to compare with, once. */
static sb_status run_whole(test *t, const sb_kill_run *run, sb_error *error)
{
    double *seconds = &t->seconds[run->pictures];
    if (*seconds > 0) return SB_OK;
    sb_status status = forget_run(run->out, error);
    return status == SB_OK ? sb_kill_none(run, seconds, error) : status;
}

static sb_status one_round(test *t, sb_kill_moments *moments, sb_error *error)
{
    char whole[SB_PATH_MAX], killed[SB_PATH_MAX];
    const bool pictures = t->options.pictures && t->rounds % WITH_PICTURES == WITH_PICTURES - 1;
    sb_kill_run run;
    sb_status status = name_run(t, "whole", pictures, whole, &run, error);
    if (status == SB_OK) status = run_whole(t, &run, error);
    if (status == SB_OK) status = name_run(t, "killed", pictures, killed, &run, error);
    if (status == SB_OK) status = forget_run(killed, error);
    moments->longest = LONGEST * t->seconds[pictures];
    if (status == SB_OK) status = sb_kill_some(&run, moments, t->options.kills - t->kills, &t->kills, error);
    t->rounds++;
    return status == SB_OK ? sb_kill_compare(whole, killed, &t->files, error) : status;
}

int main(int count, char **arguments)
{
    test t = {.rounds = 0};
    sb_error error = {0};
    sb_status status = sb_kill_options_parse(count, arguments, &t.options, &error);
    if (status == SB_OK && t.options.help) {
        fputs(sb_kill_help, stdout);
        return 0;
    }
    sb_kill_moments moments = {.seed = t.options.seed};
    if (status == SB_OK) status = sb_process_beside("shorebreak", t.program, &error);
    if (status == SB_OK) status = sb_make_directories(t.options.out, &error);
    while (status == SB_OK && t.kills < t.options.kills) status = one_round(&t, &moments, &error);
    if (status != SB_OK) {
        fprintf(stderr, "kill-test: after %d kills in %d runs: %s\n", t.kills, t.rounds, error.text);
        return (int)status;
    }
    printf("%d kills in %d runs, each resumed: states and %zu files equal those of undisturbed runs\n", t.kills,
           t.rounds, t.files);
    return 0;
}

/* tools/kill-test: kills a run at random times and resumes it; the result must equal that of an undisturbed run. */
#include "base/file.h"
#include "compare.h"
#include "options.h"
#include "process.h"
#include "round.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* A run is killed within this fraction of the undisturbed run time, so that kills are in all parts of a run. */
static const double LONGEST = 0.6;

enum { WITH_PICTURES = 4 }; /* every fourth round has pictures */

typedef struct test {
    sb_kill_options options;
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
    return sb_path_join(out, t->options.out, folder, error);
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
    const bool pictures = t->options.pictures && t->rounds % WITH_PICTURES == WITH_PICTURES - 1;
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

#include "round.h"

#include "base/random.h"
#include "process.h"

#include <signal.h>
#include <stdio.h>

/* Starts the run and kills it after `seconds`. *killed: it had not ended before. Its output goes to <out>.txt. */
static sb_status watch(const sb_kill_run *run, double seconds, bool *killed, double *wall, sb_error *error)
{
    char reason[512];
    sb_process process = {.death_signal = SIGKILL, .time_limit = seconds};
    snprintf(process.output, sizeof process.output, "%.4000s.txt", run->out);
    sb_process_shorebreak(&process, run->program, run->scene, run->out);
    sb_process_add(&process, "--resume", "--set", run->pictures ? "render.interval=0.2" : "render.interval=0", NULL);
    sb_status status = sb_process_start(&process, error);
    if (status != SB_OK) return status;
    sb_process_wait(&process);
    *wall = process.wall;
    *killed = process.killed && sb_process_status(&process) < 0; /* it may have ended in between */
    if (*killed || sb_process_status(&process) == 0) return SB_OK;
    sb_process_reason(&process, ": ", "", reason, sizeof reason);
    return sb_fail(error, SB_FAILED, "%.300s: ended with %s", run->out, reason);
}

static const double FOREVER = 3600; /* s; a run of an hour hangs, or the scene is not suitable */

sb_status sb_kill_none(const sb_kill_run *run, double *seconds, sb_error *error)
{
    bool killed;
    sb_status status = watch(run, FOREVER, &killed, seconds, error);
    return status == SB_OK && killed ? sb_fail(error, SB_FAILED, "%.300s: did not end within an hour", run->out)
                                     : status;
}

sb_status sb_kill_some(const sb_kill_run *run, sb_kill_moments *moments, int most, int *kills, sb_error *error)
{
    sb_status status = SB_OK;
    bool killed = true;
    double seconds;
    for (int k = 0; status == SB_OK && killed && k < most; k++) {
        const double moment = moments->longest * sb_random(moments->seed, moments->drawn++);
        status = watch(run, moment, &killed, &seconds, error);
        *kills += killed;
    }
    return status == SB_OK && killed ? sb_kill_none(run, &seconds, error) : status;
}

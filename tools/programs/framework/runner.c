#include "runner.h"

#include "base/memory.h"
#include "base/stop.h"

typedef struct job {
    sb_process process;
    size_t work;
    bool busy;
} job;

/* Starts work i in a free place. */
static sb_status begin(const sb_runner *runner, size_t i, job *j, sb_error *error)
{
    *j = (job){.work = i};
    sb_status status = runner->begin(runner->user, i, &j->process, error);
    if (status != SB_OK || !(j->process.argument_count || j->process.work)) return status;
    status = sb_process_start(&j->process, error);
    j->busy = status == SB_OK;
    return status;
}

/* Checks all processes once. *idle: a free place, or NULL. Returns their number. */
static int poll_all(const sb_runner *runner, job *jobs, int size, job **idle, sb_status *status, sb_error *error)
{
    int busy = 0;
    *idle = NULL;
    for (int i = 0; i < size; i++) {
        job *j = &jobs[i];
        const bool stopped = sb_stop_signal() || *status != SB_OK;
        if (j->busy && stopped) sb_process_stop(&j->process, runner->stop_signal);
        if (j->busy && sb_process_poll(&j->process)) {
            j->busy = false;
            const sb_status ended =
                runner->end(runner->user, j->work, &j->process, stopped, *status == SB_OK ? error : NULL);
            if (*status == SB_OK) *status = ended;
        }
        busy += j->busy;
        if (!j->busy) *idle = j;
    }
    return busy;
}

/* Waits a moment for a process. */
static void pause_for(const job *jobs)
{
    while (!jobs->busy) jobs++;
    sb_process_pause(&jobs->process);
}

sb_status sb_runner_run(const sb_runner *runner, size_t count, int jobs, sb_error *error)
{
    sb_status status = SB_OK;
    job *all = sb_alloc((size_t)jobs, sizeof *all), *idle;
    if (!all) return sb_fail_memory(error, "runs");
    sb_stop_watch();
    for (size_t i = 0;;) {
        const int busy = poll_all(runner, all, jobs, &idle, &status, error);
        if (sb_stop_signal() || status != SB_OK) i = count;
        if (i == count && !busy) break;
        if (i < count && idle && runner->skip && runner->skip(runner->user, i)) /* it reads a scene: not at each turn */
            i++;
        else if (i < count && idle)
            status = begin(runner, i++, idle, error);
        else
            pause_for(all);
    }
    sb_free(all);
    if (status == SB_OK && sb_stop_signal()) status = SB_INTERRUPTED;
    return status == SB_INTERRUPTED ? sb_fail(error, status, "stopped; the same command continues from here") : status;
}

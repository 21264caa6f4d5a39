#include "child.h"

#include "base/memory.h"
#include "base/stop.h"

#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Sent through the pipe before the rows. */
typedef struct reply {
    sb_status status;
    sb_error error;
    size_t count;
} reply;

static _Noreturn void child(int to, sb_bench_work *work, const void *context)
{
    sb_bench_rows rows = {0};
    reply answer = {.status = SB_OK};
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    signal(SIGINT, SIG_DFL); /* the child has nothing to save */
    signal(SIGTERM, SIG_DFL);
    FILE *out = fdopen(to, "wb");
    answer.status = work(context, &rows, &answer.error);
    if (answer.status == SB_OK) answer.status = sb_bench_complete(&rows, &answer.error);
    answer.count = answer.status == SB_OK ? rows.count : 0;
    bool sent = out && fwrite(&answer, sizeof answer, 1, out) == 1;
    sent = sent && fwrite(rows.rows, sizeof *rows.rows, answer.count, out) == answer.count;
    fflush(stdout);
    _exit(sent && fclose(out) == 0 ? 0 : 1);
}

static sb_status receive(int from, sb_bench_rows *rows, sb_error *error)
{
    FILE *in = fdopen(from, "rb");
    reply answer;
    sb_status status = SB_OK;
    if (!in || fread(&answer, sizeof answer, 1, in) != 1)
        status = sb_fail(error, SB_FAILED, "the measuring process ended without a result");
    else if (answer.status != SB_OK) {
        *error = answer.error;
        status = answer.status;
    }
    for (size_t i = 0; status == SB_OK && i < answer.count; i++) {
        sb_bench_row row;
        if (fread(&row, sizeof row, 1, in) != 1)
            status = sb_fail(error, SB_FAILED, "the measuring process ended before its result was complete");
        else
            sb_bench_append(rows, &row);
    }
    if (status == SB_OK) status = sb_bench_complete(rows, error);
    if (in)
        fclose(in);
    else
        close(from);
    return status;
}

sb_status sb_bench_in_child(sb_bench_work *work, const void *context, sb_bench_rows *rows, sb_error *error)
{
    int ends[2], ended = 0;
    if (pipe(ends) != 0) return sb_fail(error, SB_FAILED, "cannot make a pipe to a measuring process");
    fflush(NULL);
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        child(ends[1], work, context);
    }
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return sb_fail(error, SB_FAILED, "cannot start a measuring process");
    }
    sb_status status = receive(ends[0], rows, error);
    waitpid(process, &ended, 0);
    if (sb_stop_signal()) return sb_stop_fail(error, "while measuring");
    if (WIFSIGNALED(ended))
        return sb_fail(error, SB_FAILED, "the measuring process ended by signal %d (memory?)", WTERMSIG(ended));
    return status;
}

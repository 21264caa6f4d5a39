#include "child.h"

#include "process.h"

#include "base/stop.h"

#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

typedef struct task {
    sb_bench_run *work;
    const sb_bench_request *request;
    char table[SB_PATH_MAX]; /* of the rows */
} task;

/* In the child process. */
static int measure(const void *context)
{
    const task *t = context;
    sb_bench_rows rows = {0};
    sb_error error = {0};
    omp_set_num_threads(t->request->threads);
    sb_status status = t->work(t->request, &rows, &error);
    if (status == SB_OK) status = sb_bench_complete(&rows, &error);
    if (status == SB_OK) status = sb_bench_write(&rows, "", t->table, &error);
    if (status != SB_OK) fprintf(stderr, "%s\n", error.text);
    return (int)status;
}

static sb_status run(task *t, const char *folder, sb_bench_rows *rows, sb_error *error)
{
    sb_process process = {.program = "a measuring process", .work = measure, .context = t, .death_signal = SIGTERM};
    char text[512], origin[64];
    bool found;
    sb_status status = sb_path_join(t->table, folder, "rows.csv", error);
    if (status == SB_OK) status = sb_path_join(process.output, folder, "output.txt", error);
    if (status == SB_OK) status = sb_process_start(&process, error);
    if (status != SB_OK) return status;
    sb_process_wait(&process);
    if (sb_stop_signal()) return sb_stop_fail(error, "while measuring");
    if (WIFSIGNALED(process.how))
        return sb_fail(error, SB_FAILED, "the measuring process ended by signal %d (memory?)", WTERMSIG(process.how));
    sb_process_last_line(&process, "the measuring process ended without a result", text, sizeof text);
    if (sb_process_status(&process)) return sb_fail(error, (sb_status)sb_process_status(&process), "%s", text);
    return sb_bench_read(rows, origin, sizeof origin, &found, t->table, error);
}

sb_status sb_bench_in_child(sb_bench_run *work, const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    task t = {.work = work, .request = request};
    char folder[] = "/tmp/shorebreak-bench-XXXXXX";
    if (!mkdtemp(folder)) return sb_fail(error, SB_FAILED, "%s: cannot make a folder", folder);
    const sb_status status = run(&t, folder, rows, error);
    sb_folder_remove(folder, NULL);
    return status;
}

sb_status sb_bench_sizes(sb_bench_run *work, const sb_bench_request *request, const size_t *sizes, sb_bench_rows *rows,
                         sb_error *error)
{
    sb_bench_request one = *request;
    sb_status status = SB_OK;
    for (; *sizes && status == SB_OK; sizes++) {
        one.particles = *sizes;
        status = sb_bench_in_child(work, &one, rows, error);
    }
    return status;
}

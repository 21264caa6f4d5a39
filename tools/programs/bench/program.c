#include "program.h"

#include "process.h"
#include "summary_text.h"

#include "base/stop.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

static sb_status run_in(const sb_bench_program *run, const char *folder, sb_error *error)
{
    static const char *const quiet[] = {"render.interval=0", "output.plots=false", "output.particle_interval=0"};
    char program[SB_PATH_MAX], threads[16], out[SB_PATH_MAX], reason[512];
    sb_process process = {.death_signal = SIGTERM};
    size_t count = 0;
    sb_status status = sb_process_beside("shorebreak", program, error);
    if (status == SB_OK) status = sb_path_join(out, folder, "run", error);
    if (status == SB_OK) status = sb_path_join(process.output, folder, "output.txt", error);
    if (status != SB_OK) return status;
    snprintf(threads, sizeof threads, "%d", run->threads);
    while (count < SB_BENCH_SETTINGS_MAX && run->settings[count]) count++;
    sb_process_shorebreak(&process, program, run->scene, out);
    sb_process_add(&process, "--threads", threads, NULL);
    sb_process_set(&process, quiet, sizeof quiet / sizeof *quiet);
    sb_process_set(&process, run->settings, count);
    if (run->preset) sb_process_add(&process, "--preset", run->preset, NULL);
    status = sb_process_start(&process, error);
    if (status != SB_OK) return status;
    sb_process_wait(&process);
    if (sb_stop_signal()) return sb_stop_fail(error, "while shorebreak was running");
    if (sb_process_status(&process) == 0) return SB_OK;
    sb_process_reason(&process, ": ", "no output", reason, sizeof reason);
    return sb_fail(error, SB_FAILED, "%.400s: ended with %s", program, reason);
}

sb_status sb_bench_program_run(const sb_bench_program *run, char **summary, sb_error *error)
{
    char path[SB_PATH_MAX], folder[] = "/tmp/shorebreak-bench-XXXXXX";
    if (!mkdtemp(folder)) return sb_fail(error, SB_FAILED, "%s: cannot make a folder", folder);
    sb_status status = run_in(run, folder, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "run", error);
    if (status == SB_OK) status = sb_summary_read(path, summary, error);
    sb_folder_remove(folder, NULL);
    return status;
}

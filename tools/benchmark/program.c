#include "program.h"

#include "process.h"

#include "output/tool.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    return remove(path);
}

static sb_status run_in(const sb_bench_program *run, char *folder, sb_error *error)
{
    static const char *const quiet[] = {"render.interval=0", "output.plots=false", "output.particle_interval=0"};
    char program[SB_PATH_MAX], threads[16], *arguments[64];
    int count = 0;
    sb_status status = sb_process_beside("shorebreak", program, error);
    if (status != SB_OK) return status;
    snprintf(threads, sizeof threads, "%d", run->threads);
    const char *const first[] = {program, "run", run->scene, "--quiet", "--out", folder, "--threads", threads};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++) arguments[count++] = (char *)first[i];
    for (size_t i = 0; i < sizeof quiet / sizeof quiet[0]; i++) {
        arguments[count++] = (char *)"--set";
        arguments[count++] = (char *)quiet[i];
    }
    for (size_t i = 0; i < SB_BENCH_SETTINGS_MAX && run->settings[i]; i++) {
        arguments[count++] = (char *)"--set";
        arguments[count++] = (char *)run->settings[i];
    }
    if (run->preset) {
        arguments[count++] = (char *)"--preset";
        arguments[count++] = (char *)run->preset;
    }
    arguments[count] = NULL;
    return sb_tool_run(program, arguments, "/", error);
}

sb_status sb_bench_program_run(const sb_bench_program *run, char **summary, sb_error *error)
{
    char path[SB_PATH_MAX], folder[] = "/tmp/shorebreak-bench-XXXXXX";
    size_t length;
    if (!mkdtemp(folder)) return sb_fail(error, SB_FAILED, "%s: cannot make a folder", folder);
    sb_status status = run_in(run, folder, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "summary.json", error);
    if (status == SB_OK) status = sb_file_read(path, (size_t)1 << 26, summary, &length, error);
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    return status;
}

/* tools/bench: measures run time and memory; writes tables and the report. */
#include "limits.h"
#include "machine.h"
#include "options.h"
#include "origin.h"
#include "report.h"

#include "base/file.h"
#include "base/memory.h"
#include "base/stop.h"

#include <stdio.h>
#include <time.h>

static void warn_of_others(double others)
{
    if (others > SB_BENCH_QUIET)
        fprintf(stderr, "bench: warning: other programs use %.1f cores: times are not reliable\n", others);
}

/* Measures one section and writes its table. build: lines with machine, compiler and commit. check: whether to check
   that the kept tables are of this machine. */
static sb_status measure(const sb_bench_section *section, sb_bench_request *request, const char *folder, bool check,
                         const char *build, sb_error *error)
{
    char path[SB_PATH_MAX], name[SB_BENCH_NAME], origin[2048], date[32], busy[64] = "use by other programs unknown";
    sb_bench_rows rows = {0};
    const double load = sb_origin_load();
    const time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d %H:%M", gmtime(&now));
    printf("%s: %s (load average %.2f)\n", section->name, section->summary, load);
    const sb_bench_clock from = sb_bench_clock_now();
    sb_status status = sb_bench_limits(request, &rows, error);
    if (status == SB_OK && check) status = sb_bench_same_machine(folder, request, error);
    if (status == SB_OK) status = section->run(request, &rows, error);
    const sb_bench_clock to = sb_bench_clock_now();
    const double others = sb_bench_others(from, to);
    if (others >= 0) snprintf(busy, sizeof busy, "other programs kept %.2f cores busy", others);
    snprintf(origin, sizeof origin,
             "%smeasured: %s UTC, %d threads, %d repeats (whole runs: one)%s; load average before %.2f; %s\n", build,
             date, request->threads, request->repeats, request->quick ? SB_BENCH_QUICKLY : "", load, busy);
    fputs(origin, stdout);
    warn_of_others(others);
    snprintf(name, sizeof name, "%s.csv", section->name);
    if (status == SB_OK) status = sb_path_join(path, folder, name, error);
    if (status == SB_OK) status = sb_bench_write(&rows, origin, path, error);
    if (status == SB_OK) printf("%s: %.1f s, %s\n", section->name, to.wall - from.wall, path);
    sb_bench_rows_free(&rows);
    return status;
}

static sb_status measure_all(const sb_bench_options *o, const char *out, sb_error *error)
{
    char bench[SB_PATH_MAX], folder[SB_PATH_MAX], machine[128], name[128], build[1024];
    sb_bench_request request = {
        .assets = SB_SOURCE_DIR "/assets", .repeats = o->repeats, .threads = o->threads, .quick = o->common.quick};
    sb_origin_machine(machine);
    sb_bench_folder(machine, name);
    sb_status status = sb_path_join(bench, out, "bench", error);
    if (status == SB_OK) status = sb_path_join(folder, bench, o->machine ? o->machine : name, error);
    if (status == SB_OK) status = sb_make_directories(folder, error);
    sb_bench_origin(build, sizeof build, SB_SOURCE_DIR); /* before tables change the state of git */
    for (size_t s = 0; s < o->count && status == SB_OK; s++)
        status = sb_stop_signal()
                     ? sb_stop_fail(error, "before all sections were measured")
                     : measure(o->sections[s], &request, folder, !o->machine && !o->common.quick, build, error);
    return status;
}

static sb_status bench(const sb_bench_options *o, sb_error *error)
{
    const char *out = o->common.out     ? o->common.out
                      : o->common.quick ? SB_SOURCE_DIR "/build/bench"
                                        : SB_SOURCE_DIR "/docs/results";
    sb_status status = o->common.report_only ? SB_OK : measure_all(o, out, error);
    if (status == SB_OK) status = sb_bench_report(out, error);
    if (status == SB_OK) printf("%s/benchmarks.md\n", out);
    return status;
}

int main(int count, char **arguments)
{
    sb_bench_options o;
    sb_error error = {0};
    sb_memory_return_blocks(); /* as shorebreak does */
    sb_stop_watch();
    sb_status status = sb_bench_parse(count, arguments, &o, &error);
    if (status == SB_OK && !o.common.answered) status = bench(&o, &error);
    return sb_tool_end("bench", status, 0, &error);
}

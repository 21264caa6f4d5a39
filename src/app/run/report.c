/* Messages of a run to the terminal and its log, and the paths of its files. */
#include "app/cluster/cluster.h"
#include "app/run/parts.h"

#include <stdarg.h>
#include <stdio.h>

sb_status sb_run_path(const run *r, const char *name, char path[SB_PATH_MAX], sb_error *error)
{
    return sb_path_join(path, r->directory, name, error);
}

void sb_run_report(const run *r, const char *format, ...)
{
    va_list arguments;
    if (!r->progress.stream) return;
    va_start(arguments, format);
    vfprintf(r->progress.stream, format, arguments);
    va_end(arguments);
    fputc('\n', r->progress.stream);
}

void sb_run_warn(run *r, const char *format, ...)
{
    char text[1100];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    sb_runlog_warning(r->log, "%s", text);
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

void sb_run_ensure_log(run *r)
{
    if (sb_runlog_remade(r->log))
        sb_run_warn(r, "%.500s/run.jsonl: was removed during the run; its earlier lines are lost", r->directory);
}

double sb_run_wall(const run *r)
{
    return r->before.wall + sb_progress_wall(&r->progress);
}

void sb_run_log_step(run *r)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    const sb_energy energy = sb_cluster_energy(r);
    sb_runlog_state state = {.report = report, .energy = &energy, .has_foam = r->scene->foam.enabled, .has_hash = true};
    state.stage_count = sb_sim_stages(r->sim, &state.stages);
    state.hash = sb_cluster_hash(r);
    sb_runlog_step(r->log, &state);
}

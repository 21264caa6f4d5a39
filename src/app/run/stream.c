/* What the stream reports of a run between frames. */
#include "app/run/parts.h"

#include <string.h>

void sb_run_inform_stream(run *r)
{
    sb_stream *stream = r->streamer.stream;
    if (!stream) return;
    const sb_step_report *report = sb_sim_report(r->sim);
    const sb_stage_time *stages;
    sb_stream_progress progress = {
        .status = {.step = report->step,
                   .time = report->time,
                   .duration = r->scene->duration,
                   .time_step = report->time_step,
                   .iterations = report->iterations,
                   .density_error = report->error_mean,
                   .max_speed = report->max_speed,
                   .wall_seconds = sb_run_wall(r),
                   .eta_seconds = sb_progress_eta(&r->progress),
                   .lost_particles = report->lost},
        .density_error_max = report->error_max,
        .tolerance = report->tolerance,
        .capped_steps = r->capped,
        .fluid_particles = report->fluid_count,
        .frames_dropped = sb_frame_queue_dropped(r->consumers[STREAMER].queue),
    };
    progress.stage_count = sb_sim_stages(r->sim, &stages);
    memcpy(progress.stages, stages, progress.stage_count * sizeof *stages);
    sb_stream_set_progress(stream, &progress);
    if (r->measure) sb_stream_measure(stream, sb_measure_latest(r->measure));
}

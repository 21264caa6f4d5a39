/* What each command does, in the run's thread. */
#include "app/checkpoint/checkpoint.h"
#include "app/cluster/cluster.h"
#include "app/run/parts.h"
#include "app/steering/picture_now.h"
#include "app/steering/steering.h"
#include "base/stop.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static bool settles(const run *r)
{
    int done;
    return sb_sim_settling(r->sim, &done);
}

/* ---- the commands: each writes what it has done, or fails with the reason ---- */

typedef sb_status act(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error);

void sb_steering_set_paused(run *r, bool paused)
{
    r->steering.paused = paused;
    sb_stream_set_state(r->streamer.stream, paused ? SB_RUN_PAUSED : SB_RUN_RUNNING);
}

static sb_status act_pause(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)command;
    (void)error;
    snprintf(done, SB_STREAM_TEXT, r->steering.paused ? "the run is paused already" : "paused");
    r->steering.steps = 0;
    sb_steering_set_paused(r, true);
    return SB_OK;
}

static sb_status act_resume(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)command;
    (void)error;
    snprintf(done, SB_STREAM_TEXT, r->steering.paused ? "resumed" : "the run is not paused");
    r->steering.steps = 0;
    sb_steering_set_paused(r, false);
    return SB_OK;
}

static sb_status act_step(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)error;
    r->steering.steps = (uint64_t)command->count;
    sb_steering_set_paused(r, false);
    snprintf(done, SB_STREAM_TEXT, "%" PRId64 " %s, then paused", command->count,
             command->count == 1 ? "step" : "steps");
    return SB_OK;
}

static sb_status act_stop(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)r;
    (void)command;
    (void)error;
    snprintf(done, SB_STREAM_TEXT, "the run stops");
    sb_stop_request();
    return SB_OK;
}

static sb_status act_checkpoint(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    const sb_checkpoints *c = &r->checkpoints;
    (void)command;
    if (!c->on) return sb_fail(error, SB_BAD_INPUT, "output.checkpoint is off in the scene");
    const bool before = settles(r);
    if (before)
        sb_checkpoint_write_settling(r);
    else
        sb_checkpoint_write(r);
    if (!(before ? c->settling : c->current))
        return sb_fail(error, SB_FAILED, "the checkpoint could not be written; run.jsonl has the reason");
    snprintf(done, SB_STREAM_TEXT, before ? "checkpoint of the settling" : "checkpoint of step %" PRIu64, c->last_step);
    return SB_OK;
}

static sb_status act_rate(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)error;
    sb_stream_limits limits = sb_stream_get_limits(r->streamer.stream);
    limits.rate = command->number[0];
    sb_stream_set_limits(r->streamer.stream, &limits);
    if (limits.rate > 0)
        snprintf(done, SB_STREAM_TEXT, "at most %g frames per second", limits.rate);
    else
        snprintf(done, SB_STREAM_TEXT, "frames without a limit of their rate");
    return SB_OK;
}

static sb_status act_decimation(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)error;
    sb_stream_limits limits = sb_stream_get_limits(r->streamer.stream);
    limits.decimation = (int)command->count;
    sb_stream_set_limits(r->streamer.stream, &limits);
    snprintf(done, SB_STREAM_TEXT, "one particle in %d is sent", limits.decimation);
    return SB_OK;
}

static sb_status act_region(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)error;
    const double *at = command->number;
    sb_stream_limits limits = sb_stream_get_limits(r->streamer.stream);
    limits.region = !command->off;
    limits.min = sb_vec(at[0], at[1], at[2]);
    limits.max = sb_vec(at[3], at[4], at[5]);
    sb_stream_set_limits(r->streamer.stream, &limits);
    if (command->off)
        snprintf(done, SB_STREAM_TEXT, "particles of the whole domain are sent");
    else
        snprintf(done, SB_STREAM_TEXT, "particles from (%g, %g, %g) to (%g, %g, %g) m are sent", at[0], at[1], at[2],
                 at[3], at[4], at[5]);
    return SB_OK;
}

/* The thread that draws sends the reply. */
static sb_status act_picture(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    *done = 0;
    if (settles(r)) return sb_fail(error, SB_BAD_INPUT, "the water settles, expected a command after that");
    return sb_picture_now(r, command, error);
}

static sb_status act_trigger(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    const sb_scene *scene = r->scene;
    size_t w = 0;
    while (w < scene->wavemaker_count && strcmp(scene->wavemakers[w].name, command->name) != 0) w++;
    if (w == scene->wavemaker_count)
        return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": there is none of this name", command->name);
    if (isfinite(scene->wavemakers[w].law.start))
        return sb_fail(error, SB_BAD_INPUT,
                       "wave maker \"%s\": its start is %g s in the scene, expected start: command", command->name,
                       scene->wavemakers[w].law.start);
    const sb_status status = sb_cluster_trigger(r, w, error);
    if (status != SB_OK) return status;
    const sb_step_report *report = sb_sim_report(r->sim);
    sb_runlog_event(r->log, "trigger", "wave maker \"%s\" begins before step %" PRIu64 ": start: %.17g", command->name,
                    report->step + 1, report->time);
    /* A run that is killed and resumed repeats the start. A checkpoint of this step that exists does not have it. */
    r->checkpoints.current = false;
    sb_checkpoint_write(r);
    snprintf(done, SB_STREAM_TEXT, "wave maker \"%s\" begins at t = %.17g s", command->name, report->time);
    return SB_OK;
}

/* All but SB_COMMAND_LOSS, which has no reply. */
static act *const acts[SB_COMMANDS] = {
    [SB_COMMAND_PAUSE] = act_pause,
    [SB_COMMAND_RESUME] = act_resume,
    [SB_COMMAND_STEP] = act_step,
    [SB_COMMAND_STOP] = act_stop,
    [SB_COMMAND_CHECKPOINT] = act_checkpoint,
    [SB_COMMAND_RATE] = act_rate,
    [SB_COMMAND_DECIMATION] = act_decimation,
    [SB_COMMAND_REGION] = act_region,
    [SB_COMMAND_PICTURE] = act_picture,
    [SB_COMMAND_TRIGGER] = act_trigger,
};

void sb_steering_reply(run *r, const sb_command *command, uint64_t step, double time, bool refused, const char *text)
{
    sb_reply_message reply = {
        .id = command->id, .counter = command->counter, .refused = refused, .step = (int64_t)step, .time = time};
    snprintf(reply.text, sizeof reply.text, "%.*s", SB_STREAM_TEXT - 1, text);
    sb_runlog_event(r->log, "command", "%s at step %" PRIu64 ", t = %.9g s: %s%s", sb_command_name(command->kind), step,
                    time, refused ? "refused: " : "", text);
    sb_stream_reply(r->streamer.stream, &reply);
}

void sb_steering_obey(run *r, const sb_command *command)
{
    char done[SB_STREAM_TEXT];
    sb_error fault = {0};
    const sb_step_report *report = sb_sim_report(r->sim);
    const sb_status status = acts[command->kind](r, command, done, &fault);
    if (status != SB_OK || *done)
        sb_steering_reply(r, command, report->step, report->time, status != SB_OK, status == SB_OK ? done : fault.text);
}

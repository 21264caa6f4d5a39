#include "app/steering.h"

#include "app/checkpoint.h"
#include "app/picture_now.h"
#include "app/run_parts.h"
#include "base/clock.h"
#include "base/stop.h"
#include "control/target.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static const double WAIT_SECONDS = 0.2; /* of a paused run, at most, between two looks for signals and the helper */
static const double LOG_SECONDS = 10;   /* between two lines of the log with the counts of refused commands */

enum { RECORDS_MOST = 300 }; /* before a step: those that fit into a pipe */

static bool settles(const run *r)
{
    int done;
    return sb_sim_settling(r->sim, &done);
}

/* ---- the commands: each writes what it has done, or fails with the reason ---- */

typedef sb_status act(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error);

static void set_paused(run *r, bool paused)
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
    set_paused(r, true);
    return SB_OK;
}

static sb_status act_resume(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)command;
    (void)error;
    snprintf(done, SB_STREAM_TEXT, r->steering.paused ? "resumed" : "the run is not paused");
    r->steering.steps = 0;
    set_paused(r, false);
    return SB_OK;
}

static sb_status act_step(run *r, const sb_command *command, char done[SB_STREAM_TEXT], sb_error *error)
{
    (void)error;
    r->steering.steps = (uint64_t)command->count;
    set_paused(r, false);
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
    const sb_status status = sb_sim_trigger(r->sim, w, error);
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

static void obey(run *r, const sb_command *command)
{
    char done[SB_STREAM_TEXT];
    sb_error fault = {0};
    const sb_step_report *report = sb_sim_report(r->sim);
    const sb_status status = acts[command->kind](r, command, done, &fault);
    if (status != SB_OK || *done)
        sb_steering_reply(r, command, report->step, report->time, status != SB_OK, status == SB_OK ? done : fault.text);
}

/* ---- records of the helper itself ---- */

static void sum_counts(const sb_steering *s, double sum[SB_STEERING_COUNTS])
{
    for (int k = 0; k < SB_STEERING_COUNTS; k++) sum[k] = s->counts_before[k] + s->counts[k];
}

/* Logs the counts if messages were refused since they were logged last. */
static void log_counts(run *r, bool last)
{
    sb_steering *s = &r->steering;
    double sum[SB_STEERING_COUNTS], refused = 0;
    sum_counts(s, sum);
    for (int k = 1; k < SB_STEERING_COUNTS; k++) refused += sum[k];
    const double now = sb_clock();
    if (!(refused > s->refused_logged) || (!last && s->refused_logged > 0 && now < s->counts_logged + LOG_SECONDS))
        return;
    s->refused_logged = refused;
    s->counts_logged = now;
    sb_runlog_event(r->log, "commands",
                    "%.0f obeyed; refused: %.0f malformed, %.0f foreign, %.0f replayed, %.0f flooded", sum[0], sum[1],
                    sum[2], sum[3], sum[4]);
}

static void take_record(run *r, const sb_command *command)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    sb_steering *s = &r->steering;
    switch (command->kind) {
    case SB_COMMAND_LOSS: {
        const sb_stream_limits limits = sb_stream_adapt(sb_stream_get_limits(r->streamer.stream), command->number[0]);
        sb_stream_set_limits(r->streamer.stream, &limits);
        break;
    }
    case SB_COMMAND_COUNTS:
        memcpy(s->counts, command->number, sizeof s->counts);
        log_counts(r, false);
        break;
    case SB_COMMAND_BAD:
        sb_steering_reply(r, command, report->step, report->time, true, command->name);
        break;
    default:
        if (s->allowed) obey(r, command);
    }
}

/* ---- waiting ---- */

static void watch_helper(run *r)
{
    sb_steering *s = &r->steering;
    const sb_helper_news news = sb_helper_watch(&s->helper);
    if (news == SB_HELPER_SAME) return;
    for (int k = 0; k < SB_STEERING_COUNTS; k++) s->counts_before[k] += s->counts[k];
    memset(s->counts, 0, sizeof s->counts);
    if (news == SB_HELPER_RESTARTED) {
        sb_run_warn(r, "shorebreak-live has ended; it was started again");
        return;
    }
    sb_run_warn(r, "shorebreak-live has ended %d times and is not started again: the run takes no more commands%s",
                SB_HELPER_RESTARTS + 1, s->paused ? ", and is resumed" : "");
    s->steps = 0;
    if (s->paused) set_paused(r, false);
}

static void take_all(run *r)
{
    sb_command command;
    /* The helper writes fewer. One that a forged packet controls does not keep the run from its steps. */
    for (int k = 0; k < RECORDS_MOST; k++) {
        if (!sb_helper_next(&r->steering.helper, &command)) {
            watch_helper(r);
            return;
        }
        take_record(r, &command);
    }
}

void sb_steering_take(run *r)
{
    sb_steering *s = &r->steering;
    if (!s->helper.on) return;
    if (s->steps > 0 && --s->steps == 0) set_paused(r, true);
    const double start = sb_clock();
    take_all(r);
    if (s->paused && !sb_stop_signal()) {
        sb_progress_break(&r->progress);
        sb_run_report(r, "paused by a command at t = %.9g s", sb_sim_report(r->sim)->time);
        while (s->paused && !sb_stop_signal()) {
            sb_helper_wait(&s->helper, WAIT_SECONDS);
            take_all(r);
        }
        sb_progress_paused(&r->progress, sb_clock() - start);
    }
}

/* ---- begin and end ---- */

void sb_steering_start(run *r)
{
    sb_steering *s = &r->steering;
    sb_error reason = {0};
    sb_token token;
    char where[SB_TARGET_TEXT];
    if (!r->scene->control.enabled || !r->streamer.stream) return;
    if (strncasecmp(sb_stream_url(r->streamer.stream), "file:", 5) == 0) { /* the helper would open it, too */
        sb_run_warn(r, "the run takes no commands: its stream goes to a file");
        return;
    }
    sb_status status = sb_run_path(r, SB_TOKEN_FILE, s->token_file, &reason);
    if (status == SB_OK) status = sb_token_make(s->token_file, &token, &reason);
    s->allowed = status == SB_OK;
    const sb_helper_setup setup = {.url = r->scene->stream.url,
                                   .prefix = r->scene->stream.prefix,
                                   .token_file = s->token_file,
                                   .run_id = sb_stream_run_id(r->streamer.stream)};
    if (status == SB_OK)
        status = sb_target_write(setup.run_id, setup.prefix, sb_stream_url(r->streamer.stream), where, &reason);
    if (status == SB_OK) status = sb_helper_start(&s->helper, &setup, &reason);
    if (status == SB_OK) sb_runlog_event(r->log, SB_TARGET_EVENT, "%s", where);
    if (status == SB_OK && r->scene->control.paused) set_paused(r, true);
    if (status != SB_OK) sb_run_warn(r, "the run takes no commands: %.900s", reason.text);
}

void sb_steering_end(run *r)
{
    sb_steering *s = &r->steering;
    sb_command command;
    sb_picture_now_end(r);
    if (s->helper.on) {
        sb_helper_end(&s->helper);
        while (sb_helper_next(&s->helper, &command))
            if (command.kind == SB_COMMAND_COUNTS) memcpy(s->counts, command.number, sizeof s->counts);
        sb_helper_close(&s->helper);
    }
    log_counts(r, true);
    if (s->allowed) (void)unlink(s->token_file);
}

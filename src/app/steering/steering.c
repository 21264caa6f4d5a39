#include "app/steering/steering.h"

#include "app/cluster/cluster.h"
#include "app/run/parts.h"
#include "app/steering/picture_now.h"
#include "base/clock.h"
#include "base/stop.h"
#include "control/target.h"

#include <string.h>
#include <strings.h>
#include <unistd.h>

static const double WAIT_SECONDS = 0.2; /* of a paused run, at most, between two looks for signals and the helper */
static const double LOG_SECONDS = 10;   /* between two lines of the log with the counts of refused commands */

enum { RECORDS_MOST = 300 }; /* before a step: those that fit into a pipe */

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

/* A subscriber or the helper has lost a share of the stream: changes the speed within a frame. Logs it when it has
   doubled or halved. */
static void adapt(run *r, double lost)
{
    sb_steering *s = &r->steering;
    const sb_stream_limits limits = sb_stream_adapt(sb_stream_get_limits(r->streamer.stream), lost);
    const double pace = limits.bytes_per_second;
    sb_stream_set_limits(r->streamer.stream, &limits);
    if (!(s->pace_logged > 0)) s->pace_logged = SB_STREAM_BYTES_MAX;
    if (pace > s->pace_logged / 2 && pace < s->pace_logged * 2) return;
    s->pace_logged = pace;
    sb_runlog_event(r->log, "stream pace", "%.3g MB/s within a frame, since subscribers lost %.2g %% of the messages",
                    1e-6 * pace, 100 * lost);
}

static void take_record(run *r, const sb_command *command)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    sb_steering *s = &r->steering;
    switch (command->kind) {
    case SB_COMMAND_LOSS:
        adapt(r, command->number[0]);
        break;
    case SB_COMMAND_COUNTS:
        memcpy(s->counts, command->number, sizeof s->counts);
        log_counts(r, false);
        break;
    case SB_COMMAND_BAD:
        sb_steering_reply(r, command, report->step, report->time, true, command->name);
        break;
    default:
        if (s->allowed) sb_steering_obey(r, command);
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
    sb_run_warn(r, "shorebreak-live has ended %d times and is not started again: the run %s%s", SB_HELPER_RESTARTS + 1,
                s->allowed ? "takes no more commands" : "is not shown to browsers any more",
                s->paused ? ", and is resumed" : "");
    s->steps = 0;
    if (s->paused) sb_steering_set_paused(r, false);
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
    if (s->steps > 0 && --s->steps == 0) sb_steering_set_paused(r, true);
    const double start = sb_clock();
    take_all(r);
    if (s->paused && !sb_stop_signal()) {
        sb_progress_break(&r->progress);
        sb_run_report(r, "paused at t = %.9g s; to continue: tools/control %s resume", sb_sim_report(r->sim)->time,
                      r->directory);
        while (s->paused && !sb_stop_signal()) {
            sb_helper_wait(&s->helper, WAIT_SECONDS);
            take_all(r);
            sb_cluster_stay(r);
            sb_cluster_heed(r);
        }
        sb_progress_paused(&r->progress, sb_clock() - start);
    }
}

/* ---- begin and end ---- */

/* Makes the token, and the text by which tools/control finds the run. */
static sb_status allow(run *r, char where[SB_TARGET_TEXT], sb_error *error)
{
    sb_steering *s = &r->steering;
    sb_token token;
    sb_status status = sb_run_path(r, SB_TOKEN_FILE, s->token_file, error);
    if (status == SB_OK) status = sb_token_make(s->token_file, &token, error);
    s->allowed = status == SB_OK;
    const sb_stream *stream = r->streamer.stream;
    return status == SB_OK
               ? sb_target_write(sb_stream_run_id(stream), r->scene->stream.prefix, sb_stream_url(stream), where, error)
               : status;
}

void sb_steering_start(run *r)
{
    sb_steering *s = &r->steering;
    sb_error reason = {0};
    char where[SB_TARGET_TEXT];
    const bool commands = r->scene->control.enabled;
    if (!(commands || s->live_port > 0) || !r->streamer.stream) return;
    const char *refused = commands ? "takes no commands" : "is not shown to browsers";
    if (strncasecmp(sb_stream_url(r->streamer.stream), "file:", 5) == 0) { /* the helper would open it, too */
        sb_run_warn(r, "the run %s: its stream goes to a file", refused);
        return;
    }
    sb_status status = commands ? allow(r, where, &reason) : SB_OK;
    const sb_helper_setup setup = {.url = r->scene->stream.url,
                                   .prefix = r->scene->stream.prefix,
                                   .token_file = s->allowed ? s->token_file : NULL,
                                   .run_id = sb_stream_run_id(r->streamer.stream),
                                   .port = s->live_port,
                                   .address = s->live_address};
    if (status == SB_OK) status = sb_helper_start(&s->helper, &setup, &reason);
    if (status == SB_OK && commands) sb_runlog_event(r->log, SB_TARGET_EVENT, "%s", where);
    if (status == SB_OK && commands && r->scene->control.paused) sb_steering_set_paused(r, true);
    if (status != SB_OK) sb_run_warn(r, "the run %s: %.900s", refused, reason.text);
}

void sb_steering_end(run *r)
{
    sb_steering *s = &r->steering;
    sb_picture_now_end(r);
    if (s->live_port == 0) sb_steering_close(r);
    if (s->allowed) (void)unlink(s->token_file);
}

void sb_steering_close(run *r)
{
    sb_steering *s = &r->steering;
    sb_command command;
    if (s->helper.on) {
        sb_helper_end(&s->helper);
        while (sb_helper_next(&s->helper, &command))
            if (command.kind == SB_COMMAND_COUNTS) memcpy(s->counts, command.number, sizeof s->counts);
        sb_helper_close(&s->helper);
    }
    log_counts(r, true);
}

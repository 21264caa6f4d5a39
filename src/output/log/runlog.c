#include "output/log/runlog.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/log/json.h"
#include "output/log/trust.h"
#include "scene/key.h"

#include <errno.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio_ext.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct sb_runlog {
    FILE *stream;
    char path[SB_PATH_MAX];
    double opened;
    off_t complete; /* length up to the end of the last complete line */
    int reason;     /* errno of the first failure, 0: none */
    bool lost;      /* removed, and could not be created again */
    pthread_mutex_t mutex;
};

static sb_status open_log(const char *path, const char *mode, sb_runlog **log, sb_error *error)
{
    sb_runlog *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, path);
    snprintf(made->path, sizeof made->path, "%s", path);
    sb_status status = sb_file_open(path, mode, &made->stream, error);
    if (status != SB_OK) {
        sb_free(made);
        return status;
    }
    made->opened = sb_clock();
    if (fseeko(made->stream, 0, SEEK_END) == 0) made->complete = ftello(made->stream);
    pthread_mutex_init(&made->mutex, NULL);
    *log = made;
    return SB_OK;
}

sb_status sb_runlog_open(const char *path, sb_runlog **log, sb_error *error)
{
    return open_log(path, "w", log, error);
}

/* Cuts the file after its last complete line. */
static sb_status drop_incomplete_line(const char *path, sb_error *error)
{
    FILE *file;
    sb_status status = sb_file_open(path, "r+", &file, error);
    if (status != SB_OK) return errno == ENOENT ? SB_OK : status;
    long end = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : 0, keep = end;
    while (keep > 0 && fseek(file, keep - 1, SEEK_SET) == 0 && fgetc(file) != '\n') keep--;
    bool bad = keep < end && ftruncate(fileno(file), keep) != 0;
    int reason = errno;
    fclose(file);
    return bad ? sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, strerror(reason)) : SB_OK;
}

sb_status sb_runlog_append(const char *path, sb_runlog **log, sb_error *error)
{
    sb_status status = drop_incomplete_line(path, error);
    return status == SB_OK ? open_log(path, "a", log, error) : status;
}

sb_status sb_runlog_sync(sb_runlog *log, sb_error *error)
{
    if (!log || fsync(fileno(log->stream)) == 0) return SB_OK;
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", log->path, strerror(errno));
}

bool sb_runlog_remade(sb_runlog *log)
{
    struct stat found;
    if (!log) return false;
    pthread_mutex_lock(&log->mutex);
    const bool removed = !log->lost && fstat(fileno(log->stream), &found) == 0 && found.st_nlink == 0;
    FILE *created = NULL;
    log->lost |= removed && sb_file_open(log->path, "a", &created, NULL) != SB_OK;
    if (created) {
        fclose(log->stream); /* each line was flushed */
        log->stream = created;
        log->complete = fseeko(created, 0, SEEK_END) == 0 ? ftello(created) : 0;
    }
    pthread_mutex_unlock(&log->mutex);
    return removed;
}

static sb_status write_status(const sb_runlog *log, sb_error *error)
{
    return log->reason ? sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", log->path, strerror(log->reason))
                       : SB_OK;
}

sb_status sb_runlog_check(sb_runlog *log, sb_error *error)
{
    if (!log) return SB_OK;
    pthread_mutex_lock(&log->mutex);
    sb_status status = write_status(log, error);
    pthread_mutex_unlock(&log->mutex);
    return status;
}

sb_status sb_runlog_close(sb_runlog *log, sb_error *error)
{
    if (!log) return SB_OK;
    if (fclose(log->stream) != 0 && !log->reason) log->reason = errno;
    sb_status status = write_status(log, error);
    pthread_mutex_destroy(&log->mutex);
    sb_free(log);
    return status;
}

/* Between begin and end the log is locked and *json is inside of the line's object. */
static void begin(sb_runlog *log, sb_json *json, const char *event)
{
    pthread_mutex_lock(&log->mutex);
    errno = 0;
    sb_json_begin(json, log->stream, false);
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "event", event);
    sb_json_number(json, "wall_s", sb_clock() - log->opened);
}

/* Removes an incomplete line after a write error. Shortening works on a full disk, and the next line may fit again. */
static void remove_line(sb_runlog *log)
{
    if (!log->reason) log->reason = errno ? errno : EIO;
    __fpurge(log->stream);
    clearerr(log->stream);
    if (ftruncate(fileno(log->stream), log->complete) == 0) (void)fseeko(log->stream, log->complete, SEEK_SET);
}

static void end(sb_runlog *log, sb_json *json)
{
    sb_json_close(json);
    if (fflush(log->stream) != 0 || ferror(log->stream))
        remove_line(log);
    else
        log->complete = ftello(log->stream);
    pthread_mutex_unlock(&log->mutex);
}

/* Writes all keys of the `numerics` block in the order of the scene's table. */
static void put_numerics(sb_json *json, const sb_numerics *numerics)
{
    sb_json_open(json, "numerics", '{');
    for (size_t i = 0; i < sb_numerics_table.count; i++) {
        const sb_key *key = &sb_numerics_table.keys[i];
        const void *field = (const char *)numerics + key->offset;
        unsigned choice;
        switch (key->type) {
        case SB_KEY_NUMBER:
            sb_json_number(json, key->name, *(const double *)field);
            break;
        case SB_KEY_INTEGER:
            sb_json_count(json, key->name, (uint64_t) * (const int *)field);
            break;
        case SB_KEY_SEED:
            sb_json_count(json, key->name, *(const uint64_t *)field);
            break;
        case SB_KEY_SWITCH:
            sb_json_bool(json, key->name, *(const bool *)field);
            break;
        case SB_KEY_CHOICE:
            memcpy(&choice, field, sizeof choice);
            sb_json_text(json, key->name, key->words[choice]);
            break;
        case SB_KEY_KERNEL:
            sb_json_text(json, key->name, numerics->kernel ? numerics->kernel->name : NULL);
            break;
        default: /* the block has no other types */
            break;
        }
    }
    sb_json_close(json);
}

void sb_runlog_start(sb_runlog *log, const sb_scene *scene, const sb_model *model, int threads, size_t bytes)
{
    if (!log) return;
    sb_json json;
    begin(log, &json, "start");
    sb_json_text(&json, "version", SB_VERSION);
    sb_json_text(&json, "scene", scene->path);
    sb_json_text(&json, "title", scene->title);
    sb_json_count(&json, "dimensions", (uint64_t)scene->dimensions);
    sb_json_number(&json, "resolution", scene->resolution);
    sb_json_number(&json, "duration", scene->duration);
    sb_json_count(&json, "threads", (uint64_t)threads);
    sb_json_count(&json, "fluid_particles", model->fluid_count);
    sb_json_count(&json, "boundary_particles", model->wall_count);
    sb_json_number(&json, "still_depth", model->still_depth);
    sb_json_count(&json, "bytes", bytes);
    put_numerics(&json, &scene->numerics);
    sb_json_open(&json, "warnings", '[');
    for (size_t i = 0; i < model->warning_count; i++) sb_json_text(&json, NULL, model->warnings[i]);
    sb_json_close(&json);
    end(log, &json);
}

void sb_runlog_arguments(sb_runlog *log, const char *folder, int count, char *const *arguments)
{
    if (!log) return;
    sb_json json;
    begin(log, &json, "arguments");
    sb_json_text(&json, "folder", folder);
    sb_json_open(&json, "arguments", '[');
    for (int i = 0; i < count; i++) sb_json_text(&json, NULL, arguments[i]);
    sb_json_close(&json);
    end(log, &json);
}

static void put_line(sb_runlog *log, const char *event, const char *text)
{
    sb_json json;
    begin(log, &json, event);
    sb_json_text(&json, "text", text);
    end(log, &json);
}

void sb_runlog_skipped(sb_runlog *log, const sb_skipped *list)
{
    sb_json json;
    for (; log && list->what; list++) {
        begin(log, &json, "skipped");
        sb_json_text(&json, "text", list->what);
        if (list->passes > 0) sb_json_count(&json, "pair_passes_per_step", (uint64_t)list->passes);
        if (list->bytes > 0) sb_json_count(&json, "bytes", list->bytes);
        end(log, &json);
    }
}

void sb_runlog_saved(sb_runlog *log, const sb_saved *saved)
{
    if (!log) return;
    sb_json json;
    begin(log, &json, "saved");
    sb_json_count(&json, "pair_passes_per_step", (uint64_t)saved->passes);
    sb_json_number(&json, "seconds", saved->seconds);
    sb_json_count(&json, "bytes", saved->bytes);
    end(log, &json);
}

static void put_formatted(sb_runlog *log, const char *event, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));

static void put_formatted(sb_runlog *log, const char *event, const char *format, va_list arguments)
{
    char text[2048];
    if (!log) return;
    vsnprintf(text, sizeof text, format, arguments);
    put_line(log, event, text);
}

void sb_runlog_warning(sb_runlog *log, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    put_formatted(log, "warning", format, arguments);
    va_end(arguments);
}

void sb_runlog_event(sb_runlog *log, const char *event, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    put_formatted(log, event, format, arguments);
    va_end(arguments);
}

void sb_runlog_step(sb_runlog *log, const sb_runlog_state *state)
{
    if (!log) return;
    const sb_step_report *report = state->report;
    sb_json json;
    begin(log, &json, "step");
    sb_json_count(&json, "step", report->step);
    sb_json_number(&json, "time_s", report->time);
    sb_json_number(&json, "dt_s", report->time_step);
    sb_json_count(&json, "iterations", (uint64_t)report->iterations);
    sb_json_bool(&json, "capped", report->capped);
    sb_json_number(&json, "tolerance", report->tolerance);
    sb_json_number(&json, "error_mean", report->error_mean);
    sb_json_number(&json, "error_residual", report->error_residual);
    sb_json_number(&json, "error_max", report->error_max);
    sb_json_number(&json, "compression_mean", report->compression);
    sb_json_number(&json, "compression_max", report->compression_max);
    sb_json_number(&json, "max_speed_m_s", report->max_speed);
    sb_json_count(&json, "fluid_particles", report->fluid_count);
    sb_json_count(&json, "left_domain", report->left_domain);
    sb_json_count(&json, "lost", report->lost);
    if (state->has_foam) {
        sb_json_count(&json, "foam_spray", report->foam[SB_FOAM_SPRAY]);
        sb_json_count(&json, "foam_floating", report->foam[SB_FOAM_FLOATS]);
        sb_json_count(&json, "foam_bubbles", report->foam[SB_FOAM_BUBBLES]);
    }
    if (state->energy) {
        sb_json_number(&json, "kinetic_J", state->energy->kinetic);
        sb_json_number(&json, "potential_J", state->energy->potential);
    }
    if (state->stage_count) {
        sb_json_open(&json, "stages_s", '{');
        for (size_t i = 0; i < state->stage_count; i++)
            sb_json_number(&json, state->stages[i].name, state->stages[i].seconds);
        sb_json_close(&json);
    }
    if (state->has_hash) sb_json_hash(&json, "state_hash", state->hash);
    end(log, &json);
}

void sb_runlog_bodies(sb_runlog *log, const sb_model *model, const sb_body_record *bodies)
{
    for (size_t b = 0; log && b < model->body_count; b++) {
        if (!bodies[b].report || (isnan(bodies[b].layers) && !(model->bodies[b].gap > 0))) continue;
        sb_json json;
        begin(log, &json, "body");
        sb_json_text(&json, "body", model->bodies[b].name);
        sb_trust_put(&json, &model->bodies[b], &bodies[b]);
        end(log, &json);
    }
}

void sb_runlog_end(sb_runlog *log, sb_status status, const char *reason)
{
    if (!log) return;
    sb_json json;
    begin(log, &json, "end");
    sb_json_text(&json, "status", status == SB_OK ? "done" : status == SB_INTERRUPTED ? "interrupted" : "failed");
    if (reason && *reason) sb_json_text(&json, "text", reason);
    end(log, &json);
}

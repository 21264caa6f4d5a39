/* Writes run.jsonl, the log of a run: one JSON object per line with "event" and "wall_s" (seconds since the log was
   opened). Any thread may write. Write errors are kept until sb_runlog_check. */
#ifndef SB_OUTPUT_RUNLOG_H
#define SB_OUTPUT_RUNLOG_H

#include "frame/records.h"
#include "frame/step_report.h"
#include "geometry/model/model.h"
#include "output/log/saved.h"
#include "scene/scene.h"

typedef struct sb_runlog sb_runlog;

/* All functions below accept a NULL log and then do nothing. */
sb_status sb_runlog_open(const char *path, sb_runlog **log, sb_error *error);

/* Continues an existing log, or creates one. An incomplete last line of a killed run is removed. */
sb_status sb_runlog_append(const char *path, sb_runlog **log, sb_error *error);

/* Writes all lines to disk. SB_FAILED on an error. */
sb_status sb_runlog_sync(sb_runlog *log, sb_error *error);

/* Whether the file was removed since it was opened. It is then created again if possible. True once per removal. */
bool sb_runlog_remade(sb_runlog *log);

/* SB_FAILED when a line could not be written. */
sb_status sb_runlog_check(sb_runlog *log, sb_error *error);

/* Closes and frees; a late write error is SB_FAILED. */
sb_status sb_runlog_close(sb_runlog *log, sb_error *error);

/* "start": version, scene, threads, particles, memory, numerics chosen, the model's warnings. */
void sb_runlog_start(sb_runlog *log, const sb_scene *scene, const sb_model *model, int threads, size_t bytes);

/* "arguments": the folder in which the program was started, and its arguments from the command's name on. */
void sb_runlog_arguments(sb_runlog *log, const char *folder, int count, char *const *arguments);

/* "skipped", one line for each entry of the list. */
void sb_runlog_skipped(sb_runlog *log, const sb_skipped *list);
/* "saved": the sum of these savings. */
void sb_runlog_saved(sb_runlog *log, const sb_saved *saved);

/* "warning" with a text. */
void sb_runlog_warning(sb_runlog *log, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Any other event with a text, e.g. "settled", "frame", "plot". */
void sb_runlog_event(sb_runlog *log, const char *event, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The periodic "step" line. */
typedef struct sb_runlog_state {
    const sb_step_report *report;
    const sb_energy *energy;     /* NULL: not written */
    const sb_stage_time *stages; /* seconds since the start */
    size_t stage_count;
    bool has_foam;
    bool has_hash;
    uint64_t hash; /* of the state */
} sb_runlog_state;
void sb_runlog_step(sb_runlog *log, const sb_runlog_state *state);

/* "body": whether the force on each reporting body is reliable (output/trust.h). */
void sb_runlog_bodies(sb_runlog *log, const sb_model *model, const sb_body_record *bodies);

/* "end": "done", "interrupted" or "failed" with the reason (may be NULL). */
void sb_runlog_end(sb_runlog *log, sb_status status, const char *reason);

#endif

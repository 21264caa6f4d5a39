/* run.jsonl: what happened in a run, one JSON object per line with "event" and "wall_s" (seconds
   since the log was opened). Any thread may write. Write errors are kept until asked for. */
#ifndef SB_OUTPUT_RUNLOG_H
#define SB_OUTPUT_RUNLOG_H

#include "geometry/model.h"
#include "measure/records.h"
#include "output/saved.h"
#include "scene/scene.h"
#include "sim/sim.h"

typedef struct sb_runlog sb_runlog;

/* Everything below takes a NULL log and then does nothing. */
sb_status sb_runlog_open(const char *path, sb_runlog **log, sb_error *error);

/* Goes on with a log that is there, or starts one; a line that a killed run left unfinished is dropped. */
sb_status sb_runlog_append(const char *path, sb_runlog **log, sb_error *error);

/* Puts what was written on disk. SB_FAILED when that cannot be done. */
sb_status sb_runlog_sync(sb_runlog *log, sb_error *error);

/* Whether the file was removed since it was opened; it is then made anew, where that can be done, and said so once. */
bool sb_runlog_remade(sb_runlog *log);

/* SB_FAILED when a line could not be written. */
sb_status sb_runlog_check(sb_runlog *log, sb_error *error);

/* Closes and frees; a late write error is SB_FAILED. */
sb_status sb_runlog_close(sb_runlog *log, sb_error *error);

/* "start": version, scene, threads, particles, memory, numerics chosen, the model's warnings. */
void sb_runlog_start(sb_runlog *log, const sb_scene *scene, const sb_model *model, int threads, size_t bytes);

/* "skipped", one line for each of the list. */
void sb_runlog_skipped(sb_runlog *log, const sb_skipped *list);
/* "saved": what all of that came to. */
void sb_runlog_saved(sb_runlog *log, const sb_saved *saved);

/* "warning" with a text. */
void sb_runlog_warning(sb_runlog *log, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Any other event with a text, e.g. "settled", "frame", "plot". */
void sb_runlog_event(sb_runlog *log, const char *event, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The periodic "step" line. */
typedef struct sb_runlog_state {
    const sb_step_report *report;
    const sb_energy *energy;     /* NULL: left out */
    const sb_stage_time *stages; /* seconds since the start */
    size_t stage_count;
    bool has_hash;
    uint64_t hash; /* of the state */
} sb_runlog_state;
void sb_runlog_step(sb_runlog *log, const sb_runlog_state *state);

/* "body": how many particles deep the flow at each reporting body's face was, and whether that
   is too coarse to trust. */
void sb_runlog_bodies(sb_runlog *log, const sb_model *model, const sb_body_record *bodies);

/* "end": "done", "interrupted" or "failed" with the reason (may be NULL). */
void sb_runlog_end(sb_runlog *log, sb_status status, const char *reason);

#endif

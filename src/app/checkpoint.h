/* Checkpoints of a run: DIR/checkpoints/<step>.state, and settling.state before the first of them, from which --resume
   goes on bit for bit (docs/checkpoints.md).
   Writing one reads the run only; nothing that it does can fail the run. */
#ifndef SB_APP_CHECKPOINT_H
#define SB_APP_CHECKPOINT_H

#include "app/build.h"
#include "base/file.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct run run; /* app/run_state.h */

typedef struct sb_checkpoints {
    bool on; /* the scene asks for them */
    char folder[SB_PATH_MAX];
    char *identity;            /* of the scene */
    uint64_t model;            /* hash of what was sampled */
    char build[SB_BUILD_TEXT]; /* of this program's numerics */
    bool any_build;            /* another build's will do as well */
    double written;            /* s on the clock, of the last attempt */
    uint64_t steps_then;       /* step of the last one */
    bool current;              /* there is one of steps_then */
    bool settling;             /* the last one written is of the water that comes to rest */
} sb_checkpoints;

/* Where they go, and whether the scene wants any. */
sb_status sb_checkpoint_begin(run *r, sb_error *error);

/* How many the directory holds. Fails when that cannot be told. */
sb_status sb_checkpoint_count(const run *r, size_t *count, sb_error *error);

/* Once scene and model are final: what they are told apart by. */
sb_status sb_checkpoint_identify(run *r, sb_error *error);

/* Whether one is due at this step: by steps, or by the wall clock, which decides when to look at the state and nothing
   else. */
bool sb_checkpoint_due(const run *r, uint64_t step);

/* Saves the state between two steps and removes the oldest but the last K; a failure is a warning, and those written
   before stay. Does nothing when they are off, or when this step has one. */
void sb_checkpoint_write(run *r);

/* The same while the water comes to rest, when there are no tables, frames or measurements yet. Goes with the first
   checkpoint of a step. */
void sb_checkpoint_write_settling(run *r);

/* Whether there is one of those. */
bool sb_checkpoint_settling_there(const run *r);

/* Loads it into a simulation just made. Statuses as sb_checkpoint_load. */
sb_status sb_checkpoint_load_settling(run *r, sb_error *error);

/* Loads the newest checkpoint that is whole and of this program, build, scene and model into the run's simulation,
   measurements and counters; says why others were refused. Touches no file. SB_BAD_INPUT when none can be used,
   SB_FAILED without memory, or when the newest cannot be read for the moment, as from a disk that errs: simulation and
   measurements are then worth nothing. */
sb_status sb_checkpoint_load(run *r, sb_error *error);

/* After a load: removes checkpoints of later steps, which were refused. */
void sb_checkpoint_forget_later(run *r);

void sb_checkpoint_end(run *r);

#endif

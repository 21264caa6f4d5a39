/* Checkpoints of a run: DIR/checkpoints/<step>.state, and settling.state during settling. --resume continues a run from
   its newest checkpoint with the same bits (docs/checkpoints.md).
   Writing a checkpoint does not change the run. A checkpoint that cannot be written does not fail the run. */
#ifndef SB_APP_CHECKPOINT_H
#define SB_APP_CHECKPOINT_H

#include "app/run/state.h"

/* Finds the folder, and whether the scene requests checkpoints. */
sb_status sb_checkpoint_begin(run *r, sb_error *error);

/* Counts the checkpoints in the run directory. Fails when the folder cannot be read. */
sb_status sb_checkpoint_count(const run *r, size_t *count, sb_error *error);

/* Computes what identifies the scene and the model. Call it once both are final. */
sb_status sb_checkpoint_identify(run *r, sb_error *error);

/* Whether a checkpoint is due at this step, by the number of steps or by the wall clock. The wall clock decides only
   when the state is read. */
bool sb_checkpoint_due(const run *r, uint64_t step);

/* Saves the state between two steps, then keeps the scene's number of newest checkpoints and removes older ones. A
   failure gives a warning and keeps the earlier checkpoints. Does nothing when checkpoints are off, or when this step
   has one already. */
void sb_checkpoint_write(run *r);

/* Saves the state during settling, when there are no tables, frames or measurements yet. The first checkpoint of a
   step removes this file. */
void sb_checkpoint_write_settling(run *r);

/* Whether the file of the settling exists. */
bool sb_checkpoint_settling_exists(const run *r);

/* Loads the file of the settling into a new simulation. Same statuses as sb_checkpoint_load. */
sb_status sb_checkpoint_load_settling(run *r, sb_error *error);

/* Loads the newest checkpoint that is undamaged and of this program, build, scene and model into the run's simulation,
   measurements and counters. Warns why newer ones were refused. Changes no file. SB_BAD_INPUT when no checkpoint can be
   used; SB_FAILED when memory runs out or the newest cannot be read for now, for example after a disk error. On
   failure, the contents of simulation and measurements are undefined. */
sb_status sb_checkpoint_load(run *r, sb_error *error);

/* Removes the checkpoints of later steps than the one loaded, which were refused. */
void sb_checkpoint_remove_later(run *r);

void sb_checkpoint_end(run *r);

#endif

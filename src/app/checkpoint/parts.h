/* Names and functions that checkpoint.c and checkpoint_load.c share. Private to src/app. */
#ifndef SB_APP_CHECKPOINT_PARTS_H
#define SB_APP_CHECKPOINT_PARTS_H

#include "app/checkpoint/names.h"
#include "app/run/state.h"

#define SB_CHECKPOINT_SCENE "scene"
#define SB_CHECKPOINT_RUN "run"

enum { SB_CHECKPOINT_FORMAT = 19 };

/* Lists the steps of the checkpoints in the folder, newest first; free with sb_free. A missing folder has none. */
sb_status sb_checkpoint_list(const run *r, uint64_t **steps, size_t *count, sb_error *error);

/* The path of the file of the settling. */
sb_status sb_checkpoint_settling_path(const run *r, char path[SB_PATH_MAX], sb_error *error);

/* The path of the checkpoint of a step. */
sb_status sb_checkpoint_path(const run *r, uint64_t step, char path[SB_PATH_MAX], sb_error *error);

#endif

/* What the two halves of checkpoints agree on. Inside src/app. */
#ifndef SB_APP_CHECKPOINT_PARTS_H
#define SB_APP_CHECKPOINT_PARTS_H

#include "app/run_state.h"

#define SB_CHECKPOINT_KIND "SBSTATE"
#define SB_CHECKPOINT_SUFFIX ".state"
#define SB_CHECKPOINT_SCENE "scene"
#define SB_CHECKPOINT_RUN "run"
#define SB_CHECKPOINT_SETTLING "settling"

enum { SB_CHECKPOINT_FORMAT = 10 };

/* Steps of the checkpoints in the folder, newest first; free with sb_free. A folder that is not there has none. */
sb_status sb_checkpoint_list(const run *r, uint64_t **steps, size_t *count, sb_error *error);

/* The file of the water before t = 0, while it comes to rest. */
sb_status sb_checkpoint_settling_path(const run *r, char path[SB_PATH_MAX], sb_error *error);

/* The file of a step. */
sb_status sb_checkpoint_path(const run *r, uint64_t step, char path[SB_PATH_MAX], sb_error *error);

#endif

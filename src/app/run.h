/* One run from scene to summary: wires simulation, measurements, files and consumers. No physics. */
#ifndef SB_APP_RUN_H
#define SB_APP_RUN_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>

/* What a run says on stdout. */
typedef struct sb_run_voice {
    bool quiet;   /* no progress */
    bool profile; /* the stage table at the end */
} sb_run_voice;

/* Runs the scene into the directory. SB_INTERRUPTED when a signal ended it, all files being complete;
   SB_FAILED with the reason otherwise, the last good state written. */
sb_status sb_run(const sb_scene *scene, const char *directory, const sb_run_voice *voice, sb_error *error);

#endif

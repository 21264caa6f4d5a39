/* One run from scene to summary: wires simulation, measurements, files and consumers. No physics. */
#ifndef SB_APP_RUN_H
#define SB_APP_RUN_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>

/* Runs the scene into the directory. SB_INTERRUPTED when a signal ended it, all files being complete;
   SB_FAILED with the reason otherwise, the last good state written. */
sb_status sb_run(const sb_scene *scene, const char *directory, bool quiet, sb_error *error);

#endif

/* One run from scene to summary: wires simulation, measurements, files and consumers. No physics. */
#ifndef SB_APP_RUN_H
#define SB_APP_RUN_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>

/* How a run begins, and what it says on stdout. */
typedef struct sb_run_manner {
    bool resume;      /* goes on from the directory's newest checkpoint; from the beginning where there is none */
    bool overwrite;   /* replaces the run that the directory holds; not together with resume */
    bool other_build; /* resumes from a checkpoint of another build, too, with a warning */
    bool quiet;       /* no progress */
    bool profile;     /* the stage table at the end */
    bool *left;       /* set when a thread that makes no progress is still there at the end: leave by _exit, and free
                         nothing that the run was given; NULL: nobody asks */
} sb_run_manner;

/* Runs the scene into the directory. SB_BAD_INPUT also when that holds a run which is neither resumed nor overwritten,
   or files and no run, or when there are checkpoints to resume from and none can be used: the directory's files are
   then as they were, but for the log. SB_INTERRUPTED when a signal ended it, all files being complete; SB_FAILED with
   the reason otherwise, the last good state written. */
sb_status sb_run(const sb_scene *scene, const char *directory, const sb_run_manner *manner, sb_error *error);

#endif

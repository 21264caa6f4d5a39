/* One run from scene to summary: connects simulation, measurements, files and consumers. Contains no physics. */
#ifndef SB_APP_RUN_H
#define SB_APP_RUN_H

#include "base/ranks.h"
#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>

/* How a run begins, and what it prints on stdout. */
typedef struct sb_run_options {
    bool resume;      /* continues from the directory's newest checkpoint; without one, starts from the beginning */
    bool overwrite;   /* replaces the run in the directory; cannot be combined with resume */
    bool other_build; /* accepts a checkpoint of another build, with a warning */
    bool quiet;       /* prints no progress */
    bool profile;     /* prints the times of the stages at the end */
    int live_port;    /* of the page for browsers; 0: none */
    const char *live_address; /* on which it is; empty: loopback */
    int argument_count;       /* of the command line, from the command's name on; for the log; 0: unknown */
    char *const *arguments;
    sb_ranks *ranks;      /* those that compute the run, of which this process is rank 0; NULL: it is alone */
    bool *thread_remains; /* set when a thread without progress still exists at the end: end the process by _exit, and
                   free nothing that the run was given; may be NULL */
} sb_run_options;

/* Runs the scene and writes its files into the directory. SB_BAD_INPUT also when the directory holds a run that is
   neither resumed nor overwritten, or holds files and no run, or when none of its checkpoints can be used. The
   directory's files are then unchanged, except for the log. SB_INTERRUPTED when a signal ended the run; all files are
   then complete. SB_FAILED with the reason otherwise; the last good state is then written. */
sb_status sb_run(const sb_scene *scene, const char *directory, const sb_run_options *options, sb_error *error);

#endif

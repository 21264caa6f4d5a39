/* Runs trials as processes, some at a time, each within its patience. */
#ifndef SB_BATTERY_CREW_H
#define SB_BATTERY_CREW_H

#include "stress.h"

#include <stdint.h>

typedef struct sb_workbench {
    char out[SB_PATH_MAX];     /* absolute; OUT/runs/<case>/<trial>/ */
    char program[SB_PATH_MAX]; /* the shorebreak that runs */
    char assets[SB_PATH_MAX];  /* assets/stress */
    uint64_t build;            /* hash of it and of this program */
    char commit[64], machine[128];
} sb_workbench;

/* A trial that is wanted: its case, and where its outcome goes. */
typedef struct sb_job {
    const sb_stress *of;
    const sb_trial *trial;
} sb_job;

/* Makes the folder. SB_BAD_INPUT when program or assets are not there. */
sb_status sb_workbench_open(sb_workbench *bench, const char *out, const char *program, const char *own,
                            const char *source, sb_error *error);

/* Runs all that this build has not yet run, `jobs` at a time with one thread each; says on stdout how each ended. A
   trial that ends badly is an outcome like any other. SB_INTERRUPTED after SIGINT or SIGTERM. */
sb_status sb_crew_run(const sb_workbench *bench, const sb_job *work, size_t count, int jobs, sb_error *error);

/* What is kept of a trial: of this build, or of another where the scene and what is set are the same. */
sb_outcome sb_workbench_recall(const sb_workbench *bench, const sb_job *job);

#endif

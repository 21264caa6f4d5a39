/* A finished run with the data that sb_case_run points to. */
#ifndef SB_FRAMEWORK_RUN_H
#define SB_FRAMEWORK_RUN_H

#include "base/file.h"
#include "case.h"

typedef struct sb_finished {
    char folder[SB_PATH_MAX];
    char label[96];
    int threads;                   /* of the run's last process */
    char build[24];                /* hash of the program that ran */
    char commit[64], machine[128]; /* from the run's record */
    double cpu,
        load; /* processor time of all processes of the run, s; load of the machine at its end; NaN: not known */
    sb_scene scene;
    sb_sheet_slot slot;
    sb_curves made;
    sb_error error;
    sb_case_run view; /* points into this struct, which must not be copied */
} sb_finished;

/* Reads scene.yaml and summary.json of the folder; fills in the scene and the numbers of the view. */
sb_status sb_finished_read(sb_finished *run, const char *folder, sb_error *error);
void sb_finished_free(sb_finished *run);

#endif

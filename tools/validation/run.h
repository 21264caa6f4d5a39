/* A finished run as the framework holds it: what sb_case_run points to. */
#ifndef SB_VALIDATION_RUN_H
#define SB_VALIDATION_RUN_H

#include "base/file.h"
#include "case.h"

typedef struct sb_finished {
    char folder[SB_PATH_MAX];
    char label[96];
    int threads;                   /* of the run's last process */
    char build[24];                /* of the program that ran: tells programs apart where commits are alike or differ */
    char commit[64], machine[128]; /* of the run, from its record */
    double cpu, load; /* s of processor time, all processes of the run; the machine's load at its end; NaN: not known */
    sb_scene scene;
    sb_sheet_slot slot;
    sb_case_run view; /* points into this struct: copy no sb_finished */
} sb_finished;

/* Reads the folder's scene.yaml and summary.json; fills scene and the view's numbers. */
sb_status sb_finished_read(sb_finished *run, const char *folder, sb_error *error);
void sb_finished_free(sb_finished *run);

#endif

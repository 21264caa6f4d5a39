/* Makes requested runs, each as a process of the real program, and reads them with their figures. */
#ifndef SB_FRAMEWORK_RUNS_H
#define SB_FRAMEWORK_RUNS_H

#include "run.h"
#include "run_store.h"

#include <stdio.h>

typedef enum sb_result_state {
    SB_RESULT_NOT_RUN,
    SB_RESULT_FAILED, /* the run or reading its files failed; see problem */
    SB_RESULT_DONE    /* finished, or kept from an earlier report */
} sb_result_state;

typedef struct sb_result {
    sb_request request;     /* its case and plan belong to the caller; no case: nothing is requested */
    char request_hash[17];  /* in hexadecimal; "": not known */
    uint64_t defaults_hash; /* of the scene with every default of this program (request.h) */
    sb_result_state state;
    bool kept; /* the figures are those of an earlier report; files and scene are not available (validate/kept.h) */
    sb_finished run;
    sb_figures figures;
    char problem[640];
} sb_result;

/* Runs, in order, every request of which this build has no stored run. --jobs 1: one run at a time with all cores;
   more: that many runs at a time with one thread each. Prints on stdout each run and its run time. A run that was
   stopped continues from its checkpoint. A failed run is stored as failed and counted; the others continue.
   SB_INTERRUPTED after SIGINT or SIGTERM, which is passed on to the running processes. */
sb_status sb_runs_launch(sb_store *store, const sb_request *requests, size_t count, sb_error *error);

/* Reads the stored run of r->request and computes its figures. any_build: if this build has not run it, the newest run
   of another build is read. */
void sb_result_read(sb_store *store, bool any_build, sb_result *r);
void sb_results_free(sb_result *results, size_t count);

/* Makes the runs that are not stored (unless --report-only is given) and reads all that are. Runs are in order, but
   grouped by start seed (1, 2, ...), so that a temporarily slower machine affects all choices alike. With
   --report-only, runs of other builds count, too. */
sb_status sb_runs_make(sb_store *store, sb_result *results, size_t count, sb_error *error);

/* Writes machines, commits and load in Markdown; names the runs with provisional times. */
void sb_runs_where(FILE *out, const sb_store *store, const sb_result *results, size_t count);
/* The same after a line with the command. */
void sb_runs_origin(FILE *out, const sb_store *store, const sb_result *results, size_t count);
/* If there are no figures, writes a list item with the reason and returns true. */
bool sb_runs_problem(FILE *out, const sb_result *result);

/* Settings that switch off pictures, stream and particle files, ended by NULL. */
extern const char *const sb_plain_settings[];
enum { SB_PLAIN_SETTINGS = 3 };

#endif

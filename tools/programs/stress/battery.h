/* The trials of a case with their outcomes, and the report of tools/stress. */
#ifndef SB_STRESS_BATTERY_H
#define SB_STRESS_BATTERY_H

#include "trial_store.h"

/* Runs all trials that this build has not run, --jobs at a time with one thread each. Prints on stdout how each ended.
   A trial that fails is an outcome, not an error. SB_INTERRUPTED after SIGINT or SIGTERM. */
sb_status sb_trials_run(const sb_store *store, const sb_job *work, size_t count, sb_error *error);

/* A case with its judged trials. */
typedef struct sb_stress_results {
    const sb_stress *of;
    sb_trials trials;
    sb_judged *judged;  /* one per trial */
    size_t run, failed; /* numbers of trials */
} sb_stress_results;

/* Reads the stored trials of a case and judges them. */
sb_status sb_stress_collect(sb_store *store, const sb_stress *of, sb_stress_results *results, sb_error *error);
void sb_stress_results_free(sb_stress_results *results);

typedef struct sb_stability {
    const sb_store *store;
    const sb_stress_results *cases;
    size_t count;
} sb_stability;

/* Writes stability.md. */
sb_status sb_stability_write(const sb_stability *stability, sb_error *error);

#endif

/* Command line and report of tools/stress. */
#ifndef SB_BATTERY_BATTERY_H
#define SB_BATTERY_BATTERY_H

#include "runner.h"

enum { SB_STRESSES_MAX = 64 };

typedef struct sb_battery_options {
    const char *out, *report, *program; /* NULL: not given */
    bool all, quick, list, report_only, help;
    int jobs;
    const sb_stress *cases[SB_STRESSES_MAX];
    size_t count;
    char command[1024]; /* as it can be repeated on any machine: without folders */
} sb_battery_options;

extern const char sb_battery_help[];

/* SB_BAD_INPUT: the error names the argument. Options point into the arguments. */
sb_status sb_battery_parse(int count, char **arguments, sb_battery_options *options, sb_error *error);

/* A case with its judged trials. */
typedef struct sb_stress_results {
    const sb_stress *of;
    sb_trials trials;
    sb_judged *judged;  /* one per trial */
    size_t run, failed; /* numbers of trials */
} sb_stress_results;

/* Reads the stored trials of a case and judges them. */
sb_status sb_stress_collect(const sb_trial_store *store, const sb_stress *of, bool quick, sb_stress_results *results,
                            sb_error *error);
void sb_stress_results_free(sb_stress_results *results);

/* Writes folder/stability.md, whole or not at all. */
sb_status sb_stability_write(const sb_trial_store *store, const sb_stress_results *cases, size_t count, bool quick,
                             const char *command, const char *folder, sb_error *error);

#endif

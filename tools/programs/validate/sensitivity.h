/* Effect of a change of every numeric default by 25 % on the figures of the cases. */
#ifndef SB_VALIDATE_SENSITIVITY_H
#define SB_VALIDATE_SENSITIVITY_H

#include "runs.h"

/* A numeric default. Its value is read from the scene of a run. */
typedef struct sb_sensitivity_key {
    const char *key; /* in `numerics` */
    size_t offset;   /* in sb_numerics: of a double, or of an int if whole */
    bool whole;
    double most; /* upper bound of the scene key; HUGE_VAL: none */
} sb_sensitivity_key;

/* Ended by a row without a key. */
extern const sb_sensitivity_key sb_sensitivity_keys[];

/* Writes `numerics.KEY=VALUE` for the default times factor, limited by the key's bound. "": nothing changes, as for a
   default of 0. */
void sb_sensitivity_change(const sb_sensitivity_key *key, const sb_numerics *defaults, double factor, char change[64]);

/* The default as text. */
void sb_sensitivity_text(const sb_sensitivity_key *key, const sb_numerics *defaults, char text[64]);

enum { SB_SENSITIVITY_PAIR = 2 };

/* The runs with the defaults, one per case, and then the changed runs, case by case in pairs: the other start seeds,
   and each key decreased and increased. A change that changes nothing has no case. */
typedef struct sb_sensitivity_study {
    const sb_store *store;
    size_t count; /* of cases */
    sb_result *runs;
} sb_sensitivity_study;

/* Number of pairs of a case: one of seeds, then one per key. */
size_t sb_sensitivity_rows(void);
/* The pair of a row. */
sb_result *sb_sensitivity_pair(const sb_sensitivity_study *study, size_t of, size_t row);

/* Runs the judged quick forms of the cases with the defaults and with each change (unless --report-only is given), and
   writes sensitivity.md. Statuses as of sb_runs_launch. */
sb_status sb_sensitivity(sb_store *store, const sb_selection *cases, sb_error *error);

/* Writes the report, of a sb_sensitivity_study. */
void sb_sensitivity_report(FILE *out, const void *study);

#endif

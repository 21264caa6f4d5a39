/* Effect of a change of every numeric default by 25 % on the figures of the cases. */
#ifndef SB_VALIDATION_SENSITIVITY_H
#define SB_VALIDATION_SENSITIVITY_H

#include "results.h"

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

/* Runs the judged quick forms of the cases with the defaults and with each change (unless report_only), and writes
   `path` (Markdown). Statuses as of sb_launch. */
sb_status sb_sensitivity(const sb_store *store, const sb_case *const *cases, size_t count, int jobs, bool report_only,
                         const char *command, const char *path, size_t *failed, sb_error *error);

#endif

/* What a quarter more or less of every numeric default does to the cases. */
#ifndef SB_VALIDATION_SENSITIVITY_H
#define SB_VALIDATION_SENSITIVITY_H

#include "results.h"

/* A numeric default. Its value is read from a run's own scene, never written down here. */
typedef struct sb_sensitivity_key {
    const char *key; /* in `numerics` */
    size_t offset;   /* in sb_numerics: a double, or an int when whole */
    bool whole;
    double most; /* upper bound of the scene key; HUGE_VAL: none */
} sb_sensitivity_key;

/* Ended by a row without key. */
extern const sb_sensitivity_key sb_sensitivity_keys[];

/* Text of `numerics.KEY=VALUE` for the default times factor, kept within the key's bound. "": the
   default is 0 or the change would be none, so that it has no meaning. */
void sb_sensitivity_change(const sb_sensitivity_key *key, const sb_numerics *defaults, double factor, char change[64]);

/* The default as text. */
void sb_sensitivity_text(const sb_sensitivity_key *key, const sb_numerics *defaults, char text[64]);

/* Runs the judged quick form of the cases with their defaults and with each change (unless
   report_only), and writes `path` (Markdown). Statuses as sb_launch. */
sb_status sb_sensitivity(const sb_store *store, const sb_case *const *cases, size_t count, int jobs, bool report_only,
                         const char *command, const char *path, size_t *failed, sb_error *error);

#endif

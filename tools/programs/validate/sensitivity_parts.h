/* Declarations shared by the sensitivity study and its report. */
#ifndef SB_VALIDATION_SENSITIVITY_PARTS_H
#define SB_VALIDATION_SENSITIVITY_PARTS_H

#include "sensitivity.h"

#include <stdio.h>

enum { SB_SENSITIVITY_PAIR = 2 };

/* Runs of one case: [0] with the defaults, then pairs: the other start seeds, and each key decreased and increased.
   A request of a change that changes nothing has no case. */
typedef struct sb_sensitivity_study {
    size_t count;
    sb_result *results;
} sb_sensitivity_study;

/* Number of pairs: one of seeds, then one per key. */
size_t sb_sensitivity_rows(void);

/* Writes the report in Markdown. command: as typed. */
void sb_sensitivity_report(FILE *out, const sb_store *store, const sb_sensitivity_study *studies,
                           const sb_case *const *cases, size_t count, const char *command);

#endif

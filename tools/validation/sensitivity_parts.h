/* What the sensitivity study and its report share. */
#ifndef SB_VALIDATION_SENSITIVITY_PARTS_H
#define SB_VALIDATION_SENSITIVITY_PARTS_H

#include "sensitivity.h"

#include <stdio.h>

enum { SB_SENSITIVITY_PAIR = 2 };

/* Of one case: [0] as it is; then rows of two: other start seeds, and each key less and more. A request without
   meaning has no case. */
typedef struct sb_sensitivity_study {
    size_t count;
    sb_result *results;
} sb_sensitivity_study;

/* The rows of two: one of seeds, then one per key. */
size_t sb_sensitivity_rows(void);

/* The whole report, in Markdown. command: as it was typed. */
void sb_sensitivity_report(FILE *out, const sb_store *store, const sb_sensitivity_study *studies,
                           const sb_case *const *cases, size_t count, const char *command);

#endif

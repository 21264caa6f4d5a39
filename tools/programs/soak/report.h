/* Writes the results of a soak as tables. */
#ifndef SB_SOAK_REPORT_H
#define SB_SOAK_REPORT_H

#include "lives.h"
#include "options.h"
#include "store.h"

typedef struct sb_soak_report {
    const sb_soak_options *options;
    const sb_store *store;
    const sb_soak_life *lives;
    size_t count;
    double seconds;  /* total run time */
    size_t failed;   /* lives that did not pass */
    size_t judged;   /* lives whose growth is judged */
    uint64_t frames; /* that the subscriber received completely */
} sb_soak_report;

/* Write soak.md and samples.csv, all samples, of a sb_soak_report. */
void sb_soak_put(FILE *out, const void *report);
void sb_soak_put_samples(FILE *out, const void *report);

#endif

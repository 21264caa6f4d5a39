/* Writes the results of a soak as tables. */
#ifndef SB_SOAKING_REPORT_H
#define SB_SOAKING_REPORT_H

#include "lives.h"
#include "options.h"

typedef struct sb_soak_report {
    const sb_soak_options *options;
    const char *commit; /* of the source at the beginning */
    const sb_soak_life *lives;
    size_t count;
    double seconds;  /* total run time */
    size_t failed;   /* lives that did not pass */
    size_t judged;   /* lives whose growth is judged */
    uint64_t frames; /* that the subscriber received completely */
} sb_soak_report;

/* Writes folder/soak.md, whole or not at all. */
sb_status sb_soak_report_write(const sb_soak_report *report, const char *folder, sb_error *error);
/* Writes folder/samples.csv: all samples. */
sb_status sb_soak_samples_write(const sb_soak_report *report, const char *folder, sb_error *error);

#endif

/* What came of a soak, as tables. */
#ifndef SB_SOAKING_REPORT_H
#define SB_SOAKING_REPORT_H

#include "lives.h"
#include "options.h"

typedef struct sb_soak_report {
    const sb_soak_options *options;
    const char *commit; /* of the source when the soak began */
    const sb_soak_life *lives;
    size_t count;
    double seconds;  /* of wall time, all together */
    size_t unwell;   /* lives that are not as they should be */
    size_t judged;   /* lives long enough to be judged for growth */
    uint64_t frames; /* that the subscriber got whole */
} sb_soak_report;

/* Writes folder/soak.md, whole or not at all. */
sb_status sb_soak_report_write(const sb_soak_report *report, const char *folder, sb_error *error);
/* Writes folder/samples.csv: all that was seen. */
sb_status sb_soak_samples_write(const sb_soak_report *report, const char *folder, sb_error *error);

#endif

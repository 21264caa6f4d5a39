/* Writes run time and error of the choices as Markdown, CSV and picture. */
#ifndef SB_TRADEOFF_CONTEST_REPORT_H
#define SB_TRADEOFF_CONTEST_REPORT_H

#include "entries.h"

typedef struct sb_contest_report {
    const sb_store *store;
    const sb_contest *contests;
    size_t count;
} sb_contest_report;

/* Whether times are processor times, because runs share the machine. */
bool sb_contest_cpu(const sb_store *store);

/* Writes tradeoff.md, tradeoff.csv and tradeoff.png into the report folder, each whole or not at all. Without gnuplot
   the report says so in place of the picture. */
sb_status sb_contest_write(const sb_contest_report *report, sb_error *error);

#endif

/* Writes run time and error of the choices as Markdown, CSV and picture. */
#ifndef SB_CHOICES_CONTEST_REPORT_H
#define SB_CHOICES_CONTEST_REPORT_H

#include "entries.h"

typedef struct sb_contest_report {
    const sb_store *store;
    const sb_contest *contests;
    size_t count;
    const char *command;
    bool quick, cpu;    /* cpu: times are processor times */
    const char *folder; /* filled in by sb_contest_write */
} sb_contest_report;

/* Writes folder/tradeoff.md, tradeoff.csv and tradeoff.png, each whole or not at all. Without gnuplot the report says
   so in place of the picture. */
sb_status sb_contest_write(sb_contest_report *report, const char *folder, sb_error *error);

#endif

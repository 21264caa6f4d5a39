/* The published runs on our plant, and the report that compares the figures. */
#ifndef SB_PAPER_STUDIES_STUDIES_H
#define SB_PAPER_STUDIES_STUDIES_H

#include "cost.h"
#include "published.h"
#include "runs.h"

enum { SB_PAPER_TRIALS = 24, SB_PAPER_SETTINGS = 8, SB_PAPER_TEXT = 64 };

/* One run of ours. */
typedef struct sb_paper_trial {
    int number;     /* of the published run to compare with */
    bool paper;     /* preset `paper` */
    bool few;       /* only some steps */
    double spacing; /* m, scaled */
    sb_plan plan;
    char texts[4][SB_PAPER_TEXT];
    const char *settings[SB_PAPER_SETTINGS];
    sb_cost cost; /* if its trial is done */
} sb_paper_trial;

typedef struct sb_paper_studies {
    const sb_store *store;
    double scale; /* factor of all spacings; 1: as published */
    size_t count;
    sb_paper_trial rows[SB_PAPER_TRIALS];
    sb_result trials[SB_PAPER_TRIALS]; /* of each row */
} sb_paper_studies;

/* Prepares the runs; at 1 m only 20 steps. The struct must not move afterwards. */
void sb_paper_begin(sb_paper_studies *studies, const sb_store *store, double scale);
/* Reads the costs of the finished trials. */
sb_status sb_paper_costs(sb_paper_studies *studies, sb_error *error);

/* The row of a published number; NULL: none, or not done. */
const sb_paper_trial *sb_paper_row(const sb_paper_studies *studies, int number, bool paper);

/* Writes paper-studies.md and paper-studies.csv, each whole or not at all. */
sb_status sb_paper_write(const sb_paper_studies *studies, sb_error *error);

#endif

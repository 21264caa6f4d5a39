/* Outcome of a trial. */
#ifndef SB_STRESS_OUTCOME_H
#define SB_STRESS_OUTCOME_H

#include "base/file.h"
#include "curve.h"
#include "trial.h"

typedef struct sb_outcome {
    bool there;          /* the trial was run */
    unsigned how;        /* one SB_ENDS_ bit; 0: it crashed or hung */
    char ended[64];      /* the same as text: "exit status 0", "signal 11", "hung" */
    char last_line[400]; /* last line of its output */
    char commit[64];     /* of the program's source */
    double wall;         /* s */
    char folder[SB_PATH_MAX];
    char *summary;         /* text of summary.json; NULL: none */
    char not_a_number[96]; /* first table with NaN or inf, and its line; "": none */
} sb_outcome;

/* The first number of that key in summary.json; NaN: none. */
double sb_outcome_number(const sb_outcome *outcome, const char *key);
/* The number of that key within the object (or named item of a list) that begins at `within`. */
double sb_outcome_number_in(const sb_outcome *outcome, const char *within, const char *key);
/* A vector of a body in summary.json; NaNs: none. */
sb_vec3 sb_outcome_vector(const sb_outcome *outcome, const char *body, const char *key);
/* A curve of one of the run's tables, as sb_sheet_curve. */
sb_status sb_outcome_curve(const sb_outcome *outcome, const char *table, const char *where, const char *x,
                           const char *y, sb_curve *curve, sb_error *error);

/* Reads summary.json and the tables of outcome->folder. */
void sb_outcome_read(sb_outcome *outcome);
void sb_outcome_free(sb_outcome *outcome);

#endif

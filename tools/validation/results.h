/* What came of a case's runs: figures of each, and what they say where the reach is judged. */
#ifndef SB_VALIDATION_RESULTS_H
#define SB_VALIDATION_RESULTS_H

#include "run.h"
#include "store.h"

typedef enum sb_result_state {
    SB_RESULT_NOT_RUN,
    SB_RESULT_FAILED, /* the run, or reading what it left: see problem */
    SB_RESULT_DONE    /* or kept */
} sb_result_state;

typedef struct sb_result {
    sb_request request;
    char asked[17]; /* what it asks for, in hexadecimal; "": not known */
    uint64_t meant; /* and that with every default of this program (request.h) */
    sb_result_state state;
    bool kept; /* figures of a former report: its files are not there, nor the scene (kept.h) */
    sb_finished run;
    sb_figures figures;
    char problem[640];
} sb_result;

/* Runs in the order they are asked: the default preset coarse to fine with seed 1, paper, other
 * seeds. */
typedef struct sb_case_results {
    const sb_case *of;
    size_t count;
    sb_result *runs;
    sb_figures across;  /* of several runs together */
    bool across_builds; /* and these are not of one program */
    char problem[640];  /* what kept those from being figured; "" */
} sb_case_results;

/* A figure where it is judged, over the seeds that were run by the first one's program: those of others say something
   else. */
typedef struct sb_judgement {
    const sb_figure *figure; /* of the first seed */
    double mean;             /* of the value */
    double worst;            /* the error largest in magnitude */
    size_t seeds;
    bool pass; /* of every seed */
} sb_judgement;

/* How far the start decides: a figure over the seeds that one program ran at one spacing. */
typedef struct sb_seed_spread {
    double value;      /* largest minus smallest; NaN: nowhere more than one seed that all have it */
    double resolution; /* m, there */
} sb_seed_spread;

/* The runs a case wants; free *requests with sb_free. */
sb_status sb_case_requests(const sb_case *of, bool quick, sb_request **requests, size_t *count, sb_error *error);

/* Reads what the store has for r->request, and makes its figures. any_build: the newest of another
   build where this one has not run. */
void sb_result_read(const sb_store *store, bool any_build, sb_result *r);

/* All runs of a case: what the store has for them, or else the table of a former report, with their figures. SB_FAILED
   only without memory. */
sb_status sb_results_collect(const sb_store *store, const sb_case *of, bool quick, bool any_build,
                             const struct sb_sheet *former, sb_case_results *results, sb_error *error);
void sb_results_free(sb_case_results *results);

/* The judged run with seed 1; NULL when it is not done. */
const sb_result *sb_results_judged(const sb_case_results *results);
/* The finest run of the default preset with seed 1; NULL when none is done. */
const sb_result *sb_results_finest(const sb_case_results *results);
/* The i-th figure of that run over its seeds. */
sb_judgement sb_results_judge(const sb_case_results *results, size_t i);
/* Of the figure of that name: where it is judged, or else at the finest spacing that has several seeds. */
sb_seed_spread sb_results_spread(const sb_case_results *results, const char *quantity);
/* Figures with a limit, those of several runs included, and how many of them pass. */
void sb_results_count(const sb_case_results *results, size_t *limited, size_t *passed);

#endif

/* Results of a case: the figures of its runs, and their judgement at the judged spacing. */
#ifndef SB_VALIDATE_RESULTS_H
#define SB_VALIDATE_RESULTS_H

#include "runs.h"

/* Runs in the order of their requests: the default preset from coarse to fine with seed 1, `paper`, `wen`, other seeds.
 */
typedef struct sb_case_results {
    const sb_case *of;
    size_t count;
    sb_result *runs;
    sb_figures across;  /* figures derived from several runs */
    bool across_builds; /* those runs were made by several programs */
    char problem[640];  /* why `across` could not be computed; "": no problem */
} sb_case_results;

/* A figure at the judged spacing, over the seeds that the program of the first seed ran. */
typedef struct sb_judgement {
    const sb_figure *figure; /* of the first seed */
    double mean;             /* of the value */
    double worst;            /* the error largest in magnitude */
    size_t seeds;
    bool pass; /* of every seed */
} sb_judgement;

/* Scatter of a figure over the seeds that one program ran at one spacing. */
typedef struct sb_seed_spread {
    double value;      /* largest minus smallest; NaN: no spacing has several seeds with this figure */
    double resolution; /* m, spacing of these seeds */
} sb_seed_spread;

/* The runs of a case. Free *requests with sb_free. */
sb_status sb_case_requests(const sb_case *of, bool quick, sb_request **requests, size_t *count, sb_error *error);

/* Reads all runs of a case with their figures from the store, or else from the table of an earlier report. SB_FAILED:
   out of memory. */
sb_status sb_results_collect(sb_store *store, const sb_case *of, const struct sb_sheet *former,
                             sb_case_results *results, sb_error *error);
void sb_case_results_free(sb_case_results *results);

/* The judged run with seed 1; NULL: not done. */
const sb_result *sb_results_judged(const sb_case_results *results);
/* The finest run of the default preset with seed 1; of a variant, such as the wave without the cylinder, only if the
   case itself has none. NULL: none is done. */
const sb_result *sb_results_finest(const sb_case_results *results);
/* Judges the i-th figure of the judged run over its seeds. */
sb_judgement sb_results_judge(const sb_case_results *results, size_t i);
/* Spread of the named figure at the judged spacing, or else at the finest spacing with several seeds. */
sb_seed_spread sb_results_spread(const sb_case_results *results, const char *quantity);
/* Whether the judged run is there, but no figure that compares it with the other runs: their files are missing. */
bool sb_results_incomplete(const sb_case_results *results);
/* Counts the figures with a target, including those of several runs, and those within their targets. */
void sb_results_count(const sb_case_results *results, size_t *limited, size_t *passed);

#endif

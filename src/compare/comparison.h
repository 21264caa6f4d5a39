/* The runs of a comparison: read, checked, and grouped by scene. Private to src/compare. */
#ifndef SB_COMPARE_COMPARISON_H
#define SB_COMPARE_COMPARISON_H

#include "compare/scene_values.h"
#include "report/loads.h"
#include "report/run.h"

enum { SB_COMPARE_RUNS_MAX = 64, SB_LABEL_MAX = 128 };

typedef struct sb_compared_run {
    char label[SB_LABEL_MAX]; /* the folder's name; all folders as given if two have one name */
    char path[SB_PATH_MAX];   /* the folder without symbolic links */
    sb_report_run run;        /* without its scene if files of bodies are gone */
    sb_loads loads;
    sb_scene_values values;
    size_t group;
} sb_compared_run;

/* Runs of one scene that differ only in numerics.seed. */
typedef struct sb_compared_group {
    size_t first, count; /* the first of its runs, and their number */
    char label[SB_LABEL_MAX + 32];
} sb_compared_group;

typedef struct sb_comparison {
    size_t count;
    sb_compared_run *runs; /* as given */
    size_t groups;
    sb_compared_group group[SB_COMPARE_RUNS_MAX]; /* by their first runs; the others are compared with group 0 */
    bool flat;                                    /* forces are per metre of width */
    sb_texts warnings;                            /* what limits the comparison, one sentence each */
} sb_comparison;

/* Reads the runs. SB_BAD_INPUT says in one line why they cannot be compared: no folder of a run, not finished, other
   dimensions, other ground, no body, gauge, line or plane in common. The directories' texts must outlive it. */
sb_status sb_comparison_read(const char *const *directories, size_t count, sb_comparison *comparison, sb_error *error);
void sb_comparison_free(sb_comparison *comparison);

#endif

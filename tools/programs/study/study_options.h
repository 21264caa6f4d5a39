/* Command line of tools/study. */
#ifndef SB_STUDY_STUDY_OPTIONS_H
#define SB_STUDY_STUDY_OPTIONS_H

#include "arguments.h"

enum { SB_STUDY_LEVELS = 12, SB_STUDY_SETS = 24, SB_STUDY_PATTERNS = 16, SB_STUDY_SEEDS = 32 };

typedef struct sb_study_options {
    sb_common_options common;
    const char *scene;
    double spacings[SB_STUDY_LEVELS]; /* m, coarse to fine */
    size_t spacing_count;
    const char *sets[SB_STUDY_SETS]; /* KEY=VALUE */
    size_t set_count;
    const char *patterns[SB_STUDY_PATTERNS]; /* of quantities; none selects all */
    size_t pattern_count;
    int seeds;
    const char *preset; /* NULL: the scene's own */
    bool paper;
} sb_study_options;

/* SB_BAD_INPUT: the error names the argument. Options point into the arguments. */
sb_status sb_study_parse(int count, char **arguments, sb_study_options *options, sb_error *error);

/* Whether a quantity is selected. Without patterns all are. A pattern is a part of the name or, with * and ?, the whole
   name. */
bool sb_study_selects(const sb_study_options *options, const char *quantity);

#endif

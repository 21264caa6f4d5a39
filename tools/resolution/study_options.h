/* The command line of a resolution study. */
#ifndef SB_STUDY_OPTIONS_H
#define SB_STUDY_OPTIONS_H

#include "request.h"

enum { SB_STUDY_LEVELS = 12, SB_STUDY_SETS = 24, SB_STUDY_PATTERNS = 16, SB_STUDY_SEEDS = 32 };

typedef struct sb_study_options {
    const char *scene, *out, *program;
    double spacings[SB_STUDY_LEVELS]; /* m, coarse to fine */
    size_t spacing_count;
    const char *sets[SB_STUDY_SETS]; /* KEY=VALUE */
    size_t set_count;
    const char *patterns[SB_STUDY_PATTERNS]; /* of quantities; none: all */
    size_t pattern_count;
    int seeds, jobs;
    const char *preset; /* NULL: the scene's own */
    bool paper, report_only, help;
    char command[1024]; /* as it may be repeated anywhere: without folders of this machine */
} sb_study_options;

extern const char sb_study_help[];

/* SB_BAD_INPUT says what is wrong with which argument. Options point into the arguments. */
sb_status sb_study_parse(int count, char **arguments, sb_study_options *options, sb_error *error);

/* Whether a quantity is asked for: all are without patterns; a pattern is a part of the name or, with
 * and ?, the whole of it. */
bool sb_study_wants(const sb_study_options *options, const char *quantity);

#endif

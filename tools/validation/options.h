/* The command line of the validation. */
#ifndef SB_VALIDATION_OPTIONS_H
#define SB_VALIDATION_OPTIONS_H

#include "case.h"

enum { SB_CASES_MAX = 64 };

typedef struct sb_validate_options {
    const char *out, *report, *program; /* NULL: not given */
    bool all, quick, list, report_only, sensitivity, once, help;
    int jobs, spacings; /* spacings: 0 for all */
    double spacing;     /* m, this one alone; 0: all */
    const sb_case *cases[SB_CASES_MAX];
    size_t count;
    char command[1024]; /* as it may be repeated anywhere: without folders */
} sb_validate_options;

extern const char sb_validate_help[];

/* SB_BAD_INPUT says what is wrong with which argument. Options point into the arguments. */
sb_status sb_validate_parse(int count, char **arguments, sb_validate_options *options, sb_error *error);

#endif

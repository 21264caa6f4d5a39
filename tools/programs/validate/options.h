/* Command line of tools/validate. */
#ifndef SB_VALIDATION_OPTIONS_H
#define SB_VALIDATION_OPTIONS_H

#include "case.h"

enum { SB_CASES_MAX = 64 };

typedef struct sb_validate_options {
    const char *out, *report, *program; /* NULL: not given */
    bool all, quick, list, report_only, sensitivity, once, help;
    int jobs, spacings; /* spacings: 0: all */
    double spacing;     /* m, only this one; 0: all */
    const sb_case *cases[SB_CASES_MAX];
    size_t count;
    char command[1024]; /* as it can be repeated on any machine: without folders */
} sb_validate_options;

extern const char sb_validate_help[];

/* SB_BAD_INPUT: the error names the argument. Options point into the arguments. */
sb_status sb_validate_parse(int count, char **arguments, sb_validate_options *options, sb_error *error);

#endif

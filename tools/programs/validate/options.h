/* Command line of tools/validate. */
#ifndef SB_VALIDATE_OPTIONS_H
#define SB_VALIDATE_OPTIONS_H

#include "arguments.h"

typedef struct sb_validate_options {
    sb_common_options common;
    bool sensitivity, once;
    int spacings;       /* only so many coarsest ones; 0: all */
    double spacing;     /* m, only this one; 0: all */
    sb_selection cases; /* rows of sb_cases */
} sb_validate_options;

/* SB_BAD_INPUT: the error names the argument. Options point into the arguments. */
sb_status sb_validate_parse(int count, char **arguments, sb_validate_options *options, sb_error *error);

#endif

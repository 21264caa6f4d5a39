/* Command line of tools/soak. */
#ifndef SB_SOAK_OPTIONS_H
#define SB_SOAK_OPTIONS_H

#include "arguments.h"

typedef struct sb_soak_options {
    sb_common_options common;
    double minutes;  /* run time of the soak */
    double life;     /* s of run time from the first frame until a process is stopped */
    double spacing;  /* m */
    double duration; /* simulated s after which the run has finished and a new one is started */
} sb_soak_options;

/* SB_BAD_INPUT: the error names the argument. Options point into the arguments. */
sb_status sb_soak_options_parse(int count, char **arguments, sb_soak_options *options, sb_error *error);

#endif

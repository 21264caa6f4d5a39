/* The command line of the soak. */
#ifndef SB_SOAKING_OPTIONS_H
#define SB_SOAKING_OPTIONS_H

#include "base/status.h"

#include <stdbool.h>

typedef struct sb_soak_options {
    double minutes;           /* of wall time, all lives together */
    double life;              /* s of wall time from its first frame until a run is stopped */
    double spacing;           /* m */
    double duration;          /* s simulated, after which the run is finished and begun anew */
    const char *out, *report; /* folders */
    bool help;
} sb_soak_options;

extern const char sb_soak_help[];

/* SB_BAD_INPUT says what is wrong with which argument. Options point into the arguments. */
sb_status sb_soak_options_parse(int count, char **arguments, sb_soak_options *options, sb_error *error);

#endif

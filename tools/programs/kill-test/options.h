/* Command line of tools/kill-test. */
#ifndef SB_KILLING_OPTIONS_H
#define SB_KILLING_OPTIONS_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct sb_kill_options {
    const char *scene; /* a scene file */
    const char *out;   /* folder of the runs' folders */
    int kills;
    uint64_t seed; /* of the random times */
    bool pictures; /* in every fourth round */
    bool help;
} sb_kill_options;

extern const char sb_kill_help[];

sb_status sb_kill_options_parse(int count, char **arguments, sb_kill_options *options, sb_error *error);

#endif

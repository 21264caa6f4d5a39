/* The monitor's command line. */
#ifndef SB_MONITOR_OPTIONS_H
#define SB_MONITOR_OPTIONS_H

#include <stdbool.h>

typedef struct sb_monitor_options {
    const char *url, *prefix; /* NULL: the default */
    double duration;          /* s, 0: until Ctrl-C */
    bool once, plain;
    bool help, version;
} sb_monitor_options;

/* False with a line in `trouble` on a bad command line. */
bool sb_monitor_options_read(int count, char **words, sb_monitor_options *options, char trouble[256]);

extern const char sb_monitor_help[];

#endif

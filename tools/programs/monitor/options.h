/* Reads the monitor's command line. */
#ifndef SB_MONITOR_OPTIONS_H
#define SB_MONITOR_OPTIONS_H

#include <stdbool.h>

typedef struct sb_monitor_options {
    const char *url, *prefix; /* NULL: the default */
    const char *run;          /* folder of the run, whose token allows commands; NULL: none */
    const char *token_file;   /* the token itself; NULL: none */
    double duration;          /* s, 0: until Ctrl-C */
    bool once, plain;
    bool help, version;
} sb_monitor_options;

/* Returns false, with a one-line message in `problem`, if the command line is wrong. */
bool sb_monitor_options_read(int count, char **arguments, sb_monitor_options *options, char problem[256]);

extern const char sb_monitor_help[];

#endif

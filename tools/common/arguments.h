/* The command lines of the tools: a table of options, read in one place. */
#ifndef SB_COMMON_ARGUMENTS_H
#define SB_COMMON_ARGUMENTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* What to do with a value, or with an argument that is no option. */
typedef sb_status sb_argument_taker(void *user, const char *value, sb_error *error);

/* One option. What it sets is the one of these five that is not NULL; all but a flag take a value. Texts point into the
   arguments. */
typedef struct sb_argument {
    const char *name; /* "--jobs" */
    bool *flag;
    const char **text;
    int *count;     /* from 1 to most */
    double *number; /* above 0, at most most */
    sb_argument_taker *take;
    double most;
    bool telling; /* belongs into the command as it may be repeated anywhere, as folders of this machine do not */
} sb_argument;

typedef struct sb_command_line {
    const sb_argument *options;
    size_t option_count;
    sb_argument_taker *word; /* for arguments without a dash; NULL: there are none */
    void *user;              /* for all takers */
    bool *help;              /* set by --help, after which nothing is read */
    char *command;           /* what tells is put behind this text; NULL: not wanted */
    size_t command_size;     /* bytes, the zero included */
} sb_command_line;

/* arguments[0] is the program. SB_BAD_INPUT says what is wrong with which argument. */
sb_status sb_command_line_read(const sb_command_line *line, int count, char **arguments, sb_error *error);

#endif

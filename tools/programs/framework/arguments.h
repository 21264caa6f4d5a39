/* Reads the command lines of the tools from a table of options. */
#ifndef SB_COMMON_ARGUMENTS_H
#define SB_COMMON_ARGUMENTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Handles a value, or an argument that is not an option. */
typedef sb_status sb_argument_taker(void *user, const char *value, sb_error *error);

/* One option. Exactly one of the five pointers is set: where the value goes. All options but flags take a value. Texts
   point into the arguments. */
typedef struct sb_argument {
    const char *name; /* "--jobs" */
    bool *flag;
    const char **text;
    int *count;     /* from 1 to most */
    double *number; /* above 0, at most most */
    sb_argument_taker *take;
    double most;
    bool repeated; /* part of `command`, which can be repeated on any machine; options with folders are not */
} sb_argument;

typedef struct sb_command_line {
    const sb_argument *options;
    size_t option_count;
    sb_argument_taker *operand; /* for arguments without a dash; NULL: none are allowed */
    void *user;                 /* passed to all takers */
    bool *help;                 /* set by --help, after which nothing more is read */
    char *command;              /* repeated options and operands are appended to this text; NULL: not needed */
    size_t command_size;        /* bytes, including the final zero */
} sb_command_line;

/* arguments[0] is the program. SB_BAD_INPUT: the error names the argument. */
sb_status sb_command_line_read(const sb_command_line *line, int count, char **arguments, sb_error *error);

#endif

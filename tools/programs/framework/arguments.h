/* The command line of the tools: a table of options, those that most tools have, rows of a table to select, and the
   end of main. */
#ifndef SB_FRAMEWORK_ARGUMENTS_H
#define SB_FRAMEWORK_ARGUMENTS_H

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

/* Options that several tools have. */
typedef struct sb_common_options {
    const char *out, *report, *program; /* folders of runs and of the report, path of shorebreak; NULL: not given */
    bool all, quick, list, report_only;
    int jobs;           /* 0: not given */
    bool answered;      /* --help, --version or --list was given and is answered: nothing else is to be done */
    char command[1024]; /* as it can be repeated on any machine: without folders */
} sb_common_options;

/* Bits: which of them a tool has. All tools have --help and --version. */
enum {
    SB_HAS_ALL = 1,
    SB_HAS_QUICK = 2,
    SB_HAS_LIST = 4,
    SB_HAS_REPORT_ONLY = 8, /* repeated in the command */
    SB_HAS_JOBS = 16,
    SB_HAS_OUT = 32,
    SB_HAS_REPORT = 64,
    SB_HAS_PROGRAM = 128
};

/* Rows of a table of at most SB_ROWS_MAX that are selected by their names, each once. */
enum { SB_ROWS_MAX = 64 };
typedef struct sb_selection {
    const char *what;                /* a row: "case" */
    const char *(*name)(size_t row); /* NULL after the last row */
    size_t count, rows[SB_ROWS_MAX];
} sb_selection;

typedef struct sb_command_line {
    const char *tool; /* "validate": the name of the script, the end of the program's name */
    const char *help;
    void (*list)(void); /* answers --list */
    unsigned has;       /* bits */
    const sb_argument *options;
    size_t option_count;
    sb_selection *selection;    /* takes the arguments without a dash */
    sb_argument_taker *operand; /* does so otherwise; both NULL: none are allowed */
    void *user;                 /* passed to all takers */
} sb_command_line;

/* Reads the arguments; [0] is the program. Answers --help, which ends the reading, --version and --list on stdout.
   SB_BAD_INPUT: the error names the argument. */
sb_status sb_command_line_read(const sb_command_line *line, int count, char **arguments, sb_common_options *common,
                               sb_error *error);

void sb_selection_all(sb_selection *selection);
/* SB_BAD_INPUT: no row is selected. */
sb_status sb_selection_check(const sb_selection *selection, sb_error *error);
bool sb_selection_has(const sb_selection *selection, size_t row);

/* What main returns: `result`, or 130 if the tool was stopped, or the status, whose error is printed. */
int sb_tool_end(const char *tool, sb_status status, int result, const sb_error *error);

#endif

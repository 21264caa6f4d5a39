/* Runs a program of tools/ as a user does, in a temporary folder. */
#ifndef SB_TESTS_TOOL_H
#define SB_TESTS_TOOL_H

#include <stdbool.h>

/* Makes the folder. Returns 0, or -1. */
int tool_begin(void);
/* Removes the folder and its contents. Returns 0, or -1. */
int tool_end(void);

/* Runs a built program with these arguments (shell syntax) and --out FOLDER/out. Its output goes to FOLDER/output.
   Returns its exit status, or -1 if a signal ended it. */
int tool_run(const char *program, const char *arguments);

/* Path of a file in the folder; valid until the next call. */
const char *tool_path(const char *name);
/* Text of a file in the folder; free with sb_free. NULL: no such file. */
char *tool_text(const char *name);
/* Whether a file in the folder contains this text. */
bool tool_contains(const char *name, const char *expected);

#endif

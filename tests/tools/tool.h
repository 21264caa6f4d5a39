/* A program of tools/, run as a user runs it, in a folder of its own. */
#ifndef SB_TESTS_TOOL_H
#define SB_TESTS_TOOL_H

#include <stdbool.h>

/* Makes the folder. 0, or -1. */
int tool_begin(void);
/* Removes the folder and what is in it. 0, or -1. */
int tool_end(void);

/* Runs a program that was built, with these arguments as a shell takes them and --out FOLDER/out; what it says goes to
   FOLDER/said. Its exit status; -1 when a signal ended it. */
int tool_run(const char *program, const char *arguments);

/* A name in the folder; valid until the next call. */
const char *tool_path(const char *name);
/* A file of the folder, whole; free with sb_free. NULL when there is none. */
char *tool_text(const char *name);
/* Whether a file of the folder holds these words. */
bool tool_says(const char *name, const char *words);

#endif

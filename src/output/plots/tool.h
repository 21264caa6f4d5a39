/* Runs another program (gnuplot, ffmpeg) without a shell. Private to src/output. */
#ifndef SB_OUTPUT_TOOL_H
#define SB_OUTPUT_TOOL_H

#include "base/file.h"

#include <stdbool.h>

/* Searches the program on PATH; false if it is not found. */
bool sb_tool_find(const char *name, char path[SB_PATH_MAX]);

/* Runs `path` with arguments (ended by NULL; [0] is its name) in `folder`, without output, in its own process group so
   that Ctrl-C does not stop it, and waits for its end. Five seconds after a request to stop (base/stop.h) it is killed.
   SB_FAILED names the program, its exit status or signal, and the last line of its output. */
sb_status sb_tool_run(const char *path, char *const *arguments, const char *folder, sb_error *error);

#endif

/* Runs another program (gnuplot, ffmpeg) without a shell. Inside src/output. */
#ifndef SB_OUTPUT_TOOL_H
#define SB_OUTPUT_TOOL_H

#include "base/file.h"

#include <stdbool.h>

/* Looks the program up on PATH; false when it is not there. */
bool sb_tool_find(const char *name, char path[SB_PATH_MAX]);

/* Runs `path` with arguments (ended by NULL, [0] being its name) in `folder`, silent, in a process
   group of its own so that Ctrl-C lets it finish, and waits: once a wish to stop is noted (base/stop.h) five seconds,
   then it is killed. SB_FAILED names the program, how it ended and the last line it said. */
sb_status sb_tool_run(const char *path, char *const *arguments, const char *folder, sb_error *error);

#endif

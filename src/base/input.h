/* Opening what a user names as an input: a regular file and nothing else. */
#ifndef SB_BASE_INPUT_H
#define SB_BASE_INPUT_H

#include "base/status.h"

#include <stdio.h>

/* A descriptor to read `path` from, closed on exec. Links are followed. A directory, FIFO, device or socket is
   refused without opening it, so that no input waits for a writer, and none is without an end. SB_BAD_INPUT names the
   path and the reason; *file is then -1, and errno the system's reason, or 0. */
sb_status sb_input_descriptor(const char *path, int *file, sb_error *error);

/* The same as a stream. */
sb_status sb_input_open(const char *path, FILE **stream, sb_error *error);

#endif

/* Opens an input that a user names, which must be a regular file. */
#ifndef SB_BASE_INPUT_H
#define SB_BASE_INPUT_H

#include "base/status.h"

#include <stdio.h>

/* Opens a descriptor to read `path`, which is closed on exec. Links are followed. A directory, FIFO, device or socket
   is refused without opening it, because a FIFO could block the program and a device may have no end. SB_BAD_INPUT
   names the path and the reason; *file is then -1, and errno is the system's reason, or 0. */
sb_status sb_input_descriptor(const char *path, int *file, sb_error *error);

/* The same as a stream. */
sb_status sb_input_open(const char *path, FILE **stream, sb_error *error);

#endif

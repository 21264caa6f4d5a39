/* Ctrl-C and SIGTERM as a wish: a run reads it between its steps, long work before the first step within its loops. */
#ifndef SB_BASE_STOP_H
#define SB_BASE_STOP_H

#include "base/status.h"

/* From now on the two signals are only noted; a second one of the same kind ends the process at once. */
void sb_stop_watch(void);

/* The signal noted, or 0. Never 0 again once it was not; any thread may ask, and it costs next to nothing. */
int sb_stop_signal(void);

/* SB_INTERRUPTED: "stopped by a signal" and during what. */
sb_status sb_stop_fail(sb_error *error, const char *during);

/* As in status.h. */
#ifdef __clang_analyzer__
#define sb_stop_fail(error, during) ((void)(sb_stop_fail)(error, during), SB_INTERRUPTED)
#endif

#endif

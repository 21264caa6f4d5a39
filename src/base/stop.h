/* Ctrl-C, SIGTERM and a closed terminal as a wish: a run reads it between its steps, long work before the first step
 * within its loops. */
#ifndef SB_BASE_STOP_H
#define SB_BASE_STOP_H

#include "base/status.h"

/* From now on SIGINT, SIGTERM and SIGHUP are only noted; a second one of the first two ends the process at once. SIGHUP
   stays ignored where it was, as by nohup. Writing to what nobody reads any more fails and does not end the process. */
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

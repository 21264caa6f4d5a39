/* Treats Ctrl-C, SIGTERM and a closed terminal as a request to stop. A run checks for the request between its steps,
   and long work before the first step checks within its loops. */
#ifndef SB_BASE_STOP_H
#define SB_BASE_STOP_H

#include "base/status.h"

#include <stdbool.h>

/* From now on SIGINT, SIGTERM and SIGHUP are only noted. A second SIGINT or SIGTERM ends the process at once. SIGHUP
   stays ignored if it was ignored before, as by nohup. Writing to a closed pipe fails and does not end the process. */
void sb_stop_watch(void);

/* The same for SIGUSR1, which mpirun passes on to the processes that it has started. */
void sb_stop_watch_forwarded(void);

/* For one of several processes that have to stop at the same step. While it is on, signals and requests wait, also
   those that were noted before: sb_stop_signal returns 0 until sb_stop_accept. off: what waits is noted. */
void sb_stop_defer(bool on);
/* The signal that waits, or 0. */
int sb_stop_waiting(void);
/* Notes this signal, which another process may have received; by_command: whether it is the request of a command. */
void sb_stop_accept(int number, bool by_command);
/* Whether what waits is the request of a command. */
bool sb_stop_by_command(void);

/* Notes SIGINT, as Ctrl-C would, for a command. */
void sb_stop_request(void);

/* Returns "signal" or "command". */
const char *sb_stop_cause(void);

/* Returns the noted signal, or 0. Once a signal is noted, the result stays nonzero until sb_stop_defer(true). Any
   thread may call this; it costs one atomic load. */
int sb_stop_signal(void);

/* Fails with SB_INTERRUPTED, "stopped by a signal" or "by a command", and what was interrupted. */
sb_status sb_stop_fail(sb_error *error, const char *during);

/* For clang's analyzer, as in status.h. */
#ifdef __clang_analyzer__
#define sb_stop_fail(error, during) ((void)(sb_stop_fail)(error, during), SB_INTERRUPTED)
#endif

#endif

/* Runs many processes, some at a time. */
#ifndef SB_FRAMEWORK_RUNNER_H
#define SB_FRAMEWORK_RUNNER_H

#include "process.h"

typedef struct sb_runner {
    void *user;
    int stop_signal; /* that all processes get when this program is to stop, or has failed */
    /* Whether work i is not needed; NULL: all is. */
    bool (*skip)(void *user, size_t i);
    /* Fills in the process of work i, which is then started. A process without arguments and work is not started. */
    sb_status (*begin)(void *user, size_t i, sb_process *process, sb_error *error);
    /* Judges how it ended; stopped: because this program is to stop. SB_INTERRUPTED stops all other work, too. */
    sb_status (*end)(void *user, size_t i, const sb_process *process, bool stopped, sb_error *error);
} sb_runner;

/* Does work 0 .. count - 1 in order, `jobs` processes at a time. After SIGINT or SIGTERM it ends all processes:
   SB_INTERRUPTED. */
sb_status sb_runner_run(const sb_runner *runner, size_t count, int jobs, sb_error *error);

#endif

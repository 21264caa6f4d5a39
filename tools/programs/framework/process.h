/* Child processes with limits: a program, or a function of this one, whose output goes to a file. */
#ifndef SB_FRAMEWORK_PROCESS_H
#define SB_FRAMEWORK_PROCESS_H

#include "base/file.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum { SB_PROCESS_ARGUMENTS = 128 };

/* Zero-initialise it, fill in the first part, start it, then poll or wait. */
typedef struct sb_process {
    const char *program; /* its path */
    const char *arguments[SB_PROCESS_ARGUMENTS];
    size_t argument_count;
    int (*work)(const void *context); /* runs in the child instead of the program; returns the exit status */
    void (*prepare)(void);            /* is called in the child before; NULL: nothing */
    const void *context;
    char output[SB_PATH_MAX]; /* is replaced by the output */
    int death_signal;         /* that the child gets if this process ends first */
    double stop_after;        /* s; SIGTERM is sent then; 0: never */
    double grace;             /* s after SIGTERM; SIGKILL is sent then; 0: never */
    double time_limit;        /* s; SIGKILL is sent then; 0: never */

    pid_t id;                /* 0: not started, or ended */
    double start, stop_time; /* stop_time: s from the start to SIGTERM */
    bool stop_sent, killed;  /* SIGTERM or SIGKILL was sent */
    int how;                 /* as from waitpid */
    double wall, cpu;        /* s, at the end */
} sb_process;

/* Adds arguments, ended by NULL. They must exist until the start. */
void sb_process_add(sb_process *process, ...) __attribute__((sentinel));
/* Adds the arguments of `shorebreak run SCENE --quiet --out OUT`. */
void sb_process_shorebreak(sb_process *process, const char *program, const char *scene, const char *out);
/* Adds --set KEY=VALUE for each setting. */
void sb_process_set(sb_process *process, const char *const *settings, size_t count);

/* Starts it without input. A program ends with status 127 if it cannot be executed; 126 if `output` cannot be opened.
   SB_FAILED: no process. */
sb_status sb_process_start(sb_process *process, sb_error *error);
/* Enforces the limits. True: it has ended. */
bool sb_process_poll(sb_process *process);
/* Sends SIGTERM, or SIGKILL, once. */
void sb_process_stop(sb_process *process, int signal);
/* Waits a moment, at most until the next limit. */
void sb_process_pause(const sb_process *process);
/* Polls until the end. If this program is to stop (base/stop.h), the process gets SIGTERM. */
void sb_process_wait(sb_process *process);

/* Exit status; -1: a signal ended it. */
int sb_process_status(const sb_process *process);
/* The last line of the output that is not a warning, or else the last line; `none`: there is none. */
void sb_process_last_line(const sb_process *process, const char *none, char *text, size_t size);
/* "status 2: shorebreak: no such file" or "signal 9: no output": how it ended, and that line. */
void sb_process_reason(const sb_process *process, const char *between, const char *none, char *text, size_t size);

/* Makes the folder and in it an empty log if there is none. This marks the folder as that of a run for `shorebreak
   run`, although it also contains files of this program. */
sb_status sb_process_claim(const char *folder, sb_error *error);
/* Removes the folder with all that is in it. SB_FAILED names the reason. */
sb_status sb_folder_remove(const char *folder, sb_error *error);

/* Path of the program `name` in the folder of this program; NULL: path of this program. */
sb_status sb_process_beside(const char *name, char path[SB_PATH_MAX], sb_error *error);

#endif

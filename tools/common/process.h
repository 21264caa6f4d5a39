/* Other programs as processes of their own, whose words go to a file. */
#ifndef SB_COMMON_PROCESS_H
#define SB_COMMON_PROCESS_H

#include "base/file.h"

#include <stddef.h>
#include <sys/types.h>

/* Starts a program (a path) with its arguments ([0] its name, NULL behind the last), without input, what it says going
   to the file `said`, begun anew. When this process ends before it, it gets `parting`, a signal. A program that cannot
   be executed ends with status 127, one whose file cannot be opened with 126. SB_FAILED: no process. */
sb_status sb_process_start(const char *program, const char *const *arguments, const char *said, int parting,
                           pid_t *process, sb_error *error);

/* Makes the folder, and in it an empty log where there is none: by that mark `shorebreak run` takes it for a run's own,
   though files of this program lie there, too. */
sb_status sb_process_claim(const char *folder, sb_error *error);

/* The path of the program `name` that lies beside the running one; the running one's own path with NULL. */
sb_status sb_process_beside(const char *name, char path[SB_PATH_MAX], sb_error *error);

/* "status 2", "signal 9": how a process ended, as waitpid tells it. */
void sb_process_describe(int how, char text[32]);

/* The last line in such a file that is not empty; `none` when there is none. */
void sb_process_last_words(const char *said, const char *none, char *words, size_t size);

#endif

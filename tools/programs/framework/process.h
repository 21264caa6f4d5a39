/* Runs other programs as processes whose output goes to a file. */
#ifndef SB_COMMON_PROCESS_H
#define SB_COMMON_PROCESS_H

#include "base/file.h"

#include <stddef.h>
#include <sys/types.h>

/* Starts a program (a path) with its arguments ([0]: its name; NULL after the last). It has no input; its output
   replaces the file `output`. If this process ends first, the program gets the signal `parent_death_signal`. The
   program ends with status 127 if it cannot be executed, 126 if `output` cannot be opened. SB_FAILED: no process. */
sb_status sb_process_start(const char *program, const char *const *arguments, const char *output,
                           int parent_death_signal, pid_t *process, sb_error *error);

/* Makes the folder and in it an empty log if there is none. This marks the folder as that of a run for `shorebreak
   run`, although it also contains files of this program. */
sb_status sb_process_claim(const char *folder, sb_error *error);

/* Path of the program `name` in the folder of this program; NULL: path of this program. */
sb_status sb_process_beside(const char *name, char path[SB_PATH_MAX], sb_error *error);

/* "status 2" or "signal 9", from the status that waitpid returned. */
void sb_process_describe(int how, char text[32]);

/* The last line of an output file that is not empty; `none` if there is none. */
void sb_process_last_line(const char *output, const char *none, char *text, size_t size);

#endif

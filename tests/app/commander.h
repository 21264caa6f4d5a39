/* Sends commands to runs by the real program, for tests that run shorebreak with --control. */
#ifndef SB_TESTS_APP_COMMANDER_H
#define SB_TESTS_APP_COMMANDER_H

#include "program.h"

/* Sends the command, e.g. "step 10", to the run in the directory of the tests' folder, and returns what the program
   printed; valid until the next call. Fails the test unless its exit status is this one. */
const char *commander_send(int status, const char *directory, const char *command);

/* Starts `run SCENE --control --out DIRECTORY` with a prefix of its own and the options, which end with NULL, and
   pauses it. Skips the test without a multicast route. */
pid_t commander_start(const char *scene, const char *directory, const char *const *options);

/* The first child process that is a shorebreak-live; 0: none. */
pid_t child_of(pid_t process);

/* Whether the process exists and is no zombie. */
bool is_there(pid_t process);

/* Waits for a helper of the run that is not this one; 0: the run has ended without one. */
pid_t next_helper(pid_t run, pid_t before);

/* The text of the last event of this kind in the log of a run, and the number of such events. Free it with sb_free;
   NULL: none. */
char *event_of(const char *directory, const char *event, size_t *count);

/* Fails the test unless two runs end in the same state. */
void assert_same_hash(const char *one, const char *other);

#endif

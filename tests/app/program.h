/* Runs the shorebreak binary in its own folder and captures its output. */
#ifndef SB_TESTS_APP_PROGRAM_H
#define SB_TESTS_APP_PROGRAM_H

#include "../check.h"

#include <sys/resource.h>
#include <sys/types.h>

/* Tanks with a collapsing block of water: 300 particles in 2D, 384 in 3D, particle files every 0.1 s,
   0.3 s long. The one in 3D has pictures of 160 x 90 px from two cameras, side and front. */
extern const char tank_2d[], tank_3d[];

/* The result of a process: its exit status (128 + n when signal n killed it) and its output. */
typedef struct outcome {
    int status;
    char *out, *err;
} outcome;

/* Group fixtures: make and remove the working folder of the programs, with tank2.yaml and tank3.yaml in it. */
int program_setup(void **state);
int program_teardown(void **state);

/* A path in the folder, formatted as by printf; valid until the eighth call from now. */
const char *in_folder(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Write and read a whole file of the folder. The test fails when there is none. Free the result of text_of with
 * sb_free. */
void write_text(const char *name, const char *text);
char *text_of(const char *name);

/* The mean of a column of a table over the rows of an item from a time on. column: counted from that after the item, 1.
   The test fails when there is no row. */
double mean_of(const char *path, const char *item, int column, double from);
bool exists(const char *name);

/* From now on mpirun starts the binary on so many ranks; NULL: without mpirun. */
void program_on_ranks(const char *count);
/* Whether there is an mpirun, and the binary can use it. */
bool program_has_mpi(void);

/* Starts the binary with one thread; arguments end with NULL. Its output goes to files. */
pid_t program_start(const char *const *arguments);
/* The same, with its output going to a pipe that no process reads. */
pid_t program_start_without_reader(const char *const *arguments);

/* Waits at most five minutes for its end, then the test fails. Free with outcome_free. */
outcome program_finish(pid_t process);
outcome program_run(const char *const *arguments);
/* Runs it with a limit on the length of files, as on a full disk. */
outcome program_run_limited(rlim_t bytes, const char *const *arguments);
/* Whether this process can change its user, as root can. The processes of root cannot be limited. */
bool program_can_change_user(void);
/* Runs it as a separate user with a limit on the number of processes and threads. */
outcome program_run_crowded(rlim_t processes, const char *const *arguments);
void outcome_free(outcome *o);

/* Runs it, and fails the test with its output unless it has the expected exit status. */
outcome program_expect(int status, const char *const *arguments);

#define RUN(status, ...) program_expect(status, (const char *const[]){__VA_ARGS__, NULL})
#define RUN_AND_FORGET(status, ...)                                                                                    \
    do {                                                                                                               \
        outcome forgotten = RUN(status, __VA_ARGS__);                                                                  \
        outcome_free(&forgotten);                                                                                      \
    } while (0)

/* Fails unless the text is one line that begins with "shorebreak: " and contains `expected`. */
void assert_one_line(const char *text, const char *expected);
void assert_contains(const char *text, const char *expected);

/* Returns the number at the first `key` of the file. Fails unless the file is valid JSON and the value is a number. */
double json_number_of(const char *name, const char *key);

/* Whether any file below the folder `name` has this ending. */
bool any_ending(const char *name, const char *ending);

#endif

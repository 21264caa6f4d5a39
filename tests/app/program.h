/* Runs the shorebreak binary in a folder of its own and catches what it says. */
#ifndef SB_TESTS_APP_PROGRAM_H
#define SB_TESTS_APP_PROGRAM_H

#include "../check.h"

#include <sys/resource.h>
#include <sys/types.h>

/* Tanks with a block of water that falls: 300 particles in 2D, 384 in 3D, particle files every 0.1 s,
   0.3 s long. The one in 3D has pictures of 160 x 90 px from two cameras, side and front. */
extern const char tank_2d[], tank_3d[];

/* How a process ended: its exit status (128 + n when signal n killed it) and what it wrote. */
typedef struct outcome {
    int status;
    char *out, *err;
} outcome;

/* Group fixtures: the folder, with tank2.yaml and tank3.yaml in it, is the programs' working one. */
int program_setup(void **state);
int program_teardown(void **state);

/* A path in the folder, made as printf does; valid until the eighth call from now. */
const char *in_folder(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A file of the folder, whole; the test fails when there is none. Free text_of's with sb_free. */
void write_text(const char *name, const char *text);
char *text_of(const char *name);
bool exists(const char *name);

/* Starts the binary with one thread; arguments end with NULL. Its output goes to files. */
pid_t program_start(const char *const *arguments);
/* Its output goes where nobody reads it any more. */
pid_t program_start_unheard(const char *const *arguments);

/* Waits for its end, five minutes at most: the test fails after that. Free with outcome_free. */
outcome program_finish(pid_t process);
outcome program_run(const char *const *arguments);
/* Where no file may be longer than this: as on a disk that is full. */
outcome program_run_limited(rlim_t bytes, const char *const *arguments);
/* Whether other users may be taken on, as root may: such users' processes can be limited, root's cannot. */
bool program_can_change_user(void);
/* As a user of its own that may have so many processes and threads. */
outcome program_run_crowded(rlim_t processes, const char *const *arguments);
void outcome_free(outcome *o);

/* Runs and fails the test, with what was said, unless the exit status is the one expected. */
outcome program_expect(int status, const char *const *arguments);

#define RUN(status, ...) program_expect(status, (const char *const[]){__VA_ARGS__, NULL})
#define RUN_AND_FORGET(status, ...)                                                                                    \
    do {                                                                                                               \
        outcome forgotten = RUN(status, __VA_ARGS__);                                                                  \
        outcome_free(&forgotten);                                                                                      \
    } while (0)

/* Fails unless the text is one line that begins with "shorebreak: " and holds `words`. */
void assert_one_line(const char *text, const char *words);
void assert_contains(const char *text, const char *words);

/* Fails unless the file is valid JSON and its first `key` is a number: its value. */
double json_number_of(const char *name, const char *key);

/* Whether any file in the folder below `name` has this ending. */
bool any_ending(const char *name, const char *ending);

#endif

/* Compares two runs that must have equal results, and handles the files of a run with checkpoints. */
#ifndef SB_TESTS_APP_PAIR_H
#define SB_TESTS_APP_PAIR_H

#include "program.h"

#include "frame/frame.h"

/* Checkpoints at every third step, none by the clock. */
#define EVERY_THREE "output.checkpoint={steps: 3, minutes: 0}"

/* As program_setup, with measured.yaml in addition: a scene with all kinds of measurements, and a paddle that still
   moves when the run is interrupted. */
int pair_setup(void **state);

/* The same, and the folder "whole" with a run of measured.yaml on one rank. */
int pair_setup_whole(void **state);

#define NEEDS_MPI()                                                                                                    \
    do {                                                                                                               \
        if (!program_has_mpi()) {                                                                                      \
            print_message("this build has no MPI, or there is no mpirun\n");                                           \
            skip();                                                                                                    \
        }                                                                                                              \
    } while (0)

/* Runs the program on so many ranks. */
#define RUN_ON(count, status, ...)                                                                                     \
    do {                                                                                                               \
        program_on_ranks(count);                                                                                       \
        RUN_AND_FORGET(status, "run", __VA_ARGS__);                                                                    \
        program_on_ranks(NULL);                                                                                        \
    } while (0)

/* Fails unless mpirun's output has exactly one line of the program, with this text. */
void assert_one_reason(const char *text, const char *expected);

/* The tables and maps of a run of measured.yaml; the list ends with NULL. */
extern const char *const pair_tables[];

/* Fails unless the file of that name has the same bytes in both runs' folders. */
void assert_same_file(const char *a, const char *b, const char *name);

/* Fails unless both runs ended in the same state, with the same numbers in their summaries, the same `files` (a list
   that ends with NULL) and the same particles. */
void assert_same_run(const char *a, const char *b, const char *const *files);

/* Fails unless both frames have the same number and particles. */
void assert_same_frame(const sb_frame *one, const sb_frame *two);

/* Lists the names of a run's checkpoints, oldest first; returns their number. */
int list_checkpoints(const char *run, char names[16][64]);

int count_of(const char *text, const char *part);

/* Read and write a file of the folder that may contain zeros. Free the result of bytes_of with sb_free. */
char *bytes_of(const char *name, size_t *length);
void put_bytes(const char *name, const char *bytes, size_t length);

#endif

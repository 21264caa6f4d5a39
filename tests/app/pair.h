/* Two runs that must have given the same, and the files of a run with checkpoints. */
#ifndef SB_TESTS_APP_PAIR_H
#define SB_TESTS_APP_PAIR_H

#include "program.h"

/* Checkpoints at every third step, and none by the clock. */
#define EVERY_THREE "output.checkpoint={steps: 3, minutes: 0}"

/* As program_setup, with measured.yaml too: all that can be measured, and a paddle that still moves when the run is
   cut. */
int pair_setup(void **state);

/* The tables and maps of a run of measured.yaml, ended by NULL. */
extern const char *const pair_tables[];

/* Fails unless the file of that name has the same bytes in both runs' folders. */
void assert_same_file(const char *a, const char *b, const char *name);

/* Fails unless both runs ended in the same state, with the same numbers in their summaries, the same files (ended by
   NULL) and the same particles. */
void assert_same_run(const char *a, const char *b, const char *const *files);

/* Names of a run's checkpoints in order, oldest first; returns how many. */
int list_checkpoints(const char *run, char names[16][64]);

int count_of(const char *text, const char *words);

/* A file of the folder, with zeros in it; free with sb_free. */
char *bytes_of(const char *name, size_t *length);
void put_bytes(const char *name, const char *bytes, size_t length);

#endif

/* Small scenes that are run alone and on several ranks. */
#ifndef SB_TESTS_RANKS_CASE_H
#define SB_TESTS_RANKS_CASE_H

#include "base/ranks_threads.h"
#include "sim/sim.h"

enum { RANKS_KEYS_MAX = 10, RANKS_TEST_MAX = 8 };

/* A scene: the file, keys over it ("path=value"), and the steps after settling. */
typedef struct ranks_case {
    const char *name, *file;
    int steps;
    const char *set[RANKS_KEYS_MAX];
} ranks_case;

typedef struct ranks_made {
    sb_scene scene;
    sb_model model;
} ranks_made;

/* Fails the test if the scene cannot be made. */
void ranks_make(const ranks_case *c, ranks_made *made);
void ranks_free(ranks_made *made);

/* What a run came to, the same in all ranks. */
typedef struct ranks_end {
    uint64_t hash;
    double time;
    sb_energy energy;
    size_t particles[RANKS_TEST_MAX]; /* of each rank */
    bool differs;                     /* ranks disagree */
    sb_error error;
} ranks_end;

/* Runs it alone, if ranks is 1, or on ranks as threads of this process, each with `threads` threads. */
ranks_end ranks_run(const ranks_case *c, const ranks_made *made, int ranks, int threads, uint64_t disturb);

#endif

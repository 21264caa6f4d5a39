/* Small scenes that are run alone and on several ranks. */
#ifndef SB_TESTS_RANKS_CASE_H
#define SB_TESTS_RANKS_CASE_H

#include "base/ranks_threads.h"
#include "sim/sim.h"

enum { RANKS_KEYS_MAX = 10, RANKS_TEST_MAX = 8, RANKS_SAMPLES_MAX = 4096, RANKS_BODIES_MAX = 16 };

/* What a run has, so that a comparison of it tests something. */
typedef enum ranks_has { RANKS_FOAM = 1, RANKS_DEPARTURES = 2, RANKS_PUSHES = 4, RANKS_INFLOW = 8 } ranks_has;

/* A scene: the file, keys over it ("path=value"), and the steps after settling. */
typedef struct ranks_case {
    const char *name, *file;
    int steps;
    const char *set[RANKS_KEYS_MAX];
    unsigned has;   /* flags */
    bool disturbed; /* it is also run with delayed messages and two threads per rank */
    bool divided;   /* each rank has a model of its own, with its part of the boundary particles */
} ranks_case;

/* ranks_cases.c: the first scene, one whose only water is a sea that moves at the start, and one for each kind of
 * scene; ends with one without name. */
extern const ranks_case ranks_column, ranks_sea, ranks_cases[];

typedef struct ranks_made {
    sb_scene scene;
    sb_model model;
} ranks_made;

/* Fails the test if the scene cannot be made. */
void ranks_make(const ranks_case *c, ranks_made *made);
void ranks_free(ranks_made *made);
/* Where the forces on walls are recorded: on each body near a corner of the domain. Returns the number. */
size_t ranks_places(const ranks_made *made, sb_push_place places[RANKS_BODIES_MAX]);

/* How to run it: ranks 1 is alone. `threads` each. disturb: seed of delays; 0: none. from: a saved state to begin with;
   NULL: the start. */
typedef struct ranks_way {
    int ranks, threads;
    uint64_t disturb;
    const sb_archive_out *from;
    int steps;    /* instead of the case's, if > 0 */
    bool divided; /* each rank has a model of its own, with its part of the boundary particles */
    bool water;   /* and of the water */
} ranks_way;

/* What a run came to. What differs between the ranks is that of the first. */
typedef struct ranks_end {
    uint64_t hash;
    double time;
    sb_energy energy;
    sb_departures departures;
    sb_crossing crossing;
    size_t fluid, particles[RANKS_TEST_MAX]; /* of all, and of each rank */
    bool differs;                            /* ranks disagree */
    sb_error error;
    sb_frame *frame;
    sb_archive_out saved;
    size_t found, few;        /* samples of a query, with enough capacity and with little */
    sb_fluid_sample *samples; /* RANKS_SAMPLES_MAX */
    size_t push_count;
    sb_vec3 push; /* N, sum of the recorded forces on walls, exact */
} ranks_end;

ranks_end ranks_run(const ranks_case *c, const ranks_made *made, const ranks_way *way);
bool ranks_same_samples(const ranks_end *a, const ranks_end *b);
void ranks_end_free(ranks_end *end);

#endif

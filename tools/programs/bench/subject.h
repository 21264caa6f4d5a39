/* A simulation in a saved state from which every repeat starts. */
#ifndef SB_BENCH_SUBJECT_H
#define SB_BENCH_SUBJECT_H

#include "base/archive.h"
#include "geometry/model/model.h"
#include "sections.h"
#include "sim/simulation.h"

typedef struct sb_bench_subject {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    sb_archive_out state; /* saved state, in memory */
    double setup;         /* s, from reading the scene file to the first step */
    size_t peak;          /* bytes, largest resident size before the state was copied */
    uint64_t result;      /* hash after the steps of a repeat; 0: no repeat yet */
} sb_bench_subject;

/* Reads the scene assets/name with the overrides and makes its model and simulation. The simulation points into
 *subject, which must not move. On error there is nothing to free. */
sb_status sb_bench_subject_build(const char *assets, const char *name, const sb_override *overrides, size_t count,
                                 sb_bench_subject *subject, sb_error *error);
/* The same; then settles the water, makes `steps` steps and saves the state. */
sb_status sb_bench_subject_make(const char *assets, const char *name, const sb_override *overrides, size_t count,
                                int steps, sb_bench_subject *subject, sb_error *error);
/* The same for the basin with request->particles particles and ten iterations in each step. */
sb_status sb_bench_basin_make(const sb_bench_request *request, const char *settle_steps, sb_bench_subject *subject,
                              sb_error *error);
void sb_bench_subject_free(sb_bench_subject *subject);

/* Restores the saved state, which is checked by its hash. */
sb_status sb_bench_restore(sb_bench_subject *subject, sb_error *error);

/* Restores the state, makes one step without timing (to fill caches and lists), restores it again and makes `steps`
   timed steps. seconds: their total time. stage_seconds: time of each stage, as in sb_sim_stages; may be NULL.
   SB_FAILED: the final state differs from that of the last repeat, so that the work was not the same. */
sb_status sb_bench_repeat(sb_bench_subject *subject, int steps, double *seconds, double stage_seconds[SB_STAGES_MAX],
                          sb_error *error);

#endif

/* A scene brought to a state from which every repeat starts. */
#ifndef SB_BENCHMARK_SUBJECT_H
#define SB_BENCHMARK_SUBJECT_H

#include "base/archive.h"
#include "geometry/model.h"
#include "rows.h"
#include "sim/state.h"

typedef struct sb_bench_subject {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    sb_archive_out state; /* the simulation saved, in memory */
    double setup;         /* s: from the scene file to the first step */
    size_t peak;          /* bytes: greatest resident size before the state was copied */
    uint64_t result;      /* hash after a repeat's steps; 0: none made yet */
} sb_bench_subject;

/* Reads the scene with the overrides and makes its model and simulation, which points into *subject: that must stay
   where it is. On error there is nothing to free. */
sb_status sb_bench_subject_build(const char *path, const sb_override *overrides, size_t count,
                                 sb_bench_subject *subject, sb_error *error);
/* The same; then settles it, makes `steps` steps and keeps the state. */
sb_status sb_bench_subject_make(const char *path, const sb_override *overrides, size_t count, int steps,
                                sb_bench_subject *subject, sb_error *error);
void sb_bench_subject_free(sb_bench_subject *subject);

/* The simulation as it was kept. It proves itself by the hash of the state. */
sb_status sb_bench_restore(sb_bench_subject *subject, sb_error *error);

/* Restores, makes one step that is not timed (caches, lists of the right size), restores again and makes `steps`
   steps. seconds: of these together; stage_seconds: of each stage, as in sb_sim_stages, may be NULL. SB_FAILED when
   the state reached differs from that of the repeat before: then the work was not the same. */
sb_status sb_bench_repeat(sb_bench_subject *subject, int steps, double *seconds, double stage_seconds[SB_STAGES_MAX],
                          sb_error *error);

#endif

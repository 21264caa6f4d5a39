/* summary.json: one run in one object. */
#ifndef SB_OUTPUT_SUMMARY_H
#define SB_OUTPUT_SUMMARY_H

#include "geometry/model.h"
#include "measure/records.h"
#include "output/json.h"
#include "scene/scene.h"
#include "sim/sim.h"

/* What one stage took: in all, and of that while the water came to rest. */
typedef struct sb_stage_spent {
    char name[24];
    double seconds, settling_seconds; /* of wall time */
    uint64_t calls, settling_calls;
} sb_stage_spent;

/* What a run took, in all the processes that worked on it. */
typedef struct sb_spent {
    double wall, processor; /* s; processor time is of all threads */
    double setup, settling; /* s of wall time: until the first step, in each process; bringing the water to rest */
    size_t stage_count;
    sb_stage_spent stage[SB_STAGES_MAX];
} sb_spent;

/* Zero or NULL where a run never came that far. Pointers are read during the call only. */
typedef struct sb_summary {
    const sb_scene *scene;
    const sb_model *model;
    sb_status status;   /* how the run ended */
    const char *reason; /* NULL unless it failed */
    sb_spent spent;
    double simulated;                    /* s */
    uint64_t steps, iterations;          /* iterations: sum over all steps */
    double compression, compression_max; /* sum over the steps, and the worst: as in sb_step_report */
    uint64_t capped_steps;               /* pressure solves that stopped above their tolerance */
    size_t fluid_particles;              /* at the start */
    size_t bytes;                        /* heap bytes of the simulation */
    uint64_t lost, left_domain;          /* through walls; through open sides */
    const sb_departures *departures;     /* by which side, and the first few */
    bool has_inside;                     /* the two below were asked for */
    uint64_t inside, crossed;            /* particles whose centre lies within a solid at the end: at all; deeper
                                            than its boundary particles */
    int threads;
    const sb_body_record *bodies;              /* one per body of the model; NULL: none */
    sb_energy first, last;                     /* energies at the start and at the end */
    const sb_ledger *work;                     /* where energy went between; NULL: no simulation was made */
    uint64_t hash;                             /* of the final state */
    uint64_t frames, pictures;                 /* particle files and pictures written */
    uint64_t frames_missing, pictures_missing; /* that could not be */
} sb_summary;

/* An object of energies, J, mass, kg, and momentum, kg m/s. */
void sb_summary_put_energy(sb_json *json, const char *key, const sb_energy *energy);
/* The object "energy_work": the sums of energy.csv's columns, J. */
void sb_summary_put_work(sb_json *json, const sb_ledger *work);

/* The same file while the run goes on: version, preset, title and the status "running", so that a run which never comes
   to its end is not taken for an earlier one that did. */
sb_status sb_summary_write_running(const char *path, const sb_scene *scene, sb_error *error);

/* Writes the file whole or not at all. In 2D forces, impulses and energies are per metre of width
   and "per_metre" is true. */
sb_status sb_summary_write(const char *path, const sb_summary *summary, sb_error *error);

#endif

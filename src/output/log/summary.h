/* Writes summary.json: the results of one run as one object. */
#ifndef SB_OUTPUT_SUMMARY_H
#define SB_OUTPUT_SUMMARY_H

#include "frame/departures.h"
#include "frame/energy.h"
#include "frame/records.h"
#include "frame/stage_time.h"
#include "geometry/model/model.h"
#include "output/log/grid_summary.h"
#include "output/log/json.h"
#include "output/tables/overtopping_rate.h"
#include "output/tables/wave_table.h"
#include "scene/scene.h"

/* Run time of one stage: total, and the part in settling. */
typedef struct sb_stage_spent {
    char name[24];
    double seconds, settling_seconds; /* of wall time */
    uint64_t calls, settling_calls;
} sb_stage_spent;

/* Run time of a run, summed over all processes that worked on it. */
typedef struct sb_spent {
    double wall, processor; /* s; processor time is summed over all threads */
    double setup, settling; /* s of wall time: before the first step, in each process; in settling */
    size_t stage_count;
    sb_stage_spent stage[SB_STAGES_MAX];
} sb_spent;

/* Members are zero or NULL if the run ended before they were known. Pointers are read during the call only. */
typedef struct sb_summary {
    const sb_scene *scene;
    const sb_model *model;
    sb_status status;   /* how the run ended */
    const char *reason; /* NULL unless it failed */
    sb_spent spent;
    double simulated;                    /* s */
    uint64_t steps, iterations;          /* iterations: sum over all steps */
    double compression, compression_max; /* sum over the steps, and the maximum: as in sb_step_report */
    uint64_t capped_steps;               /* pressure solves that stopped above their tolerance */
    size_t fluid_particles;              /* at the start */
    size_t bytes;                        /* heap bytes of the simulation */
    uint64_t lost, left_domain;          /* through walls; through open sides */
    const sb_departures *departures;     /* counts per side, and the first few particles */
    bool has_inside;                     /* the two below are known */
    uint64_t inside, crossed;            /* particles whose centre lies within a solid at the end: all; those deeper
                                            than its boundary particles */
    int threads, ranks;                  /* threads: of each rank */
    const sb_body_record *bodies;        /* one per body of the model; NULL: none */
    const sb_absorption *absorptions;    /* one per body of the model; NULL: none */
    const sb_gauge_waves *waves;         /* one per gauge; NULL: none */
    const sb_overtopping_rate *rates;    /* one per plane; NULL: none */
    const sb_grid_facts_beside *grid;    /* the depth-averaged water that is the sea; NULL: none */
    size_t reflection_count;
    const sb_reflection_record *reflections;   /* since the start of each set */
    sb_energy first, last;                     /* energies at the start and at the end */
    const sb_ledger *work;                     /* energy ledger; NULL: there was no simulation */
    const sb_crossing *crossing;               /* through sides of kind sea; NULL: there are none */
    double particle_mass;                      /* kg; in 2D kg/m */
    uint64_t hash;                             /* of the final state */
    uint64_t frames, pictures;                 /* particle files and pictures written */
    uint64_t frames_missing, pictures_missing; /* that could not be written */
} sb_summary;

/* Writes an object of energies, J, mass, kg, and momentum, kg m/s. */
void sb_summary_put_energy(sb_json *json, const char *key, const sb_energy *energy);
/* Writes the object "energy_work": the final values of energy.csv's ledger columns, J. */
void sb_summary_put_work(sb_json *json, const sb_ledger *work);

/* Writes the file of a run in progress: version, preset, title and the status "running". A killed run is then not
   mistaken for an earlier run that finished. */
sb_status sb_summary_write_running(const char *path, const sb_scene *scene, sb_error *error);

/* Writes the file completely or not at all. In 2D forces, impulses and energies are per metre of width
   and "per_metre" is true. */
sb_status sb_summary_write(const char *path, const sb_summary *summary, sb_error *error);

#endif

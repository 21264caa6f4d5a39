/* Driven runs advance the simulation step by step. They serve for starts that a scene cannot describe, and for checks
   of every step: finite numbers, particles within solids, solves that stop above their tolerance without reporting it.
 */
#ifndef SB_STRESS_DRIVE_H
#define SB_STRESS_DRIVE_H

#include "geometry/model/model.h"
#include "output/log/json.h"
#include "scene/scene.h"
#include "sim/sim.h"

/* A driven run, as passed to its hooks. */
typedef struct sb_driven {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    double number;                           /* of the trial */
    double kept[8];                          /* for the hooks, zero at the start */
    double last_time, momentum_imbalance;    /* time of the last step, s; the largest so far */
    uint64_t iterations, capped, unreported; /* unreported: solves above their tolerance that were not counted */
    uint64_t not_finite, through, inside;    /* particles, largest number of any check */
    double error_sum, error_share; /* sum of error_mean; largest error_mean / tolerance of a step that was not capped */
    sb_energy first;
    double energy_peak, top_speed;   /* J; m/s; largest of any step */
    double late_speed, late_samples; /* root mean square speeds of the second half: sum, number */
} sb_driven;

/* Hooks may be NULL. */
typedef struct sb_drive {
    sb_status (*alter)(sb_driven *driven,
                       sb_error *error);                /* after the model is built, before the simulation is made */
    void (*watch)(sb_driven *driven);                   /* after each step */
    void (*close)(sb_driven *driven, sb_json *figures); /* at the end: adds numbers to summary.json */
} sb_drive;

/* No hooks. */
extern const sb_drive sb_drive_plain;

struct sb_trial;

/* Runs the trial for the scene's duration and writes summary.json into the folder. Statuses as of a run. */
sb_status sb_drive_run(const struct sb_trial *trial, const char *assets, const char *folder, sb_error *error);

#endif

/* Runs driven step by step, for starts that no scene can say, and for what has to be looked at after every
   step: finite numbers, particles within solids, solves that stop above their tolerance without a word. */
#ifndef SB_BATTERY_DRIVE_H
#define SB_BATTERY_DRIVE_H

#include "geometry/model.h"
#include "output/json.h"
#include "scene/scene.h"
#include "sim/sim.h"

/* A driven run as its hooks see it. */
typedef struct sb_driven {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    double number;                           /* the trial's */
    double kept[8];                          /* the hooks' own, zero at the start */
    double last_time, momentum_imbalance;    /* s of the step before; the largest so far */
    uint64_t iterations, capped, unreported; /* unreported: solves above their tolerance that do not say so */
    uint64_t not_finite, through, inside;    /* particles, the most at any look */
    double error_sum, error_share; /* of report.error_mean; the largest error_mean / tolerance of a step not capped */
    sb_energy first;
    double energy_peak, top_speed;   /* J; m/s: the largest of any step */
    double late_speed, late_samples; /* root mean square speed, summed over steps of the second half */
} sb_driven;

/* Hooks may be NULL. */
typedef struct sb_drive {
    sb_status (*alter)(sb_driven *driven, sb_error *error); /* model is built, simulation not yet made */
    void (*watch)(sb_driven *driven);                       /* after each step */
    void (*close)(sb_driven *driven, sb_json *figures);     /* at the end: numbers for summary.json */
} sb_drive;

/* No hooks. */
extern const sb_drive sb_drive_plain;

struct sb_trial;

/* Runs the trial to its scene's duration and leaves summary.json in the folder. Statuses as of a run. */
sb_status sb_drive_run(const struct sb_trial *trial, const char *assets, const char *folder, sb_error *error);

#endif

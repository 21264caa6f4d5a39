/* Paddles that absorb waves: they move from their law with a velocity that follows from the water beside them
   (physics/paddle_transfer.h). */
#ifndef SB_SIM_ABSORBER_H
#define SB_SIM_ABSORBER_H

#include "physics/absorption/absorbing.h"
#include "sim/simulation.h"

typedef struct sb_absorber {
    double face, distance;   /* m along the direction: face at rest; place ahead of it where its water is measured */
    double side[2], from[2]; /* unit vector along the face in x and y; its extent along that within the domain, m */
    double reach;            /* m */
    double behind, ahead;    /* m: how far it may move from its place at rest, until its body is at the domain's side */
    size_t plate, plates;    /* of a paddle that is divided, whose plates follow each other; 0, 0: it is one */
    double period;           /* s, of its waves, at the peak */
    double depth;            /* m, of the water beside it at the beginning of the step */
    /* state */
    bool known;   /* the column at rest is */
    bool drifted; /* ten whole periods have passed */
    double still; /* m, depth of the water beside it at rest: that at the start by its particles, less the initial wave;
                     0: a plate before land */
    sb_absorbing_state state; /* its displacement from the law, and the filter's values */
    double farthest;          /* m, largest displacement from the law */
    uint64_t limited;         /* steps in which reach or a side of the domain stopped it */
    double sum, elapsed;      /* m s, s: integral of the displacement from the law over the present ten periods */
    double drift, drift_most; /* m, its mean over the last whole ten periods, and the largest magnitude of these */
} sb_absorber;

/* Makes the absorber of a moving body if its law has one. */
sb_status sb_absorber_create(sb_sim *sim, size_t body, sb_moving_body *moving, sb_error *error);
/* Sets the depths beside the absorbing paddles, after all displacements have been set. Returns 0, or -1 without
   memory. */
int sb_absorbers_measure(sb_sim *sim);
/* Whether a box of water (water.boxes) is before the face. */
bool sb_absorber_boxed(const sb_sim *sim, const sb_moving_body *moving);
/* Elevation of the scene's initial wave at the place where the water of a part of the face is measured, m: the mean
   from `from` to `to` along the face. */
double sb_absorber_raised(const sb_sim *sim, const sb_moving_body *moving, double from, double to);
/* Returns the offset at the end of the step. */
double sb_absorber_advance(sb_sim *sim, sb_moving_body *moving);

/* A cubic B-spline over [-2, 2] with the integral 1. */
double sb_column_weight(double x);
/* The window across the surface's place, x spacings from it: over [-3, 3], with the integral 1. Its transform has zeros
   at all whole numbers, so that the depth does not depend on where rows of particles lie. That of a B-spline over
   [-3, 3] has not: rows that begin half a spacing from the face have 0.4 % less than the same particles in disorder.
   Push-plates still use the latter (docs/decisions/0071). */
double sb_column_window(double x);
/* Whether the face ends at two periodic sides, and so has no ends. */
bool sb_absorber_repeats(const sb_scene *scene, const sb_absorber *a);
/* plates.c: sets the extent of a push-plate: side and from are those of the whole row. */
void sb_plate_find(const sb_sim *sim, size_t body, sb_absorber *a);
/* Sets the depths beside all plates of a row. moving: its first plate. Returns 0, or -1 without memory. */
int sb_plates_measure(sb_sim *sim, sb_moving_body *moving);

void sb_absorbers_save(const sb_sim *sim, sb_archive_out *out);
void sb_absorbers_load(sb_sim *sim, sb_archive_in *in);
uint64_t sb_absorbers_hash(const sb_sim *sim, uint64_t hash);

#endif

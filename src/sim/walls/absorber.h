/* Paddles that absorb waves: they move from their law with a velocity that follows from the water beside them
   (physics/paddle_transfer.h). */
#ifndef SB_SIM_ABSORBER_H
#define SB_SIM_ABSORBER_H

#include "sim/simulation.h"

typedef struct sb_absorber {
    sb_absorbing_filter filter;
    double face, distance;   /* m along the direction: face at rest; place ahead of it where its water is measured */
    double side[2], from[2]; /* unit vector along the face in x and y; its extent along that, m */
    double reach;            /* m */
    size_t plate, plates;    /* of a paddle that is divided, whose plates follow each other; 0, 0: it is one */
    double depth;            /* m, of the water beside it at the beginning of the step */
    /* state */
    bool known;               /* the column at rest is */
    double still;             /* m, depth of the water beside it at the start, by its particles */
    double low, fast, offset; /* m: slow part of the surface, its lagged part, displacement from the law */
    double speed;             /* m/s, of the offset */
    double farthest;          /* m, largest |offset| */
    uint64_t limited;         /* steps in which reach stopped it */
} sb_absorber;

/* Makes the absorber of a moving body if its law has one. */
sb_status sb_absorber_create(sb_sim *sim, size_t body, sb_moving_body *moving, sb_error *error);
/* Sets the depths beside the absorbing paddles, after all displacements have been set. Returns 0, or -1 without
   memory. */
int sb_absorbers_measure(sb_sim *sim);
/* Returns the offset at the end of the step. */
double sb_absorber_advance(sb_sim *sim, sb_moving_body *moving);

/* A cubic B-spline over [-2, 2] with the integral 1. */
double sb_column_weight(double x);
/* plates.c: sets the place of a push-plate: side and from are those of the whole row. */
void sb_plate_find(const sb_sim *sim, size_t body, sb_vec3 direction, sb_absorber *a);
/* Sets the depths beside all plates of a row. moving: its first plate. Returns 0, or -1 without memory. */
int sb_plates_measure(sb_sim *sim, sb_moving_body *moving);

void sb_absorbers_save(const sb_sim *sim, sb_archive_out *out);
void sb_absorbers_load(sb_sim *sim, sb_archive_in *in);
uint64_t sb_absorbers_hash(const sb_sim *sim, uint64_t hash);

#endif

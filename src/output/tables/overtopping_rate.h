/* eurotop.csv: mean rates of overtopping at the planes of a run, beside EurOtop 2018. */
#ifndef SB_OUTPUT_OVERTOPPING_RATE_H
#define SB_OUTPUT_OVERTOPPING_RATE_H

#include "scene/scene.h"

/* The first bytes of eurotop.csv. */
#define SB_EUROTOP_TABLE_START "plane,from_s,"

typedef struct sb_overtopping_rate {
    double from, to;  /* s, of the rows that are used; NaN: none */
    double rate;      /* m^2/s: mean net volume per metre of the plane and second */
    double freeboard; /* m */
    double formula;   /* m^2/s, by EurOtop 2018 (physics/eurotop.h) */
} sb_overtopping_rate;

/* Whether a plane of the scene is compared with EurOtop. */
bool sb_overtopping_wanted(const sb_scene *scene);
/* Finds the rates from overtopping.csv of the run's directory, and writes eurotop.csv with a row for each plane that is
   compared. *rates: one per plane, which the caller frees with sb_free; those of other planes are NaN. */
sb_status sb_overtopping_write(const char *directory, const sb_scene *scene, sb_overtopping_rate **rates,
                               sb_error *error);

#endif

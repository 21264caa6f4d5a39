/* Scenes with sides of kind sea, made without scene files. */
#ifndef SB_TESTS_SHORE_H
#define SB_TESTS_SHORE_H

#include "geometry/model/model.h"
#include "sim/simulation.h"

typedef struct shore_form {
    int dimensions;
    double spacing, depth;
    sb_vec3 size;
    const char *sides;  /* as in a scene, "{x_min: sea}" */
    const char *bodies; /* as in a scene; NULL: none */
} shore_form;

typedef struct shore {
    sb_scene scene;
    sb_model model;
} shore;

/* Makes water of a depth over the whole domain from (0, 0, 0) to `size`. sea: what comes in, as in a scene; NULL: still
   water. The domain itself starts with still water. Ends the program on an error. */
void shore_make(shore *s, const shore_form *form, const char *sea);
/* The status and the message of the same. */
sb_status shore_try(shore *s, const shore_form *form, const char *sea, sb_error *error);
void shore_free(shore *s);

/* Creates the simulation, settled. Ends the program on an error. */
sb_sim *shore_sim(shore *s);
/* Steps until a time (s). */
void shore_run(sb_sim *sim, double until);
/* Volume of the water, m^3 or m^2, and mean depth over x0 <= x < x1 by smooth weights, m. */
double shore_volume(const sb_sim *sim);
double shore_depth(const sb_sim *sim, double x, double reach);

#endif

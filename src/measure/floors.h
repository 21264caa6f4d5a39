/* The horizontal surfaces that water can stand on at a point of the plan: the ground, and decks, roofs and submerged
   bodies above it. Private to src/measure. */
#ifndef SB_MEASURE_FLOORS_H
#define SB_MEASURE_FLOORS_H

#include "geometry/model/model.h"

/* Elevations z (m) of upward faces of bodies that do not move, from the top downwards. Zero-initialised: none. */
typedef struct sb_floors {
    size_t count, capacity;
    double *z;
} sb_floors;

/* Finds the floors at (x, y) from the boundary particles there; y is 0 in 2D. SB_FAILED without memory. */
sb_status sb_floors_find(const sb_scene *scene, const sb_model *model, double x, double y, sb_floors *floors,
                         sb_error *error);
/* The distance in plan at which boundary particles count, m. */
double sb_floors_radius(const sb_scene *scene);
void sb_floors_free(sb_floors *floors);

#endif

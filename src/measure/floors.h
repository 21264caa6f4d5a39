/* What water can stand on above a point of the plan: the ground, and decks, roofs and submerged bodies over it. Inside
   src/measure. */
#ifndef SB_MEASURE_FLOORS_H
#define SB_MEASURE_FLOORS_H

#include "geometry/model.h"

/* Zero-initialised has none. Faces that look up, of bodies that do not move, from the top; z in m. */
typedef struct sb_floors {
    size_t count, capacity;
    double *z;
} sb_floors;

/* Over (x, y), by the boundary particles there; y is 0 in 2D. SB_FAILED without memory. */
sb_status sb_floors_find(const sb_scene *scene, const sb_model *model, double x, double y, sb_floors *floors,
                         sb_error *error);
void sb_floors_free(sb_floors *floors);

#endif

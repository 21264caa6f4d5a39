/* Small scenes made by hand for tests of the simulation: a tank with water, no files. */
#ifndef SB_TESTS_TANK_H
#define SB_TESTS_TANK_H

#include "geometry/model.h"
#include "scene/scene.h"

typedef struct tank {
    sb_scene scene;
    sb_model model;
} tank;

/* A closed box `size` (m) holding water to `depth` over x in [0, wet_length]; sheets half a spacing
   outside the walls, all one body "tank". dimensions 2: y is ignored. jitter in spacings. */
void tank_make(tank *t, int dimensions, double spacing, sb_vec3 size, double wet_length, double depth,
               double jitter);
void tank_free(tank *t);

#endif

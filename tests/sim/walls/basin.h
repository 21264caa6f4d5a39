/* Scenes with walls that reflect water, for tests. */
#ifndef SB_TESTS_BASIN_H
#define SB_TESTS_BASIN_H

#include "sim/tank.h"

typedef struct basin {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
} basin;

/* Makes a scene with these keys over those of tests/sim/tank.yaml. Fails the test if it cannot be made. */
void basin_fill_from(basin *b, const sb_override *set, size_t count);
/* The same with walls that reflect water, up to its model, which the test may change before basin_start. */
void basin_build(basin *b, const sb_override *set, size_t count);
void basin_start(basin *b);
/* Moves the water of the model to random places in the box [min, max], with velocities up to `speed` along each axis.
 */
void basin_scatter(basin *b, uint64_t seed, sb_vec3 min, sb_vec3 max, double speed);
/* One with walls that reflect water. density: the rule of numerics.density. */
void basin_fill(basin *b, int dimensions, const char *spacing, const char *max, const char *water, const char *bodies,
                const char *density);
/* A displacement of a particle at a place (m), in whole quanta: a smooth field of `size` quanta plus noise by its id.
 */
sb_f4 basin_way(const sb_sim *sim, sb_vec3 place, uint32_t id, double size);
void basin_settle(basin *b);
void basin_free(basin *b);

#endif

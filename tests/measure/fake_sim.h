/* A fake simulation: it contains the particles and impulses that a test puts into it. */
#ifndef SB_TESTS_FAKE_SIM_H
#define SB_TESTS_FAKE_SIM_H

#include "measure/measure.h"
#include "measure/parts.h"

enum { FAKE_BODIES = 4 };

struct sb_sim {
    sb_step_report report;
    size_t capacity;
    sb_fluid_sample *samples; /* report.fluid_count of them */
    sb_body_impulse impulses[FAKE_BODIES];
    sb_vec3 displacements[FAKE_BODIES];
    sb_energy energy;
    sb_ledger ledger;
    size_t place_count; /* that were asked for */
    size_t push_count;
    const sb_wall_push *pushes; /* of the last step */
};

/* A scene and model of one unit spacing (or `spacing`) with a domain [min, max] and no bodies. */
typedef struct fake_world {
    sb_scene scene;
    sb_model model;
    sb_sim sim;
    sb_cloud cloud;
} fake_world;

void fake_world_make(fake_world *world, int dimensions, double spacing, sb_vec3 min, sb_vec3 max);
void fake_world_free(fake_world *world);
sb_measure_view fake_view(fake_world *world);

void fake_add(sb_sim *sim, sb_vec3 position, sb_vec3 velocity, double pressure);

/* Fills [min, max] with a lattice whose layers count down from max (the top layer half a spacing
   below max.z), shifted horizontally by (shift_x, shift_y) spacings, each particle displaced by at
   most `jitter` spacings in each direction. Hydrostatic pressure below max.z. */
void fake_fill(fake_world *world, sb_vec3 min, sb_vec3 max, double shift_x, double shift_y, double jitter,
               uint64_t seed);

/* Advances time by dt, moving each particle by dt times its velocity. */
void fake_step(sb_sim *sim, double dt);

#endif

/* Small scenes made by hand for tests of the simulation: a tank with water, no files. */
#ifndef SB_TESTS_TANK_H
#define SB_TESTS_TANK_H

#include "base/archive.h"
#include "geometry/model.h"
#include "scene/scene.h"
#include "sim/state.h"

typedef struct tank {
    sb_scene scene;
    sb_model model;
    size_t wall_capacity, normal_capacity;
} tank;

/* A closed box `size` (m) holding water to `depth` over x in [0, wet_length]; sheets half a spacing
   outside the walls, all one body "tank". dimensions 2: y is ignored. jitter in spacings. */
void tank_make(tank *t, int dimensions, double spacing, sb_vec3 size, double wet_length, double depth, double jitter);
void tank_free(tank *t);

/* Makes the sides across an axis (0: x, 1: y) periodic, without the walls there. */
void tank_repeat(tank *t, int axis);
/* Carries water and boundary particles along within a periodic tank: what leaves at a side comes
   back at the other. */
void tank_roll(tank *t, sb_vec3 by);

/* Carries the whole tank, water and all, elsewhere. */
void tank_shift(tank *t, sb_vec3 by);
/* Water anywhere within the box, at velocities up to `speed` along each axis, at pressure 0. */
void tank_scatter(tank *t, uint64_t seed, double speed);
/* Parts what lies in the box (min, max) off the body "tank", as body 0, "patch"; the rest is
 * body 1. */
void tank_split_patch(tank *t, sb_vec3 min, sb_vec3 max);

/* A new body of boundary particles a spacing apart: an upright sheet across the tank at x from
   z_min to z_max; moved along `direction` by `law`, or static when that is NULL. Returns the body's
   index. */
size_t tank_add_sheet(tank *t, const char *name, double x, double z_min, double z_max, sb_vec3 direction,
                      const sb_wavemaker_parameters *law);

/* Turns on what a scene may leave out: the stress correction, friction at walls, turbulence, viscosity; a few steps of
 * settling. */
void tank_add_terms(tank *t);

/* The simulation of the tank; NULL, with the reason on stderr, when there is none. */
sb_sim *tank_sim(const tank *t);
/* The same, settled; the program ends, with the reason on stderr, when there is none or it does not settle. */
sb_sim *tank_settled(const tank *t);
/* The stages of a step up to the neighbour lists, for a step of dt. 0, or -1 with the reason. */
int tank_prepare(sb_sim *sim, double dt);
/* Its state as an archive, to be freed, and back from there into a simulation of the same tank. */
void tank_save(const sb_sim *sim, sb_archive_out *out);
sb_status tank_load(sb_sim *sim, const sb_archive_out *out, sb_error *error);
/* Whether its steps have the stage, and whether it says that it leaves out something by that word. */
bool tank_has_stage(const sb_sim *sim, const char *name);
bool tank_says(const sb_sim *sim, const char *word);
/* n whole steps. 0, or -1 with the reason on stderr. */
int tank_steps(sb_sim *sim, int n);

#endif

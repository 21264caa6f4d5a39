/* Small scenes for tests of the simulation: a tank with water, made without files. */
#ifndef SB_TESTS_TANK_H
#define SB_TESTS_TANK_H

#include "base/archive.h"
#include "geometry/model/model.h"
#include "scene/scene.h"
#include "sim/simulation.h"

/* What a tank is made from. */
typedef struct tank_form {
    sb_preset preset;
    int dimensions;
    double spacing;
    sb_vec3 size;
    double wet_length, depth, jitter;
    bool repeats[2];
    bool particles; /* walls of boundary particles and what they allow, whatever the preset */
} tank_form;

typedef struct tank {
    tank_form form;
    sb_scene scene;
    sb_model model;
    size_t wall_capacity, normal_capacity, facet_capacity, edge_capacity;
} tank;

/* Makes a closed box of `size` (m) with water to `depth` over x in [0, wet_length]. Scene and model are those of the
   program for such a domain with the default preset: a sea if the water extends to all sides, else a box of water.
   Their one body is "domain". dimensions 2: y is ignored. jitter: in spacings. */
void tank_make(tank *t, int dimensions, double spacing, sb_vec3 size, double wet_length, double depth, double jitter);
/* The same with walls of boundary particles and what they allow, whatever the preset: a test can move them, divide them
   and add to them. */
void tank_of_particles(tank *t, int dimensions, double spacing, sb_vec3 size, double wet_length, double depth,
                       double jitter);
/* Makes a tank of the same form again, with the numerics of a preset. Later changes of scene and model are lost. */
void tank_use(tank *t, sb_preset preset);
/* Names of the presets. Loops over both run from SB_PRESET_DEFAULT to SB_PRESET_PAPER. */
extern const char *const tank_preset_names[];
void tank_free(tank *t);

/* Makes the tank again with periodic sides across an axis (0: x, 1: y). Later changes of scene and model are lost. */
void tank_repeat(tank *t, int axis);
/* Shifts water and boundary particles within a periodic tank; what leaves at one side returns at the other. */
void tank_roll(tank *t, sb_vec3 by);
/* Rounds x and y up to whole quanta of the tank. If periods and shifts are whole quanta, a shifted tank has the same
   offsets between particles, bit for bit. */
sb_vec3 tank_whole_quanta(const tank *t, sb_vec3 way);

/* Shifts the whole tank with its water. */
void tank_shift(tank *t, sb_vec3 by);
/* Moves the water to random positions within the box, with velocities up to `speed` along each axis and pressure 0. */
void tank_scatter(tank *t, uint64_t seed, double speed);
/* For a tank of particles. Splits the body "tank": its boundary particles in the box (min, max) become body 0, "patch";
 * the rest is body 1. */
void tank_split_patch(tank *t, sb_vec3 min, sb_vec3 max);

/* For a tank of particles. Adds a body of boundary particles one spacing apart: a vertical plane across the tank at x
   from z_min to z_max, with facets wall_offset before it on both sides. It moves along `direction` by `law`, or is
   static if that is NULL. Returns the body's index. */
size_t tank_add_plate(tank *t, const char *name, double x, double z_min, double z_max, sb_vec3 direction,
                      const sb_wavemaker_parameters *law);

/* For a tank of particles. Removes all facets: there is no contact resolution. */
void tank_stop_contact(tank *t);

/* Turns on optional parts: stress correction, wall friction, turbulence, viscosity, and a few settling steps. */
void tank_add_terms(tank *t);

/* Creates the simulation of the tank. On failure returns NULL and prints the reason to stderr. */
sb_sim *tank_sim(const tank *t);
/* The same, settled. On failure prints the reason to stderr and aborts. */
sb_sim *tank_settled(const tank *t);
/* Runs the stages of a step of dt up to the neighbour lists. Returns 0, or -1 with the reason on stderr. */
int tank_prepare(sb_sim *sim, double dt);
/* Runs the stages of a step of dt up to the source of its pressure problem. Returns as
   tank_prepare. */
int tank_prepare_source(sb_sim *sim, double dt);
/* Saves the state to an archive, which the caller frees; loads it into a simulation of the same tank. */
void tank_save(const sb_sim *sim, sb_archive_out *out);
sb_status tank_load(sb_sim *sim, const sb_archive_out *out, sb_error *error);
/* Whether the steps have the stage, and whether the list of skipped parts contains the text. */
bool tank_has_stage(const sb_sim *sim, const char *name);
bool tank_skips(const sb_sim *sim, const char *text);
/* Stores the particles in another order. */
void tank_shuffle(sb_sim *sim, uint64_t seed);
/* Runs n whole steps. Returns 0, or -1 with the reason on stderr. */
int tank_steps(sb_sim *sim, int n);

#endif

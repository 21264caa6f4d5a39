/* The simulation. It is opaque: created from a scene and its model, advanced step by step, and read by snapshots and
   queries. It gives the same bits for any number of threads. */
#ifndef SB_SIM_SIM_H
#define SB_SIM_SIM_H

#include "base/archive.h"
#include "base/ranks.h"
#include "base/skipped.h"
#include "base/status.h"
#include "frame/departures.h"
#include "frame/energy.h"
#include "frame/frame.h"
#include "frame/stage_time.h"
#include "frame/step_report.h"
#include "geometry/model/model.h"
#include "offshore/maps.h"
#include "scene/scene.h"

typedef struct sb_sim sb_sim;

/* Impulse and angular impulse on one body since the start. Their difference over an interval, divided by the length of
   the interval, is the mean force. */
typedef struct sb_body_impulse {
    sb_vec3 pressure, friction; /* N s (N s/m in 2D) */
    sb_vec3 moment;             /* N m s about the body's moment point */
} sb_body_impulse;

/* Creates a simulation. scene and model must outlive it: it reads names, wave makers and, until it has settled, the
   initial velocities. The exceptions are the parts that sb_model_free_start and sb_model_free_walls free, and, after
   settling, sb_model_free_particles. ranks: those that compute the run together, which outlive it, each with the same
   scene and model; NULL: one computes it. "Together" below: all ranks call the function, in the same order and with the
   same arguments, and get the same result; with one rank it is as any other. Together. */
sb_status sb_sim_create(const sb_scene *scene, const sb_model *model, sb_ranks *ranks, sb_sim **sim, sb_error *error);
/* The speed of sound (m/s) of a run, of the scene or of its deepest water. */
double sb_sim_sound_speed(const sb_scene *scene, const sb_model *model);
/* The time step (s) for water with this maximum speed (m/s): an estimate that needs no simulation. */
double sb_sim_longest_step(const sb_scene *scene, const sb_model *model, double speed);
/* With walls that reflect water: places near which there are more facets of walls than the search for neighbours can
   hold. A run ends when water comes there. The model's boundary particles may be freed. */
typedef struct sb_crowding {
    size_t places;
    sb_vec3 first;     /* m */
    double width;      /* m, within which they are */
    int facets, edges; /* the limits */
} sb_crowding;
sb_status sb_sim_find_crowding(const sb_scene *scene, const sb_model *model, sb_crowding *found, sb_error *error);
/* SB_BAD_INPUT if the scene requires a first step that is too short for the resolution of stored positions. */
sb_status sb_sim_check_start(const sb_sim *sim, sb_error *error);
/* The same before there is a simulation, for water that starts with this maximum speed (m/s). */
sb_status sb_sim_foresee_start(const sb_scene *scene, const sb_model *model, double speed, sb_error *error);
void sb_sim_destroy(sb_sim *sim);

/* Whether the run has settling: whether settle_steps is not 0. */
bool sb_sim_settles(const sb_scene *scene);
/* Largest number of settling steps; water that is calm earlier takes fewer. */
int sb_sim_settle_most(const sb_scene *scene);
/* As many as a scene of this kind takes; about. */
int sb_sim_settle_expected(const sb_scene *scene);

/* Settling, if the scene has it: brings the water to rest with paddles at rest, holding the surface of an initial wave,
   then gives it the scene's velocities. Time stays 0. A simulation that was saved during settling continues there.
   Together. */
sb_status sb_sim_settle(sb_sim *sim, sb_error *error);
/* The same, calling `watch` after each step but the last with the steps done, the largest number of steps (which
   decreases if the water calms early), and the highest speed, m/s. The simulation may be saved in `watch`. Together,
   where each rank has its own `watch` or none. */
typedef void sb_settle_watch(void *context, int done, int most, double speed);
sb_status sb_sim_settle_watched(sb_sim *sim, sb_settle_watch *watch, void *context, sb_error *error);

/* Result of settling. */
typedef struct sb_rest {
    int steps;
    double speed;      /* m/s, the highest after the last step */
    const char *ended; /* "calm", ...: static text */
} sb_rest;
sb_rest sb_sim_rest(const sb_sim *sim);

/* Whether settling is in progress; *done: the number of settling steps done. */
bool sb_sim_settling(const sb_sim *sim, int *done);

/* Advances one step. SB_FAILED if the run has diverged: *error has step, position and reason; the state is readable.
   Together. */
sb_status sb_sim_step(sb_sim *sim, sb_error *error);

/* Starts a wave maker of the scene (an index) that waits for a command: its motion begins at the time of the report, as
   if its `start` were that time, with the same bits. SB_BAD_INPUT if it does not wait, or during settling. Together: a
   rank that is not told moves its paddle otherwise. */
sb_status sb_sim_trigger(sb_sim *sim, size_t wavemaker, sb_error *error);

const sb_step_report *sb_sim_report(const sb_sim *sim);
/* body: index into the model's bodies. All 0 if it absorbs no waves. */
sb_absorption sb_sim_absorption(const sb_sim *sim, size_t body);
/* body: index into the model's bodies. */
const sb_body_impulse *sb_sim_impulse(const sb_sim *sim, size_t body);
sb_vec3 sb_sim_body_displacement(const sb_sim *sim, size_t body);

/* Of all particles. Together. */
sb_energy sb_sim_energy(const sb_sim *sim);
/* Since t = 0. */
const sb_ledger *sb_sim_ledger(const sb_sim *sim);
const sb_crossing *sb_sim_crossing(const sb_sim *sim);
/* kg; in 2D kg/m. */
double sb_sim_particle_mass(const sb_sim *sim);
/* The depth-averaged model that gives the water at sides of kind sea; NULL: the scene has none. Its time is at or after
   that of the particles. */
const sb_offshore *sb_sim_grid(const sb_sim *sim);
/* The maps of that model since its own start; NULL: none. Their times are those of the grid. */
const sb_offshore_maps *sb_sim_grid_maps(const sb_sim *sim);

const sb_departures *sb_sim_departures(const sb_sim *sim);

/* The state hash. Together. */
uint64_t sb_sim_hash(const sb_sim *sim);

/* Saves the state between two steps as a section of an archive. The simulation does not change. Together: rank 0 writes
   the state of all, and `out` is NULL in the others. */
void sb_sim_save(const sb_sim *sim, sb_archive_out *out);
/* Loads a saved state into a simulation of the same scene and model, which then continues bit for bit like the saved
   one. Queries find no water before its next step. SB_BAD_INPUT if the section belongs to another model or has
   impossible values. Only then is the state undefined: load another state or destroy the simulation. Together: each
   rank reads the same archive, of its own. */
sb_status sb_sim_load(sb_sim *sim, sb_archive_in *in, sb_error *error);

/* Computes the virial pressures after the last step, for snapshots and queries (docs/method.md, M17a). This takes one
   pass over pairs, or none if they are known already. Without this call, snapshots and queries contain the solver
   pressure, which is noisier and in settled water a few per cent higher. The state does not change. Together. */
void sb_sim_find_virial_pressures(sb_sim *sim);

/* Makes a frame of positions, velocities, pressures and the bodies' displacements; NULL without memory. Together: rank
   0 gets the particles of all, and the frames of the others have none. */
sb_frame *sb_sim_snapshot(const sb_sim *sim);
/* The same of this rank's own particles only, with the foam in rank 0. */
sb_frame *sb_sim_snapshot_own(const sb_sim *sim);

/* Finds all fluid particles in the box [min, max], in a fixed order, for gauges and probes. Positions are in the
   scene's coordinates, m. Beyond periodic sides it finds images, with the id of their original, up to one domain length
   away and at least up to eight spacings. It writes at most `capacity` samples and returns the number found, which may
   be larger. Together: all ranks get the same samples, and none if there are more than `capacity`; SIZE_MAX: one of
   them has no memory. */
typedef struct sb_fluid_sample {
    sb_vec3 position, velocity;
    double pressure, density; /* Pa, as for sb_sim_find_virial_pressures; kg/m^3 */
    uint32_t id;
} sb_fluid_sample;
size_t sb_sim_query(const sb_sim *sim, sb_vec3 min, sb_vec3 max, sb_fluid_sample *samples, size_t capacity);

/* A force of the water on a body, as it enters the body's impulse: the sum of them all is the body's pressure force. */
typedef struct sb_wall_push {
    size_t body;
    sb_vec3 at, force; /* m, the fluid particle, moved to the original where it meets an image of the body; N */
    sb_vec3 normal;    /* unit, of a facet, if the force is along it; 0 0 0: it is not */
    sb_vec3 from;      /* m, the boundary particle; with facets the same as `at` */
} sb_wall_push;
/* A ball in which the forces on one body are recorded. */
typedef struct sb_push_place {
    size_t body;
    sb_vec3 at;   /* m */
    double range; /* m; HUGE_VAL: everywhere on the body */
} sb_push_place;
/* From the next step on, each step records the forces near these places. Replaces the places given before. The state
   does not change. Together. */
sb_status sb_sim_record_pushes(sb_sim *sim, const sb_push_place *places, size_t count, sb_error *error);
/* Those of the last step, of all ranks, in no fixed order. */
const sb_wall_push *sb_sim_pushes(const sb_sim *sim, size_t *count);

/* The ranks that compute the run together; NULL: one. */
sb_ranks *sb_sim_ranks(const sb_sim *sim);
/* The particles of this rank; sb_sim_report has the number of all. */
size_t sb_sim_owned(const sb_sim *sim);
/* How the work is divided among the ranks. */
typedef struct sb_division {
    size_t owned, halo; /* particles of this rank, and those of other ranks that it reads */
    double imbalance;   /* largest load of a rank over the mean, less 1, by pairs; counted once in several searches */
    double mean, worst; /* of all such counts of this process, without the first, when particles were divided evenly */
    uint64_t cuts;      /* how often the particles have been divided anew */
} sb_division;
sb_division sb_sim_division(const sb_sim *sim);
/* Particle i < sb_sim_owned() in storage order; i is another particle after each step. The particles of all ranks,
   one rank after another, are those that one rank would have. */
sb_fluid_sample sb_sim_particle(const sb_sim *sim, size_t i);

size_t sb_sim_stages(const sb_sim *sim, const sb_stage_time **stages);

/* The instruction set whose code runs here (static text). With another instruction set sums may round differently. */
const char *sb_sim_instructions(void);

/* The parts that the simulation skips because this scene does not need them (static text). */
const sb_skipped *sb_sim_skipped(const sb_sim *sim);

/* Heap bytes held. */
size_t sb_sim_bytes(const sb_sim *sim);

#endif

/* The simulation: opaque, made from a scene and its model, advanced step by step, read by snapshots
   and queries. Same bits for any number of threads. */
#ifndef SB_SIM_SIM_H
#define SB_SIM_SIM_H

#include "base/archive.h"
#include "base/skipped.h"
#include "base/status.h"
#include "frame/frame.h"
#include "geometry/model.h"
#include "scene/scene.h"

typedef struct sb_sim sb_sim;

/* What the last step did. */
typedef struct sb_step_report {
    uint64_t step;          /* steps done so far */
    double time, time_step; /* s: time reached, and the step that led there; 0 at the start */
    int iterations;
    bool capped;                                /* the solve stopped at max_iterations above its tolerance */
    double tolerance;                           /* relative density error asked for */
    double error_mean, error_active, error_max; /* relative: over all, over p > 0, worst */
    double compression, compression_max; /* where the step began, relative: mean of what is above the rest density,
                                            and the worst */
    double max_speed;                    /* m/s */
    size_t fluid_count;
    uint64_t left_domain;      /* particles that left through open sides so far */
    uint64_t lost;             /* particles that passed a wall side of the domain so far */
    double momentum_imbalance; /* of this step: |sum m a + sum F on bodies - M g| / sum m |a| */
} sb_step_report;

/* Impulse and angular impulse on one body since the start: differences over an interval, divided by
   its length, are the interval's mean force. */
typedef struct sb_body_impulse {
    sb_vec3 pressure, friction; /* N s (N s/m in 2D) */
    sb_vec3 moment;             /* N m s about the body's moment point */
} sb_body_impulse;

/* Copies what it needs; scene and model must outlive it all the same (names, wave makers, velocities until it has
   settled), but for what sb_model_forget_start, and sb_model_forget_particles once it has settled, take away. */
sb_status sb_sim_create(const sb_scene *scene, const sb_model *model, sb_sim **sim, sb_error *error);
/* The step, in s, in which water of this top speed (m/s) would be advanced: for an estimate before there is a
   simulation. */
double sb_sim_longest_step(const sb_scene *scene, const sb_model *model, double speed);
/* SB_BAD_INPUT when the scene asks for first steps so short that positions could not show them. */
sb_status sb_sim_check_start(const sb_sim *sim, sb_error *error);
void sb_sim_destroy(sb_sim *sim);

/* Whether the water comes to rest before t = 0: where settle_steps is not 0. */
bool sb_sim_settles(const sb_scene *scene);
/* Its steps at most; water that is calm sooner takes fewer. */
int sb_sim_settle_most(const sb_scene *scene);

/* Brings the water to rest with paddles at rest, where the scene settles, an initial wave's surface kept up; then
   gives it the scene's velocities. Time stays 0. A simulation that was saved meanwhile goes on where it was. */
sb_status sb_sim_settle(sb_sim *sim, sb_error *error);
/* The same, calling `watch` after each step but the last: how many are done, the most there may be (it is less where
   the water calms early), and the highest speed, m/s. The state is one between two steps and may be saved. */
typedef void sb_settle_watch(void *context, int done, int most, double speed);
sb_status sb_sim_settle_watched(sb_sim *sim, sb_settle_watch *watch, void *context, sb_error *error);

/* How settling ended. */
typedef struct sb_rest {
    int steps;
    double speed;      /* m/s, the highest after its last step */
    const char *ended; /* "calm", ...: static text */
} sb_rest;
sb_rest sb_sim_rest(const sb_sim *sim);

/* Whether settling has begun and is not over; *done: the steps that it has taken. */
bool sb_sim_settling(const sb_sim *sim, int *done);

/* One step. SB_FAILED when it diverged: step, place and reason in *error; the state stays readable. */
sb_status sb_sim_step(sb_sim *sim, sb_error *error);

const sb_step_report *sb_sim_report(const sb_sim *sim);
/* body: index into the model's bodies. */
const sb_body_impulse *sb_sim_impulse(const sb_sim *sim, size_t body);
sb_vec3 sb_sim_body_displacement(const sb_sim *sim, size_t body);

/* Kinetic and potential energy (J, potential from z = domain min), momentum (kg m/s), mass (kg). */
typedef struct sb_energy {
    double kinetic, potential, mass;
    sb_vec3 momentum;
} sb_energy;
sb_energy sb_sim_energy(const sb_sim *sim);

/* What changed the water's kinetic + potential energy since the start, settling left out; J (J/m in 2D).
   Each is an addition to it, so a loss is negative; their sum is the change, to round-off. */
typedef struct sb_ledger {
    double bodies;      /* work of moving bodies on the water */
    double viscosity;   /* artificial, physical and of eddies */
    double friction;    /* at walls */
    double pressure;    /* of the solve: nothing physical, for water at constant density stores none */
    double contact;     /* drops stopped at walls */
    double integration; /* weight times fall, less what gravity gave: the update's own error */
    double left;        /* carried away by particles that left */
    double stress;      /* of what takes the packing's own stress away */
} sb_ledger;
const sb_ledger *sb_sim_ledger(const sb_sim *sim);

/* Particles that are no longer there: how many by the domain's side that they went through, open or wall, and the
   first few of them, in the order of the steps. Those that left before t = 0, while the water came to rest, are among
   them. */
enum { SB_DEPARTURES = 8 };
typedef struct sb_departure {
    double time;      /* s */
    sb_vec3 position; /* m, the first place that was outside */
    double speed;     /* m/s */
    uint32_t particle;
    int side;
    bool lost; /* through a wall side */
} sb_departure;
typedef struct sb_departures {
    uint64_t by_side[SB_SIDES];
    size_t count;
    sb_departure first[SB_DEPARTURES];
} sb_departures;
const sb_departures *sb_sim_departures(const sb_sim *sim);

/* A hash of the complete state. */
uint64_t sb_sim_hash(const sb_sim *sim);

/* The state between two steps, as a section of an archive. Saving changes nothing. */
void sb_sim_save(const sb_sim *sim, sb_archive_out *out);
/* Into a simulation of the same scene and model, which then goes on as the saved one did, bit for bit; queries find
   no water before its next step. SB_BAD_INPUT when the section is not of this model or makes no
   sense: then, and only then, the state is none, and to be loaded again or destroyed. */
sb_status sb_sim_load(sb_sim *sim, sb_archive_in *in, sb_error *error);

/* Finds the pressures that water bears, after the last step, for snapshots and queries to tell (a pass over pairs, none
   when they are known; docs/method.md, M17a). Without it they tell the solve's own, which are rougher
   and, settled water being no lattice, a few per cent higher. The state does not change. */
void sb_sim_find_virial_pressures(sb_sim *sim);

/* A frame of positions, velocities and pressures, bodies' displacements filled; NULL without memory. */
sb_frame *sb_sim_snapshot(const sb_sim *sim);

/* All fluid particles in the box [min, max], in a fixed order, for gauges and probes. Positions in
   scene metres. Beyond periodic sides there are images, with the id of their particle, up to a domain's length
   away and to eight spacings at least. At most `capacity` are written; the number found is returned (may be larger). */
typedef struct sb_fluid_sample {
    sb_vec3 position, velocity;
    double pressure, density; /* Pa, as for sb_sim_find_virial_pressures; kg/m^3 */
    uint32_t id;
    double push; /* q = p/rho^2 of the solve: times psi grad W, the acceleration by a boundary particle */
} sb_fluid_sample;
size_t sb_sim_query(const sb_sim *sim, sb_vec3 min, sb_vec3 max, sb_fluid_sample *samples, size_t capacity);

/* Particle i of sb_sim_report()->fluid_count, storage order; i changes meaning from step to step. */
sb_fluid_sample sb_sim_particle(const sb_sim *sim, size_t i);

enum { SB_STAGES_MAX = 16 };

/* Seconds and calls of each stage in this process, settling's steps among them, for the stage table. */
typedef struct sb_stage_time {
    const char *name;
    double seconds;
    uint64_t calls;
} sb_stage_time;
size_t sb_sim_stages(const sb_sim *sim, const sb_stage_time **stages);

/* The instruction set whose code runs here, static text: with another one sums may round otherwise. */
const char *sb_sim_instructions(void);

/* What this scene made the simulation skip (static text). */
const sb_skipped *sb_sim_skipped(const sb_sim *sim);

/* Heap bytes held. */
size_t sb_sim_bytes(const sb_sim *sim);

#endif

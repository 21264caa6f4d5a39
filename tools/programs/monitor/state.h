/* The state of a run as the monitor knows it from the messages received so far. */
#ifndef SB_MONITOR_STATE_H
#define SB_MONITOR_STATE_H

#include "stream/assembly.h"
#include "stream/listen.h"

enum { SB_MONITOR_BODIES = 512, SB_MONITOR_SAMPLES = 16 };

typedef struct sb_monitor_body {
    char name[SB_STREAM_NAME];
    bool reported;
    double force[3];   /* N */
    double horizontal; /* N, sqrt(Fx^2 + Fy^2) */
    double peak;       /* N, largest horizontal force so far */
} sb_monitor_body;

typedef struct sb_monitor_state {
    bool has_status;
    sb_status_message status;
    uint64_t statuses;   /* number of statuses received from this run */
    size_t body_count;   /* rows in use */
    size_t bodies_total; /* number of bodies of the run, which may exceed SB_MONITOR_BODIES */
    sb_monitor_body bodies[SB_MONITOR_BODIES];
    double peak;           /* N, largest horizontal force on any reported body so far */
    double peak_component; /* N, largest magnitude of any force component of a reported body so far */
    sb_assembly assembly;
    double started, last_data; /* s, sb_clock() */
    /* Counters at several times within the last seconds, for the rates. */
    struct {
        double time;
        sb_listener_counters count;
    } samples[SB_MONITOR_SAMPLES];
    size_t sample_count;
    double message_rate, byte_rate; /* per second */
    sb_listener_counters count;
} sb_monitor_state;

/* Clears the state and frees its memory. */
void sb_monitor_state_start(sb_monitor_state *state, double now);
void sb_monitor_state_free(sb_monitor_state *state);

/* Callbacks for a listener; user is the state. A new run (another name, or a step that goes back) clears peaks, bodies
   and chunk counts. */
void sb_monitor_on_status(void *user, const sb_status_message *message);
void sb_monitor_on_forces(void *user, const sb_forces_message *message);
void sb_monitor_on_particles(void *user, const sb_particles_message *message);

/* Updates the rates, which are means over the last 2 s, with new counters. To be called several times per second. */
void sb_monitor_state_sample(sb_monitor_state *state, sb_listener_counters count, double now);

#endif

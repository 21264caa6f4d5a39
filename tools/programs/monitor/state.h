/* The state of a run as the monitor knows it from the messages received so far. */
#ifndef SB_MONITOR_STATE_H
#define SB_MONITOR_STATE_H

#include "stream/live.h"

enum { SB_MONITOR_BODIES = 512, SB_MONITOR_SAMPLES = 16 };

typedef struct sb_monitor_body {
    char name[SB_STREAM_NAME];
    double force[3];   /* N, mean over the last interval */
    double horizontal; /* N, sqrt(Fx^2 + Fy^2) */
    double peak;       /* N, largest horizontal force so far */
} sb_monitor_body;

typedef struct sb_monitor_state {
    bool has_status;
    sb_status_message status;
    uint64_t statuses;   /* number of statuses received from this run */
    size_t body_count;   /* rows in use */
    size_t bodies_total; /* number of reported bodies of the run, which may exceed SB_MONITOR_BODIES */
    sb_monitor_body bodies[SB_MONITOR_BODIES];
    double peak;               /* N, largest horizontal force on any reported body so far */
    double peak_component;     /* N, largest magnitude of any force component of a reported body so far */
    double frame_time;         /* s, of the newest complete frame */
    int64_t frame_particles;   /* in it */
    double started, last_data; /* s, sb_clock() */
    /* Counters at several times within the last seconds, for the rates. */
    struct {
        double time;
        sb_live_counts count;
    } samples[SB_MONITOR_SAMPLES];
    size_t sample_count;
    double message_rate, byte_rate; /* per second */
    sb_live_counts count;
} sb_monitor_state;

/* Clears the state. */
void sb_monitor_state_start(sb_monitor_state *state, double now);

/* Callbacks of sb_live; user is the state. Another run clears bodies and peaks. */
void sb_monitor_on_restart(void *user, int64_t run_id);
void sb_monitor_on_status(void *user, const sb_status_message *message);
void sb_monitor_on_forces(void *user, const sb_forces_message *message);
void sb_monitor_on_part(void *user, const sb_frame_message *message);
void sb_monitor_on_frame(void *user, const sb_live_frame *frame);

/* Updates the rates, which are means over the last 2 s, with new counters. To be called several times per second. */
void sb_monitor_state_sample(sb_monitor_state *state, sb_live_counts count, double now);

#endif

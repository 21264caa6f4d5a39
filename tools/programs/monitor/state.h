/* The state of a run as the monitor knows it from the messages received so far. */
#ifndef SB_MONITOR_STATE_H
#define SB_MONITOR_STATE_H

#include "history.h"

#include "stream/live.h"

#define SB_MONITOR_SILENCE 3.0 /* s without data after which the user is informed; the run sends twice per second */

enum { SB_MONITOR_ROWS = 512, SB_MONITOR_SAMPLES = 16 };

typedef struct sb_monitor_body {
    char name[SB_STREAM_NAME];
    double force[3];        /* N, mean over the last interval */
    double horizontal;      /* N, sqrt(Fx^2 + Fy^2) */
    double peak, peak_time; /* N, largest horizontal force so far; s, when it was */
    sb_history course;      /* N, of the horizontal force */
} sb_monitor_body;

typedef struct sb_monitor_gauge {
    char name[SB_STREAM_NAME];
    bool wet, seen;           /* seen: it has been wet */
    double eta, z;            /* m above still water; m, absolute */
    double eta_low, eta_high; /* m, so far */
    sb_history course;        /* m, eta while it is wet */
} sb_monitor_gauge;

/* What describes the convergence of a run, from one status to the next. */
typedef enum sb_monitor_quantity {
    SB_QUANTITY_ITERATIONS,
    SB_QUANTITY_ERROR, /* mean relative density error */
    SB_QUANTITY_ERROR_MAX,
    SB_QUANTITY_TIME_STEP, /* s */
    SB_QUANTITY_SPEED,     /* m/s, the largest */
    SB_QUANTITIES
} sb_monitor_quantity;

typedef struct sb_monitor_state {
    bool has_status;
    sb_status_message status;
    uint64_t statuses; /* number of statuses received from this run */
    double value[SB_QUANTITIES], highest[SB_QUANTITIES];
    sb_history course[SB_QUANTITIES];
    double stage_step[SB_STREAM_STAGES]; /* s per step between the last two statuses; negative: unknown */

    /* Rows that are in use; rows of the run, which may be more than SB_MONITOR_ROWS. */
    size_t body_count, bodies_total, gauge_count, gauges_total;
    sb_monitor_body bodies[SB_MONITOR_ROWS];
    sb_monitor_gauge gauges[SB_MONITOR_ROWS];
    double peak;                /* N, largest force or component on any reported body so far */
    bool has_forces, per_metre; /* per_metre: a run in two dimensions */
    double forces_since;        /* s, simulated: the first forces that were received */

    double frame_time;       /* s, of the newest complete frame */
    int64_t frame_particles; /* in it */
    bool has_frame;
    unsigned receiver_restarts; /* after crashes by messages from the network */
    double started, last_data;  /* s, sb_clock() */
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

/* Callbacks of sb_live; user is the state. Another run clears all that belongs to the earlier one. */
void sb_monitor_on_restart(void *user, int64_t run_id);
void sb_monitor_on_scene(void *user, const sb_live_scene *scene);
void sb_monitor_on_status(void *user, const sb_status_message *message);
void sb_monitor_on_forces(void *user, const sb_forces_message *message);
void sb_monitor_on_gauges(void *user, const sb_gauges_message *message);
void sb_monitor_on_part(void *user, const sb_frame_message *message);
void sb_monitor_on_frame(void *user, const sb_live_frame *frame);

/* Updates the rates, which are means over the last 2 s, with new counters. To be called several times per second. */
void sb_monitor_state_sample(sb_monitor_state *state, sb_live_counts count, double now);

/* The share of the run's messages that was lost, 0 to 1. */
double sb_monitor_state_lost(const sb_monitor_state *state);

/* The share of the run's duration that has been simulated, 0 to 1. */
double sb_monitor_state_progress(const sb_monitor_state *state);

#endif

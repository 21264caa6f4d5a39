/* The state of the measurements. Private to src/measure. */
#ifndef SB_MEASURE_STATE_H
#define SB_MEASURE_STATE_H

#include "measure/loads.h"
#include "measure/measure.h"
#include "measure/parts.h"

/* A growing list of records. */
typedef struct list {
    void *items;
    size_t count, capacity;
} list;

enum { FORCES, GAUGES, PROBES, FLOWS, RUNUPS, ENERGIES, REFLECTIONS, WATERS, ABSORBERS, LISTS };

/* Impulses at the creation, at the last multiple of the interval and at the last step's end. */
typedef struct body_state {
    sb_body_impulse start, boundary, last;
    sb_footprint footprint;
    bool faces; /* whether the depth of the flow towards the body is measured */
    sb_approach approach;
} body_state;

typedef struct plane_state {
    double boundary, last, now;
} plane_state; /* m^3 passed so far */

/* Pa s since the creation, at the last multiple of the interval, at the last step's end and after this step. */
typedef struct probe_state {
    double boundary, last, now;
} probe_state;

/* A gauge over all rows: whether it ever had a value, and the greatest depth while it had none, m. */
typedef struct gauge_state {
    bool had_value;
    double deepest;
} gauge_state;

/* A set of gauges: sums of each gauge's fit in the window that began at `from`, and since the set's start up to `last`.
 */
typedef struct split_state {
    double from, last; /* s */
    double *window, *whole;
} split_state;

/* See plane_records.c. */
typedef struct sb_plane_record sb_plane_record;

enum { MAX_SKIPPED = 8 };

struct sb_measurements {
    const sb_scene *scene;
    const sb_model *model;
    double interval, time;     /* s; time: of the last step's end */
    double momentum_imbalance; /* largest value of any step since the last row */
    uint64_t next;             /* the next row lies at next * interval */
    body_state *states;
    sb_body_record *bodies;
    plane_state *planes;
    sb_plane_counter **counters;
    sb_plane_record **records; /* one per plane, NULL for planes without; NULL: no plane has one */
    sb_floors *floors;         /* one per gauge */
    gauge_state *gauges;
    sb_shore *shores;   /* one per run-up line */
    sb_patch **patches; /* one per probe */
    probe_state *probes;
    split_state *splits;              /* one per set of measure.reflections */
    size_t split_count;               /* rows of all sets */
    sb_reflection_record *split_rows; /* scratch: of one window of each set */
    sb_map_field *map;
    sb_loads *loads; /* NULL: no picture shows them */
    sb_cloud cloud;
    list lists[LISTS];
    sb_measure_records latest;
    sb_skipped skipped[MAX_SKIPPED + 1];
};

/* wall_probes.c: makes the simulation record the forces on the patches, and those on the faces of bodies. */
sb_status sb_wall_probes_start(const sb_measure *measure, sb_sim *sim, sb_error *error);
/* Adds the forces of the last step, which took `taken` s. */
void sb_wall_probes_step(sb_measure *measure, const sb_sim *sim, double taken);
/* Returns the mean pressure of the interval that ends at this fraction of the last step, and begins the next one. */
double sb_wall_probe_mean(sb_measure *measure, size_t probe, double fraction);

/* records.c: the lists of records. Those of the creation: */
sb_status sb_records_start(sb_measure *measure, const sb_measure_view *view, sb_error *error);
/* Those of an interval that ends at `time`, at this fraction of the last step. */
sb_status sb_records_interval(sb_measure *measure, const sb_measure_view *view, double time, double fraction,
                              sb_error *error);
/* Those that only the end of a step has. */
sb_status sb_records_step(sb_measure *measure, const sb_measure_view *view, sb_error *error);
void sb_records_clear(sb_measure *measure);
/* Makes the lists those that sb_measure_latest returns. */
void sb_records_publish(sb_measure *measure);
void sb_records_free(sb_measure *measure);
size_t sb_records_bytes(const sb_measure *measure);

/* plane_records.c: the points of the planes that are recorded. */
sb_status sb_plane_records_create(sb_measure *measure, sb_error *error);
void sb_plane_records_destroy(sb_measure *measure);
/* The number of points that a plane records in this row; rows are multiples of the interval. */
size_t sb_plane_records_points(const sb_measure *measure, size_t plane, uint64_t row);
/* Reads one of these points. */
sb_status sb_plane_records_read(const sb_measure *measure, const sb_measure_view *view, size_t plane, size_t index,
                                double time, sb_water_record *row, sb_error *error);

/* reflections.c: the states of all sets. */
sb_status sb_reflections_create(sb_measure *measure, sb_error *error);
void sb_reflections_destroy(sb_measure *measure);
size_t sb_reflections_bytes(const sb_measure *measure);
/* Adds the row of all gauges at `time` to a set. *rows: those of the window that ended, one per harmonic; or NULL. */
sb_status sb_reflections_add(sb_measure *measure, size_t set, const sb_gauge_record *gauges, double time,
                             const sb_reflection_record **rows, sb_error *error);
void sb_reflections_save(const sb_measure *measure, sb_archive_out *out);
void sb_reflections_load(sb_measure *measure, sb_archive_in *in);

#endif

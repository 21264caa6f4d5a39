/* Reads the simulation after each step and turns what it sees into records. Knows no files.
   What the scene does not ask for costs nothing. Reads only: the run's bits do not change. */
#ifndef SB_MEASURE_MEASURE_H
#define SB_MEASURE_MEASURE_H

#include "measure/records.h"
#include "sim/sim.h"

typedef struct sb_measurements sb_measure; /* scene.h holds the tag of the shorter name */

/* Call after settling: impulses count from here, and instant records of this time (gauges, probes,
   run-up, planes, energy) are ready in sb_measure_latest. scene and model must outlive it. */
sb_status sb_measure_create(const sb_scene *scene, const sb_model *model, const sb_sim *sim, sb_measure **measure,
                            sb_error *error);
void sb_measure_destroy(sb_measure *measure);

/* Whether the next sb_measure_step reads pressures: sb_sim_find_virial_pressures is to come before it. */
bool sb_measure_reads_pressures(const sb_measure *measure, const sb_sim *sim);
/* Call after every step. A step that crosses multiples of the interval is split in proportion:
   force and velocity are constant within it, so rows lie on exact multiples. Fails only without
   memory. */
sb_status sb_measure_step(sb_measure *measure, const sb_sim *sim, sb_error *error);

/* What was measured so far and is in progress, as a section of an archive; called between steps. */
void sb_measure_save(const sb_measure *measure, sb_archive_out *out);
/* Into measurements of the same scene and model, which then go on as the saved ones; nothing is in
   sb_measure_latest. SB_BAD_INPUT when the section is of others or makes no sense: then, and only then, what was
   measured is lost, and to be loaded again or destroyed. */
sb_status sb_measure_load(sb_measure *measure, sb_archive_in *in, sb_error *error);

/* What the last sb_measure_step (or the creation) brought; valid until the next. */
const sb_measure_records *sb_measure_latest(const sb_measure *measure);

/* One per body of the model, up to now. */
const sb_body_record *sb_measure_bodies(const sb_measure *measure);

/* The map so far, or NULL when the scene has none. */
const sb_map_record *sb_measure_map(const sb_measure *measure);

/* Of a gauge that had no value in any row so far: the depth of the deepest water there, m; else 0. */
double sb_measure_gauge_missed(const sb_measure *measure, size_t gauge);

/* Puts the last interval's mean force and moment into the bodies of a frame of this model. */
void sb_measure_fill_frame(const sb_measure *measure, sb_frame *frame);

/* What the scene made this part skip (static text). */
const sb_skipped *sb_measure_skipped(const sb_measure *measure);

/* Heap bytes held. */
size_t sb_measure_bytes(const sb_measure *measure);

#endif

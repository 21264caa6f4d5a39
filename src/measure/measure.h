/* Reads the simulation after each step and makes records of forces, gauges, probes, planes, run-up lines, energies and
   maps. Writes no files. What the scene does not request costs nothing. Reading does not change a bit of the run. */
#ifndef SB_MEASURE_MEASURE_H
#define SB_MEASURE_MEASURE_H

#include "frame/records.h"
#include "sim/sim.h"

typedef struct sb_measurements sb_measure; /* scene.h already has a struct with the tag sb_measure */

/* The places near which measurements read boundary particles, for a model of which each rank has a part. The caller
   frees *places. SB_FAILED without memory. */
sb_status sb_measure_places(const sb_scene *scene, sb_model_place **places, size_t *count, sb_error *error);

/* Finds what measurements need of the model's boundary particles, which may be freed afterwards (sb_model_free_walls).
   scene and model must outlive *measure, which sb_measure_start completes; until then it can only be destroyed. */
sb_status sb_measure_prepare(const sb_scene *scene, const sb_model *model, sb_measure **measure, sb_error *error);
/* Call after settling. Impulses are summed from this time on. The instant records of this time (gauges, probes, run-up,
   planes, energy) are ready in sb_measure_latest. On error the measurements can only be destroyed. */
sb_status sb_measure_start(sb_measure *measure, sb_sim *sim, sb_error *error);
/* Both at once. */
sb_status sb_measure_create(const sb_scene *scene, const sb_model *model, sb_sim *sim, sb_measure **measure,
                            sb_error *error);
void sb_measure_destroy(sb_measure *measure);

/* Whether the next sb_measure_step reads pressures. If so, call sb_sim_find_virial_pressures before it. */
bool sb_measure_reads_pressures(const sb_measure *measure, const sb_sim *sim);
/* Call after every step. A step that crosses multiples of the interval is split in proportion, because force and
   velocity are constant within a step; rows lie on exact multiples. Fails only without memory. */
sb_status sb_measure_step(sb_measure *measure, const sb_sim *sim, sb_error *error);

/* Saves what was measured so far, and the interval in progress, as a section of an archive. Call between steps. */
void sb_measure_save(const sb_measure *measure, sb_archive_out *out);
/* Loads such a section into measurements of the same scene and model, which then continue the saved ones;
   sb_measure_latest is empty. SB_BAD_INPUT when the section belongs to other measurements or is invalid. Then, and only
   then, the measurements are undefined: load again or destroy them. */
sb_status sb_measure_load(sb_measure *measure, sb_archive_in *in, sb_error *error);

/* The records of the last sb_measure_step (or of the creation); valid until the next step. */
const sb_measure_records *sb_measure_latest(const sb_measure *measure);

/* The records of all bodies of the model up to now. */
const sb_body_record *sb_measure_bodies(const sb_measure *measure);

/* The map so far, or NULL when the scene has none. */
const sb_map_record *sb_measure_map(const sb_measure *measure);

/* Finds the rows of all sets of measure.reflections over the whole time since their start. The rows are valid until the
   next step. SB_FAILED without memory. */
sb_status sb_measure_reflections(sb_measure *measure, const sb_reflection_record **rows, size_t *count,
                                 sb_error *error);

/* For a gauge that had no value in any row so far: the greatest depth of the water there, m. Otherwise 0. */
double sb_measure_gauge_missed(const sb_measure *measure, size_t gauge);

/* With render.loads: the mean forces of the last finished interval on the faces of bodies that are neither terrain nor
   move, numbered as by sb_faces_make. Those of a body sum to the pressure part of its force record. *count: 0 before
   the end of the first interval, and without render.loads. Valid until the next step. */
const sb_face_load *sb_measure_faces(const sb_measure *measure, size_t *count);

/* Copies the mean force and moment of the last interval into the bodies of a frame of this model, and adds the loads of
   faces if they are known. Fails only without memory. */
sb_status sb_measure_fill_frame(const sb_measure *measure, sb_frame *frame, sb_error *error);

/* Measurements that this scene does not need (static text). */
const sb_skipped *sb_measure_skipped(const sb_measure *measure);

/* Heap bytes per cell of a map, besides its values and sums, in a domain of this height (m). */
double sb_measure_cell_bytes(double height, double spacing);

/* Heap bytes held. */
size_t sb_measure_bytes(const sb_measure *measure);

#endif

/* The forces of the water on the faces of bodies, as means over the interval. Private to src/measure. */
#ifndef SB_MEASURE_LOADS_H
#define SB_MEASURE_LOADS_H

#include "base/archive.h"
#include "frame/frame.h"
#include "frame/records.h"
#include "sim/sim.h"

typedef struct sb_loads sb_loads;

sb_status sb_loads_create(const sb_scene *scene, const sb_model *model, sb_loads **loads, sb_error *error);
void sb_loads_destroy(sb_loads *loads);
size_t sb_loads_bytes(const sb_loads *loads);

/* Where the simulation must record forces: at most one place per body of the model. Returns their number. */
size_t sb_loads_places(const sb_loads *loads, sb_push_place *places);

/* Adds the forces of the last step, which took `taken` s, each to the face on which it acts. */
sb_status sb_loads_step(sb_loads *loads, const sb_wall_push *pushes, size_t count, double taken, sb_error *error);
/* Ends the interval (s) at this fraction of the last step, and begins the next one. */
void sb_loads_boundary(sb_loads *loads, double fraction, double interval);
/* Ends the step. */
void sb_loads_advance(sb_loads *loads);

/* The mean forces of the last finished interval; *count: 0 before the end of the first one. */
const sb_face_load *sb_loads_rows(const sb_loads *loads, size_t *count);
/* Adds the mean pressures to a frame, if an interval has finished. */
sb_status sb_loads_fill_frame(const sb_loads *loads, sb_frame *frame, sb_error *error);

void sb_loads_save(const sb_loads *loads, sb_archive_out *out);
void sb_loads_load(sb_loads *loads, sb_archive_in *in);

#endif

/* A coast for measuring pictures, made without a simulation: ground, buildings, and the water of a wave on it. */
#ifndef SB_BENCH_COAST_H
#define SB_BENCH_COAST_H

#include "frame/frame.h"
#include "geometry/model/model.h"

/* Makes the bodies of the model, which sb_model_free frees: a ground of `triangles` triangles and 49 buildings, in the
   domain of the scene. What only a simulation needs is missing. */
sb_status sb_bench_coast_model(const sb_scene *scene, size_t triangles, sb_model *model, sb_error *error);

/* Makes a frame with about `particles` particles: a wave of 8 m before the shore, a bore between the buildings, and
   every 40th particle near the surface of the bore up to 12 m above it; foam has a twentieth of that number. The caller
   releases it. */
sb_status sb_bench_coast_frame(const sb_scene *scene, size_t particles, sb_frame **frame, sb_error *error);

#endif

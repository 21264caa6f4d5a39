/* The depth-averaged water beside the particles in pictures. */
#ifndef SB_APP_GRID_PICTURE_H
#define SB_APP_GRID_PICTURE_H

#include "frame/frame.h"
#include "scene/scene.h"
#include "sim/sim.h"

/* Layers of particles below the surface: more than a ray sees of the water. Pictures of depths and slices have all. */
enum { SB_GRID_PICTURE_LAYERS = 20 };

/* Water of the grid over a column: dry unless surface > bed. */
typedef struct sb_grid_column {
    double bed, surface, u, v; /* m; m/s, means over the depth */
} sb_grid_column;

/* Where the water comes from: the grid of a run, or a file of it. */
typedef struct sb_grid_source {
    void (*at)(const void *state, double time, double x, double y, sb_grid_column *out);
    const void *state;
} sb_grid_source;

/* Adds the grid's water outside of the domain to a frame that is not published yet, at the frame's time, as particles
   on a lattice of the frame's spacing: pictures then show it like the other water. Does nothing without a grid.
   SB_FAILED without memory. */
sb_status sb_grid_picture_add(const sb_sim *sim, const sb_scene *scene, sb_frame *frame, sb_error *error);

/* The same with the water of a source, at the frame's time less sea.start. */
sb_status sb_grid_picture_from(const sb_grid_source *source, const sb_scene *scene, sb_frame *frame, sb_error *error);

/* The same with the water of grid/NNNNNN.vti of a run, NNNNNN = number. SB_BAD_INPUT: it is missing or damaged, or its
   time is not that of the frame; the frame is then as before. Does nothing if the scene has no grid beside particles.
 */
sb_status sb_grid_picture_read(const char *run, size_t number, const sb_scene *scene, sb_frame *frame, sb_error *error);

#endif

/* The depth-averaged water beside the particles in pictures. */
#ifndef SB_APP_GRID_PICTURE_H
#define SB_APP_GRID_PICTURE_H

#include "frame/frame.h"
#include "scene/scene.h"
#include "sim/sim.h"

/* Layers of particles below the surface: more than a ray sees of the water. Pictures of depths and slices have all. */
enum { SB_GRID_PICTURE_LAYERS = 20 };

/* Adds the grid's water outside of the domain to a frame that is not published yet, at the frame's time, as particles
   on a lattice of the frame's spacing: pictures then show it like the other water. Does nothing without a grid.
   SB_FAILED without memory. */
sb_status sb_grid_picture_add(const sb_sim *sim, const sb_scene *scene, sb_frame *frame, sb_error *error);

#endif

/* The outermost water of each cell of a grid, as seen along an axis: for the water's shadows (seen from the sun) and
   for the highest water so far (seen from above). Without OpenGL, so that it can outlive a renderer. */
#ifndef SB_RENDER_TOPS_H
#define SB_RENDER_TOPS_H

#include "frame/frame.h"
#include "render/water/density.h"

/* A zeroed struct is empty. */
typedef struct sb_tops {
    int side;   /* cells on each side */
    float *top; /* row by row; SB_TOPS_DRY where there has been no water */
    float *now; /* the same of one frame; NULL until sb_tops_add_areas needs it */
} sb_tops;

#define SB_TOPS_DRY (-1e30f)

/* GLSL: float above(sampler2D map, vec2 at, float height): the fraction 0..1 of the map around `at` (0..1) whose value
   is above `height`. float shading(sampler2D map, vec2 at, float height, float bias): the same, but a value counts in
   part from half of `bias` above the height on, and whole from three times `bias` on: water that is hardly behind other
   water would have a shadow with the steps of the map's cells. */
extern const char sb_tops_source[];

/* Makes an empty map. A zeroed sb_tops may be freed. */
sb_status sb_tops_create(int side, sb_tops *tops, sb_error *error);
void sb_tops_free(sb_tops *tops);

/* Forgets all water. */
void sb_tops_clear(sb_tops *tops);

/* Raises the cells to the frame's water. map: the rows of a matrix from positions relative to the frame's origin to
   column and row of the grid, 0..1, and to height. Particles with a density below `least` are left out: single drops.
 */
void sb_tops_add(sb_tops *tops, const sb_frame *frame, const sb_density *density, float least, float map[3][4]);

/* The same, but only with cells in a block of 2 x 2 that all have water of this frame. Single particles and rows of
   them leave nothing, along whatever track. */
sb_status sb_tops_add_areas(sb_tops *tops, const sb_frame *frame, const sb_density *density, float least,
                            float map[3][4], sb_error *error);

#endif

/* Cross-sections of the solid bodies in a plane. */
#ifndef SB_RENDER_SECTION_H
#define SB_RENDER_SECTION_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "render/slice/plane.h"

/* Copies of the bodies' triangles: the model need not outlive them. A zeroed struct is empty. */
typedef struct sb_solids {
    size_t count;
    struct sb_solid *list;
    sb_vec3 (*corners)[3]; /* m, scene, at t = 0; of all triangles, counter-clockwise seen from outside */
} sb_solids;

sb_status sb_solids_create(const sb_model *model, sb_solids *solids, sb_error *error);
void sb_solids_free(sb_solids *solids);

/* A piece of a body's outline in the plane, from one end to the other; the solid is on its left seen from the eye. */
typedef struct sb_section_piece {
    double end[2][2];
} sb_section_piece;

/* Kept from picture to picture, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_section {
    size_t count, capacity;
    sb_section_piece *pieces; /* by bodies */
    size_t body_capacity;
    size_t *first; /* piece of each body, and the number of pieces after the last one */
} sb_section;

/* Intersects the bodies, displaced as in the frame, with the plane. */
sb_status sb_section_cut(sb_section *section, const sb_solids *solids, const sb_plane *plane, const sb_frame *frame,
                         sb_error *error);
void sb_section_free(sb_section *section);

/* Finds both ends of a piece in a map, of which it cuts off what has no image. False: nothing remains. */
bool sb_section_project(const sb_section_piece *piece, const sb_plane_map *map, double out[2][2]);

/* Writes the share of each cell of a raster that is solid, 0..1, row by row: of the terrain within `area`, and of the
   other closed bodies. to_raster: from the plane to cells. Surfaces without an inside are left out, but for the
   terrain, which is solid below. terrain and bodies may be the same array, which then has both. */
sb_status sb_section_fill(const sb_section *section, const sb_solids *solids, const sb_plane *plane,
                          const sb_plane_area *area, const sb_plane_map *to_raster, int width, int height,
                          float *terrain, float *bodies, sb_error *error);

#endif

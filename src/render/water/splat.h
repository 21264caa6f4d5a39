/* Draws surface elements into a depth picture without OpenGL, whose cost per vertex is higher. */
#ifndef SB_RENDER_SPLAT_H
#define SB_RENDER_SPLAT_H

#include "render/water/surfels.h"

/* Pictures of the water: 4 floats per pixel, rows from the bottom up.
   surface: depth in m along the view (0: no water), value 0..1, x and y of the normal along the camera's axes.
   cover: how much of the pixel the surface covers, 0..1; thickness in m; opacity of drops, 0..1; their depth in m. */
typedef struct sb_splat {
    int width, height;
    float *surface, *cover;
    size_t bin_capacity, first_capacity;
    uint32_t *bins;
    size_t *first;
} sb_splat;

/* Allocates the pictures. A zeroed sb_splat may be freed. */
sb_status sb_splat_create(int width, int height, sb_splat *splat, sb_error *error);
void sb_splat_free(sb_splat *splat);

/* Draws all elements and blends those that are within about a spacing of the first surface along the ray. spacing: m.
   The result is the same for any number of threads. */
sb_status sb_splat_draw(sb_splat *splat, const sb_surfels *surfels, const sb_view *view, double spacing, int threads,
                        sb_error *error);

#endif

/* Selects the particles that the camera can see and computes the water's surface normals there. The drawing time is
   proportional to their number. */
#ifndef SB_RENDER_VISIBLE_H
#define SB_RENDER_VISIBLE_H

#include "frame/frame.h"
#include "render/camera/camera.h"
#include "render/water/density.h"

/* A particle in the layout that the vertex shader reads. */
typedef struct sb_visible_point {
    float position[3];     /* m, relative to the frame's origin */
    unsigned short value;  /* 65535: the upper end of the colour map */
    unsigned short crowd;  /* 65535: surrounded by others; near 0: a single drop */
    signed char normal[4]; /* points out of the water, length 127, scene axes */
} sb_visible_point;

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_visible {
    size_t count, capacity;
    sb_visible_point *points;
    sb_density density;
} sb_visible;

/* Collects the particles in the view that have no water between them and the eye. values: of each particle, 0..1.
   ground: as in sb_density_build. The frame's spacing must be above 0. */
sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const float *values, const sb_ground *ground,
                             const sb_view *view, int threads, sb_error *error);
void sb_visible_free(sb_visible *visible);

#endif

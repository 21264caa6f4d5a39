/* Selects the particles that the camera can see and computes the water's surface normals there. The drawing time is
   proportional to their number. */
#ifndef SB_RENDER_VISIBLE_H
#define SB_RENDER_VISIBLE_H

#include "frame/frame.h"
#include "render/camera.h"
#include "render/density.h"

/* A particle in the layout that the vertex shader reads. */
typedef struct sb_visible_point {
    float position[3];     /* m, relative to the frame's origin */
    unsigned short speed;  /* 65535: speed_max */
    unsigned short crowd;  /* 65535: surrounded by others; near 0: a single drop */
    signed char normal[4]; /* points out of the water, length 127, scene axes */
} sb_visible_point;

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_visible {
    size_t count, capacity;
    sb_visible_point *points;
    sb_density density;
} sb_visible;

/* Collects the particles in the view that have no water between them and the eye. speed_max and the frame's spacing
   must be above 0. */
sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const sb_view *view, double speed_max,
                             sb_error *error);
void sb_visible_free(sb_visible *visible);

#endif

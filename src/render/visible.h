/* Which particles the camera can see, and how the water's surface lies there: the rasteriser's time
   goes with their number. */
#ifndef SB_RENDER_VISIBLE_H
#define SB_RENDER_VISIBLE_H

#include "frame/frame.h"
#include "render/camera.h"
#include "render/density.h"

/* As the vertex shader reads it. */
typedef struct sb_visible_point {
    float position[3];     /* m, relative to the frame's origin */
    unsigned short speed;  /* 65535: speed_max */
    unsigned short crowd;  /* 65535: in the midst of others; near 0: a drop by itself */
    signed char normal[4]; /* out of the water, length 127, scene axes */
} sb_visible_point;

/* Kept from frame to frame so that its memory is. Zeroed is empty. */
typedef struct sb_visible {
    size_t count, capacity;
    sb_visible_point *points;
    sb_density density;
} sb_visible;

/* Collects the particles in the view that have no water between them and the eye. speed_max > 0;
   a frame's spacing must be > 0. */
sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const sb_view *view, double speed_max,
                             sb_error *error);
void sb_visible_free(sb_visible *visible);

#endif

/* Which particles the camera can see: the rasteriser's time goes with their number. */
#ifndef SB_RENDER_VISIBLE_H
#define SB_RENDER_VISIBLE_H

#include "frame/frame.h"
#include "render/camera.h"

/* As the vertex shader reads it. */
typedef struct sb_visible_point {
    float position[3];          /* m, relative to the frame's origin */
    unsigned short speed, size; /* 65535: speed_max, and a full-sized sphere */
} sb_visible_point;

/* Kept from frame to frame so that its memory is. Zeroed is empty. */
typedef struct sb_visible {
    size_t count, point_capacity, cell_capacity;
    sb_visible_point *points;
    unsigned char *cells;
} sb_visible;

/* Collects the particles in the view that no layer of full cells between them and the eye hides; lone
   ones (spray) get smaller sizes. Non-finite particles and those 1e4 km from the origin are left
   out. speed_max > 0. */
sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const sb_view *view,
                             double speed_max, sb_error *error);
void sb_visible_free(sb_visible *visible);

#endif

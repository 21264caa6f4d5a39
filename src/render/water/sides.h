/* Ends the drawn water at the domain's sides: what is beyond them is removed, and the water that stands at a side is a
   flat cut in it. */
#ifndef SB_RENDER_SIDES_H
#define SB_RENDER_SIDES_H

#include "render/water/splat.h"

/* Kept from picture to picture, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_sides {
    size_t capacity;
    float *node; /* of the sides that face the eye: weight, and weight times value */
} sb_sides;

/* Changes a picture that sb_splat_draw has made of the frame with this density. Does nothing without sides
   (density->sided). values: of each particle, 0..1. ground: that of the density. The result is the same for any number
   of threads. */
sb_status sb_sides_draw(sb_sides *sides, sb_splat *splat, const sb_density *density, const sb_frame *frame,
                        const float *values, const sb_ground *ground, const sb_view *view, int threads,
                        sb_error *error);
void sb_sides_free(sb_sides *sides);

#endif

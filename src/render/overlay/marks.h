/* Marks of length and direction over a picture: a scale bar and an arrow to the north. */
#ifndef SB_RENDER_MARKS_H
#define SB_RENDER_MARKS_H

#include "render/camera/camera.h"
#include "render/image/image.h"

/* Draws a bar of a round length at the lower left corner. The length is that of an object across the view at `target`
   (m, scene). */
sb_status sb_marks_scale(sb_image *image, const sb_view *view, sb_vec3 target, sb_error *error);

/* Draws an arrow at the upper right corner: the direction of `north` (scene, horizontal) as seen at `target`. */
sb_status sb_marks_north(sb_image *image, const sb_view *view, sb_vec3 target, sb_vec3 north, sb_error *error);

#endif

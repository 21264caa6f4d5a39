/* Boxes, lines and discs over a picture, with soft edges. Coordinates are px from the top left corner; what lies
   outside of the picture is cut off. */
#ifndef SB_RENDER_PAINT_H
#define SB_RENDER_PAINT_H

#include "render/image/image.h"

/* alpha: 0, nothing, to 1, opaque. */
void sb_paint_box(sb_image *image, double x0, double y0, double x1, double y1, const float rgb[3], double alpha);
void sb_paint_line(sb_image *image, double x0, double y0, double x1, double y1, double width, const float rgb[3],
                   double alpha);
void sb_paint_disc(sb_image *image, double x, double y, double radius, const float rgb[3], double alpha);

#endif

/* Converts the pixels of OpenGL to a picture and smooths jagged edges. */
#ifndef SB_RENDER_SOFTEN_H
#define SB_RENDER_SOFTEN_H

#include "render/image/image.h"

/* rgba: image->width * image->height pixels, rows from the bottom up. Pixels that differ from their neighbours at an
   edge are blended with the colour across it; all other pixels are copied unchanged. */
void sb_soften(const unsigned char *rgba, sb_image *image);

#endif

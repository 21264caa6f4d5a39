/* From what OpenGL gives to a picture, its stairs along edges softened. */
#ifndef SB_RENDER_SOFTEN_H
#define SB_RENDER_SOFTEN_H

#include "render/image.h"

/* rgba: image->width * image->height pixels from the bottom row up. Pixels that stick out of their
   surroundings across an edge are blended over it; flat places are copied as they are. */
void sb_soften(const unsigned char *rgba, sb_image *image);

#endif

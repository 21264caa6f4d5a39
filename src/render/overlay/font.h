/* A small stroke font. The letters are drawn as pen strokes, so they are sharp and smooth at any size. */
#ifndef SB_RENDER_FONT_H
#define SB_RENDER_FONT_H

#include "render/image/image.h"

/* Returns the width in px of a line of text whose capitals are `height` px high. */
double sb_font_width(const char *text, double height);

/* Draws a line of text with its left end at x and its base line at y (px from the top left corner). A soft dark rim
   keeps it legible on any background. Each character outside of ASCII is drawn as '?'. Text outside of the image is cut
   off. */
sb_status sb_font_draw(sb_image *image, double x, double y, double height, const float rgb[3], const char *text,
                       sb_error *error);

#endif

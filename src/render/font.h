/* A small stroke font of our own: letters as pen strokes, so crisp and smooth at any size. */
#ifndef SB_RENDER_FONT_H
#define SB_RENDER_FONT_H

#include "render/image.h"

/* Width of a line of text with capitals `height` px high. */
double sb_font_width(const char *text, double height);

/* Draws a line of text, its left end at x and its base line at y (px from the top left corner),
   with a soft dark rim that keeps it legible on any ground. Bytes outside ASCII show as '?', one
   per character. What lies outside the image is cut off. */
sb_status sb_font_draw(sb_image *image, double x, double y, double height, const float rgb[3], const char *text,
                       sb_error *error);

#endif

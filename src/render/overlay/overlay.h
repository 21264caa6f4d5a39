/* Draws the title, the time and the colour legend over a picture. */
#ifndef SB_RENDER_OVERLAY_H
#define SB_RENDER_OVERLAY_H

#include "render/image/image.h"

enum { SB_OVERLAY_SLOT = 62 };        /* px from a legend to the one above it, in a picture that is 720 px high */
enum { SB_OVERLAY_HEIGHT_MIN = 200 }; /* px: in lower pictures the text would cover the content, so it is omitted */

/* The colours of the water. min < max: the values at both ends of the colour map. */
typedef struct sb_legend {
    const char *label; /* with the unit */
    int map;
    double min, max;
} sb_legend;

/* Draws title and time. title may be NULL; time in s. */
sb_status sb_overlay_title(sb_image *image, const char *title, double time, sb_error *error);

/* Draws a legend above `slot` others. */
sb_status sb_overlay_legend(sb_image *image, int slot, const sb_legend *legend, sb_error *error);

/* Returns the smallest step of 1, 2 or 5 times a power of ten that divides `range` into at most `most` intervals. */
double sb_overlay_tick(double range, int most);

/* Darkens a box behind text, so that it is legible on white surfaces, too. px from the top left corner. */
void sb_overlay_plate(sb_image *image, double x0, double y0, double x1, double y1);

#endif

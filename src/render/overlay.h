/* Draws the title, the time and the colour legend over a picture. */
#ifndef SB_RENDER_OVERLAY_H
#define SB_RENDER_OVERLAY_H

#include "render/image.h"

enum { SB_OVERLAY_HEIGHT_MIN = 200 }; /* px: in lower pictures the text would cover the content, so it is omitted */

/* title may be NULL; time in s; speed_max: the speed at the upper end of the colour map, m/s. */
sb_status sb_overlay_draw(sb_image *image, const char *title, double time, double speed_max, sb_error *error);

/* Returns the smallest step of 1, 2 or 5 times a power of ten that divides `range` into at most `most` intervals. */
double sb_overlay_tick(double range, int most);

#endif

/* What is written over a picture: title, time, and what the colours mean. */
#ifndef SB_RENDER_OVERLAY_H
#define SB_RENDER_OVERLAY_H

#include "render/image.h"

enum { SB_OVERLAY_HEIGHT_MIN = 200 }; /* px: lower pictures carry no writing, it would cover them */

/* title may be NULL; time in s; speed_max in m/s at the top of the colour map. */
sb_status sb_overlay_draw(sb_image *image, const char *title, double time, double speed_max, sb_error *error);

/* The step of 1, 2 or 5 times a power of ten that parts `range` into at most `most` pieces. */
double sb_overlay_tick(double range, int most);

#endif

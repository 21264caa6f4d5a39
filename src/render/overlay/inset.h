/* A small plot over time within a picture. */
#ifndef SB_RENDER_INSET_H
#define SB_RENDER_INSET_H

#include "render/image/image.h"

typedef struct sb_inset_plot {
    const char *title, *unit; /* SI; values are written with a factor of 1000 or more, as kN and MN */
    double time;              /* s, of the picture */
    const double (*rows)[2];  /* time (s) and value; a value of NaN is a gap */
    size_t count;
} sb_inset_plot;

/* Draws the plot into the lower left of a picture, above `slot` others. The axes begin at 0 s and have round ends that
   depend on the rows alone. Pictures that are too low for it stay as they are. */
sb_status sb_inset_draw(sb_image *image, size_t slot, const sb_inset_plot *plot, sb_error *error);

#endif

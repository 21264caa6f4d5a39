/* The water as seen from the sun, for its shadows, and the highest water so far as seen from above. */
#ifndef SB_RENDER_OVERHEAD_H
#define SB_RENDER_OVERHEAD_H

#include "render/bodies/light.h"
#include "render/water/reached.h"

/* A zeroed struct is empty. */
typedef struct sb_overhead {
    sb_tops shade;
    sb_reached *reached; /* not owned; set by the owner */
    uint64_t uploaded;   /* number of the change of it that the texture has */
    GLuint shade_map, reached_map;
    bool flat; /* the scene has two dimensions: its water is one row of cells; set by the owner */
} sb_overhead;

/* Finds the shadows of the frame's water, and adds the frame to the highest water so far if `reaches` is true. density:
   of the frame. The context must be current. */
sb_status sb_overhead_update(sb_overhead *overhead, const sb_light *light, const sb_frame *frame,
                             const sb_density *density, bool reaches, sb_error *error);
/* The context must be current. */
void sb_overhead_destroy(sb_overhead *overhead);

/* Returns how much the height towards the sun changes per metre, in units of `shade`. */
double sb_overhead_scale(const sb_light *light);

#endif

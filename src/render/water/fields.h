/* The fields by which the water can be coloured. */
#ifndef SB_RENDER_FIELDS_H
#define SB_RENDER_FIELDS_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "scene/scene.h"

/* One row per value of enum sb_water_color. */
typedef struct sb_field {
    const char *label; /* with its unit, for the legend */
    int map;           /* of sb_colormap */
    /* Returns a range that fits the scene, the same for all frames. depth: m, of the still water; speed: m/s, of a long
       wave there. */
    double (*range)(const sb_scene *scene, double depth, double speed);
} sb_field;
extern const sb_field sb_fields[SB_WATER_COLORS];

/* The values of a frame's particles. Kept from frame to frame, so that its memory is reused. A zeroed struct is empty.
 */
typedef struct sb_values {
    size_t capacity, node_capacity;
    float *list; /* per particle: 0..1 between min and max of the field, clamped */
    float *nodes;
} sb_values;

/* Computes the values of a field, scaled so that min gives 0 and max gives 1. min < max. The frame's spacing must be
   above 0. */
sb_status sb_values_compute(sb_values *values, const sb_frame *frame, sb_water_color color, double min, double max,
                            sb_error *error);
void sb_values_free(sb_values *values);

#endif

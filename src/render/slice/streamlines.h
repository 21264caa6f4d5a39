/* Evenly spaced lines along the velocity within a plane. */
#ifndef SB_RENDER_STREAMLINES_H
#define SB_RENDER_STREAMLINES_H

#include "render/slice/plane_field.h"

/* A point of a line: m along the plane's axes. */
typedef struct sb_stream_point {
    float a, b;
    uint32_t before; /* the point before in its cell, plus one */
} sb_stream_point;

typedef struct sb_streamline {
    size_t first, count; /* of its points */
    bool closed;         /* its last point is its first one */
} sb_streamline;

/* Kept from picture to picture, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_streamlines {
    size_t line_count, line_capacity;
    sb_streamline *lines;
    size_t point_count, point_capacity, cell_capacity;
    sb_stream_point *points;
    uint32_t *cells; /* last point of each cell, plus one; 0: none */
} sb_streamlines;

/* Traces lines through the water of the field that are about `distance` (m, > 0) apart [Jobard & Lefer 1997]: new lines
   begin at this distance beside earlier ones, and a line ends at half of it from another one, at the water's edge, and
   where the water stands. Points follow the velocity. The result depends on the field only. */
sb_status sb_streamlines_trace(sb_streamlines *lines, const sb_plane_field *field, double distance, sb_error *error);
void sb_streamlines_free(sb_streamlines *lines);

#endif

/* Time series of several quantities at the points of a line, interpolated monotonically in time and linearly along the
   line. Private to src/sea. */
#ifndef SB_SEA_LINE_H
#define SB_SEA_LINE_H

#include "base/status.h"

#include <stddef.h>

enum { SB_LINE_CHANNELS = 26 };

/* One point: `count` times, and as many rows of channels. slopes are those of the interpolating cubics. */
typedef struct sb_line_point {
    double x, y;
    size_t count, time_capacity, value_capacity;
    double *times, *values, *slopes;
} sb_line_point;

typedef struct sb_line {
    size_t channels; /* at most SB_LINE_CHANNELS; set by the owner */
    size_t count, capacity, last;
    sb_line_point *points; /* in the order of the line */
} sb_line;

/* Appends a row to the point (x, y), which is a new one at the end of the line if there is none. SB_BAD_INPUT, with a
   text that begins with `place`, if the time does not follow the point's last one, or a channel
   changes by more than 1e9 per second. */
sb_status sb_line_add(sb_line *series, double x, double y, double time, const double *values, const char *place,
                      sb_error *error);

/* Finds the slopes after the last row [Fritsch and Butland 1984: monotone wherever the rows are]. SB_FAILED without
   memory. Each point needs two rows. */
sb_status sb_line_finish(sb_line *series, sb_error *error);

/* Sets the channels and their rates in time at the place of the line that is nearest to (x, y). Before the first and
   after the last row of a point, its value there is kept. */
void sb_line_at(const sb_line *series, double t, double x, double y, double *values, double *rates);

void sb_line_free(sb_line *series);

#endif

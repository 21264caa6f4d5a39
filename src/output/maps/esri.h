/* Writes ESRI ASCII grids, which GIS programs and gnuplot read. */
#ifndef SB_OUTPUT_ESRI_H
#define SB_OUTPUT_ESRI_H

#include "base/status.h"
#include "frame/records.h"

/* Writes one grid. values are ordered as in the map (row 0 at y_min); NaN becomes NODATA (-9999). */
sb_status sb_esri_write(const char *path, const sb_map_record *map, const float *values, sb_error *error);

#endif

/* Writes maps as ESRI ASCII grids, which GIS programs and gnuplot read. */
#ifndef SB_OUTPUT_ESRI_H
#define SB_OUTPUT_ESRI_H

#include "base/status.h"
#include "frame/records.h"

/* Writes one grid. values are ordered as in the map (row 0 at y_min); NaN becomes NODATA (-9999). */
sb_status sb_esri_write(const char *path, const sb_map_record *map, const float *values, sb_error *error);

/* Names of the maps; the list ends with NULL. */
enum { SB_MAPS = 4 };
extern const char *const sb_map_names[SB_MAPS + 1];

/* Writes maps/<name>.asc for each of them, below directory. */
sb_status sb_maps_write(const char *directory, const sb_map_record *map, sb_error *error);

#endif

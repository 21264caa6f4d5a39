/* Maps as ESRI ASCII grids: read by GIS programs and by gnuplot. */
#ifndef SB_OUTPUT_ESRI_H
#define SB_OUTPUT_ESRI_H

#include "base/status.h"
#include "measure/records.h"

/* One grid; values as in the map (row 0 at y_min), NaN becomes NODATA (-9999). */
sb_status sb_esri_write(const char *path, const sb_map_record *map, const float *values, sb_error *error);

/* Ended by NULL. */
enum { SB_MAPS = 4 };
extern const char *const sb_map_names[SB_MAPS + 1];

/* maps/<name>.asc for each of them, below directory. */
sb_status sb_maps_write(const char *directory, const sb_map_record *map, sb_error *error);

#endif

/* Reads tables of given water: CSV, and the gauges of GeoClaw. Private to src/sea. */
#ifndef SB_SEA_TABLE_READ_H
#define SB_SEA_TABLE_READ_H

#include "base/rows.h"
#include "scene/scene.h"
#include "sea/line.h"

/* Channels of a table: surface above its datum in m, velocities in m/s. */
enum { SB_TABLE_ETA, SB_TABLE_U, SB_TABLE_V, SB_TABLE_CHANNELS };

/* Reads all rows of an open file in the unit that the scene names; points of a scene of 3 dimensions have x and y, and
   rows have v where a side across y is given. SB_BAD_INPUT names the file, the line and what was expected. */
sb_status sb_table_read(sb_rows *rows, const sb_scene *scene, sb_line *series, sb_error *error);

#endif

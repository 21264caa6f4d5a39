/* The tables of planes and run-up lines, whose places are lines on the ground, and what they share with the other
   measurements. Private to src/scene. */
#ifndef SB_SCENE_TABLE_PLANES_H
#define SB_SCENE_TABLE_PLANES_H

#include "scene/reader.h"

extern const sb_table sb_plane_table, sb_runup_table;

/* Whether the rectangle between two points of the ground overlaps the domain; coordinates in m. */
bool sb_table_meets_domain(const sb_scene *scene, double ax, double ay, double bx, double by);

/* Refuses a place that is outside of the domain: SB_BAD_INPUT. */
sb_status sb_table_refuse_outside(sb_reader *reader, const sb_yaml *map, const char *key);

#endif

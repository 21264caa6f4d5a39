/* Checks of time series along a line against the scene that uses them. Private to src/sea. */
#ifndef SB_SEA_LINE_CHECK_H
#define SB_SEA_LINE_CHECK_H

#include "scene/scene.h"
#include "sea/line.h"

/* SB_BAD_INPUT, with the file's path, unless each point has two rows that contain the run's times, and, where there is
   more than one point, all are beside the domain and in their order. path: of the file. */
sb_status sb_line_check(const sb_line *series, const sb_scene *scene, const char *path, sb_error *error);

/* Writes a warning if the line runs across the only side at which its water is given, or lies nearer to the opposite
   one. Otherwise text stays as it is. */
void sb_line_doubt(const sb_line *series, const sb_scene *scene, char *text, size_t size);

#endif

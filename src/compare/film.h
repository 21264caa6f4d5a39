/* The films of runs side by side. Private to src/compare. */
#ifndef SB_COMPARE_FILM_H
#define SB_COMPARE_FILM_H

#include "compare/comparison.h"

enum { SB_FILM_MAX = 3 }; /* runs side by side */

/* The first camera of which the first runs of the first groups have pictures, and the number of these groups, at most
   SB_FILM_MAX; NULL: there is none. */
const char *sb_film_camera(const sb_comparison *comparison, size_t *groups);

/* Writes `name` in the folder: the pictures of that camera, one run beside the other, at equal times. SB_FAILED says
   why there is no film: no pictures, no ffmpeg. */
sb_status sb_film_make(const sb_comparison *comparison, const char *folder, const char *name, sb_error *error);

#endif

/* The choice of particle files by the times that a user names. */
#ifndef SB_APP_TIMES_H
#define SB_APP_TIMES_H

#include "output/particles/particle_list.h"

#include <stdbool.h>

/* Sets chosen[i] for each entry that `text` names: times in s and ranges FROM:TO, separated by commas. A time stands
   for the file nearest to it. text NULL: all. SB_BAD_INPUT for other text, a time beyond the first or last file by more
   than their distance from the next one, and a range without files. */
sb_status sb_times_choose(const char *text, const sb_particle_list *list, bool *chosen, sb_error *error);

#endif

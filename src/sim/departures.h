/* Where particles left the domain. Reports only: nothing here changes the run. */
#ifndef SB_SIM_DEPARTURES_H
#define SB_SIM_DEPARTURES_H

#include "sim/state.h"

/* What outside() found: the side, and whether it is a wall; below 0: the particle is inside. */
typedef struct sb_exit {
    int side;
    bool lost;
} sb_exit;

/* Notes one that goes, before the step that would come: in the order of their calls. */
void sb_departures_note(sb_sim *sim, sb_exit way, size_t particle);

void sb_departures_save(const sb_sim *sim, sb_archive_out *out);
void sb_departures_load(sb_sim *sim, sb_archive_in *in);

#endif

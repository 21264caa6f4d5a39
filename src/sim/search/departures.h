/* Record of where particles left the domain. It only reports; it does not change the run. */
#ifndef SB_SIM_DEPARTURES_H
#define SB_SIM_DEPARTURES_H

#include "sim/simulation.h"

/* The side that a particle is beyond, and whether that side is a wall. side < 0: the particle is inside the domain. */
typedef struct sb_exit {
    int side;
    bool lost;
} sb_exit;

/* Records one particle that left, at the start of a step. Records are in the order of the calls. */
void sb_departures_note(sb_sim *sim, sb_exit way, size_t particle);

void sb_departures_save(const sb_sim *sim, sb_archive_out *out);
void sb_departures_load(sb_sim *sim, sb_archive_in *in);

#endif

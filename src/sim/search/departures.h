/* Record of where particles left the domain. It only reports; it does not change the run. */
#ifndef SB_SIM_DEPARTURES_H
#define SB_SIM_DEPARTURES_H

#include "sim/simulation.h"

/* The side that a particle is beyond, and whether that side is a wall. side < 0: the particle is inside the domain. */
typedef struct sb_exit {
    int side;
    bool lost;
} sb_exit;

/* sort_stage.c: where the sort will remove a particle of this record. */
sb_exit sb_exit_of(const sb_sim *sim, sb_record at);

/* Notes one particle of this domain that left, at the start of a step. The notes of a step are in the order of the ids,
   and only the first ones are kept. */
void sb_departures_note(const sb_sim *sim, sb_exit way, size_t particle, sb_departures *here);
/* Appends the notes of a step, of all domains, to the record. */
void sb_departures_add(sb_sim *sim, const sb_departures *here);

void sb_departures_save(const sb_sim *sim, sb_archive_out *out);
void sb_departures_load(sb_sim *sim, sb_archive_in *in);

#endif

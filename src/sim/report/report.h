/* The report of a simulation: what the log and the tables show. It is only written here; nothing of the simulation
   reads it. */
#ifndef SB_SIM_REPORT_H
#define SB_SIM_REPORT_H

#include "sim/simulation.h"

/* Copies what the state and the last solve have into the report of the step. The errors of the solve, the compression
   and the momentum balance are entered where they are computed. */
void sb_report_update(sb_sim *sim);
/* Lists the parts that this scene does not need; the log shows them once. */
void sb_report_skipped(sb_sim *sim);

#endif

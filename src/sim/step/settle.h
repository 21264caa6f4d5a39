/* Settling: how the water comes to rest before t = 0. */
#ifndef SB_SIM_SETTLE_H
#define SB_SIM_SETTLE_H

#include "sim/simulation.h"

/* Whether the last settling step has been done. The state after it is never saved, because the run starts from it at
   once. */
bool sb_settle_over(const sb_settle *settle);
/* Horizontal acceleration (m/s^2) that holds an initial wave during settling, g d(eta)/dx. Together with gravity it is
   normal to the wave's surface everywhere. */
float sb_settle_wave_acceleration(const sb_sim *sim, sb_record at);

#endif

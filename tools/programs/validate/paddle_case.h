/* What the cases of waves that a paddle makes share: the first wave maker of the scene makes them. */
#ifndef SB_VALIDATE_PADDLE_CASE_H
#define SB_VALIDATE_PADDLE_CASE_H

#include "case.h"

/* Adds a panel with the surface at a gauge over the height aimed at, against the time in periods, of all runs. */
void sb_paddle_plot(const sb_case_run *runs, size_t count, const char *title, const char *gauge, sb_plot *plot);

/* The mean displacement of the paddle from its law over the last ten periods, in % of its stroke: judged if the run has
   100 periods. Nothing if it does not absorb. */
void sb_paddle_drift(const sb_case_run *run, sb_figures *figures);

#endif

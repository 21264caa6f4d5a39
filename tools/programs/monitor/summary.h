/* The rows above the panels: title, progress, convergence, stream. Internal to the drawing of the monitor. */
#ifndef SB_MONITOR_SUMMARY_H
#define SB_MONITOR_SUMMARY_H

#include "cells.h"
#include "state.h"

/* What the run does, in words: "running", "paused", "no data for 7 s" and so on; its style. */
sb_style sb_summary_state(char *out, size_t size, const sb_monitor_state *state, double now);

/* Draws the summary from the first row on; brief: without convergence and stream. Returns the number of its rows. */
int sb_summary_draw(sb_cells *cells, const sb_monitor_state *state, double now, bool brief);

#endif

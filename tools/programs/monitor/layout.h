/* Arranges summary, panels and keys on a screen of any size, and prints them as plain text. */
#ifndef SB_MONITOR_LAYOUT_H
#define SB_MONITOR_LAYOUT_H

#include "cells.h"
#include "state.h"
#include "view.h"

#include <stdio.h>

/* Draws the whole screen. The scroll positions of the view are limited to the rows that exist. */
void sb_layout_draw(sb_cells *cells, const sb_monitor_state *state, sb_view *view, double now);

/* Prints the summary and all rows of all panels, without cutting them at a height. SB_FAILED without memory. */
sb_status sb_layout_print(FILE *out, const sb_monitor_state *state, int width, bool utf8, double now);

/* Prints the run's progress as one line. */
void sb_layout_line(FILE *out, const sb_monitor_state *state);

#endif

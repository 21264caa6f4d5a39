/* The terminal, by ncurses. */
#ifndef SB_MONITOR_SCREEN_H
#define SB_MONITOR_SCREEN_H

#include "cells.h"

/* Takes the terminal of stdin and stdout. False if ncurses does not know it. */
bool sb_screen_open(bool colour);
/* Gives it back as it was. Does nothing if it was not taken. */
void sb_screen_close(void);

void sb_screen_size(int *width, int *height);
void sb_screen_show(const sb_cells *cells);

/* The next key (view.h), or -1: none has been pressed. */
int sb_screen_key(void);

/* For the process that watches the one that takes the terminal. sb_screen_remember, before the other process begins,
   remembers the terminal's settings; sb_screen_restore restores them if the other process has ended without
   sb_screen_close. */
void sb_screen_remember(void);
void sb_screen_restore(void);

#endif

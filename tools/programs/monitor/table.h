/* Prints the state as a table, for a terminal or as plain text. */
#ifndef SB_MONITOR_TABLE_H
#define SB_MONITOR_TABLE_H

#include "state.h"

#include <stdio.h>

typedef struct sb_table_style {
    bool colour, utf8;
    int width, height;    /* columns; rows, 0: no limit */
    const char *line_end; /* printed before each newline: on a terminal it clears the rest of the line */
} sb_table_style;

/* Prints the state in at most style->height rows. The last row counts the bodies that do not fit. */
void sb_table_draw(FILE *out, const sb_monitor_state *state, const sb_table_style *style, double now);

/* Prints the run's progress as one line. */
void sb_table_line(FILE *out, const sb_monitor_state *state);

#endif

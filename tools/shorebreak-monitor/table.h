/* The state as a table, for a terminal or as plain text. */
#ifndef SB_MONITOR_TABLE_H
#define SB_MONITOR_TABLE_H

#include "state.h"

#include <stdio.h>

typedef struct sb_table_style {
    bool colour, utf8;
    int width, height;    /* columns; rows, 0: no limit */
    const char *line_end; /* before the newline: "clear to the end of the line" on a terminal */
} sb_table_style;

/* Everything known, in at most style->height rows; bodies that do not fit are counted in a last
 * row. */
void sb_table_draw(FILE *out, const sb_monitor_state *state, const sb_table_style *style, double now);

/* One line: where the run is. */
void sb_table_line(FILE *out, const sb_monitor_state *state);

#endif

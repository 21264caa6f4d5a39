/* A screen of character cells, which is drawn without a terminal: tests compare its rows, and the program copies it to
   the terminal or prints its rows. */
#ifndef SB_MONITOR_CELLS_H
#define SB_MONITOR_CELLS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <wchar.h>

/* What a cell's text is. No style is the only sign of anything: the text says it, too. */
typedef enum sb_style {
    SB_STYLE_PLAIN,
    SB_STYLE_BOLD,
    SB_STYLE_DIM,
    SB_STYLE_GOOD,
    SB_STYLE_BAD,
    SB_STYLE_ACCENT,
    SB_STYLE_INVERSE,
    SB_STYLES
} sb_style;

typedef struct sb_cell {
    wchar_t glyph; /* one column wide, never a control character */
    sb_style style;
} sb_cell;

enum { SB_CELLS_WIDTH_MAX = 1000, SB_CELLS_HEIGHT_MAX = 4000 };

/* A zero-initialised struct has no cells. */
typedef struct sb_cells {
    int width, height;
    bool utf8; /* bars and sparklines are drawn with characters beyond ASCII */
    sb_cell *cells;
} sb_cells;

/* Sets the size, between 1 and the largest one, and clears the cells. SB_FAILED without memory: there are no cells. */
sb_status sb_cells_resize(sb_cells *cells, int width, int height);
void sb_cells_clear(sb_cells *cells);
void sb_cells_free(sb_cells *cells);

/* Writes text (UTF-8) from a position on, and leaves out what is beyond the screen. Control characters and bytes that
   are not UTF-8 become '?'. Returns the column after the text. */
int sb_cells_put(sb_cells *cells, int row, int column, sb_style style, const char *text);
int sb_cells_print(sb_cells *cells, int row, int column, sb_style style, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* The columns that the text takes. */
int sb_cells_columns(const char *text);

/* Writes a row as UTF-8 without blanks at its end. */
void sb_cells_row(const sb_cells *cells, int row, char *out, size_t size);

/* Writes fields one after the other, with two blanks between them, into a number of rows. A field that does not fit
   into its row goes into the next one; if there is none, it is left out as a whole. */
typedef struct sb_line {
    sb_cells *cells;
    int row, left, right; /* the columns [left, right) */
    int rows;             /* left, with the present one */
    int column;
} sb_line;
sb_line sb_line_begin(sb_cells *cells, int row, int rows);
bool sb_line_add(sb_line *line, sb_style style, const char *format, ...) __attribute__((format(printf, 3, 4)));
void sb_line_break(sb_line *line);

#endif

/* Lines of a text table, and the numbers in them. */
#ifndef SB_BASE_ROWS_H
#define SB_BASE_ROWS_H

#include "base/status.h"

#include <stddef.h>

enum { SB_ROWS_CELLS = 64, SB_ROWS_PLACE = 600 };

/* A table that is being read. */
typedef struct sb_rows {
    const char *path;
    char *text, *next; /* owned; the next line, NULL at the end */
    size_t line;       /* number of the current line, from 1 */
    char *cells[SB_ROWS_CELLS];
    size_t cell_count; /* of the current line; empty cells count where commas separate */
} sb_rows;

/* Reads the file, at most 1 GB. SB_BAD_INPUT names it, and the line of a zero byte or another control character, which
   only a file that is no text table has. */
sb_status sb_rows_open(const char *path, sb_rows *rows, sb_error *error);
void sb_rows_close(sb_rows *rows);

/* Returns the next line that is not empty, without its end (LF, CR LF or CR) and leading blanks; NULL at the end. */
char *sb_rows_next(sb_rows *rows);

/* Cuts a line into cells, at commas or semicolons if it has any, otherwise at blanks; quotes around a cell are removed.
   SB_BAD_INPUT if there are more than SB_ROWS_CELLS. */
sb_status sb_rows_cut(sb_rows *rows, char *line, sb_error *error);

/* Reads cell i as a number of at most 1e9. SB_BAD_INPUT names the line and the quantity. */
sb_status sb_rows_number(const sb_rows *rows, size_t i, const char *what, double *value, sb_error *error);

/* Writes "file:line" for messages. */
const char *sb_rows_place(const sb_rows *rows, char place[SB_ROWS_PLACE]);

#endif

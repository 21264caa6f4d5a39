#include "cells.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_BYTES = 2048 };

static int between(int value, int least, int most)
{
    return value < least ? least : value > most ? most : value;
}

sb_status sb_cells_resize(sb_cells *cells, int width, int height)
{
    sb_free(cells->cells);
    cells->width = between(width, 1, SB_CELLS_WIDTH_MAX);
    cells->height = between(height, 1, SB_CELLS_HEIGHT_MAX);
    cells->cells = sb_alloc((size_t)cells->width * (size_t)cells->height, sizeof *cells->cells);
    if (!cells->cells) {
        cells->width = cells->height = 0;
        return SB_FAILED;
    }
    sb_cells_clear(cells);
    return SB_OK;
}

void sb_cells_clear(sb_cells *cells)
{
    const size_t count = (size_t)cells->width * (size_t)cells->height;
    for (size_t i = 0; i < count; i++) cells->cells[i] = (sb_cell){L' ', SB_STYLE_PLAIN};
}

void sb_cells_free(sb_cells *cells)
{
    sb_free(cells->cells);
    *cells = (sb_cells){.utf8 = cells->utf8};
}

/* Reads the next character of UTF-8 text, of at most three bytes. *text is moved beyond it. */
static wchar_t next_glyph(const char **text)
{
    const unsigned char *at = (const unsigned char *)*text;
    wchar_t glyph = L'?';
    int bytes = 1;
    if (at[0] >= 0x20 && at[0] < 0x7f) {
        glyph = at[0];
    } else if ((at[0] & 0xe0) == 0xc0 && (at[1] & 0xc0) == 0x80) {
        bytes = 2;
        glyph = (wchar_t)((at[0] & 0x1f) << 6 | (at[1] & 0x3f));
    } else if ((at[0] & 0xf0) == 0xe0 && (at[1] & 0xc0) == 0x80 && (at[2] & 0xc0) == 0x80) {
        bytes = 3;
        glyph = (wchar_t)((at[0] & 0x0f) << 12 | (at[1] & 0x3f) << 6 | (at[2] & 0x3f));
    }
    if (bytes > 1 && glyph < 0xa0) glyph = L'?'; /* the control characters from 0x80 on, and overlong forms */
    *text += bytes;
    return glyph;
}

int sb_cells_put(sb_cells *cells, int row, int column, sb_style style, const char *text)
{
    for (; *text; column++) {
        const wchar_t glyph = next_glyph(&text);
        if (row >= 0 && row < cells->height && column >= 0 && column < cells->width)
            cells->cells[(size_t)row * (size_t)cells->width + (size_t)column] = (sb_cell){glyph, style};
    }
    return column;
}

int sb_cells_print(sb_cells *cells, int row, int column, sb_style style, const char *format, ...)
{
    char text[TEXT_BYTES];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    return sb_cells_put(cells, row, column, style, text);
}

int sb_cells_columns(const char *text)
{
    int columns = 0;
    for (; *text; columns++) next_glyph(&text);
    return columns;
}

static char *put_glyph(char *out, wchar_t glyph)
{
    if (glyph < 0x80) {
        *out++ = (char)glyph;
    } else if (glyph < 0x800) {
        *out++ = (char)(0xc0 | glyph >> 6);
        *out++ = (char)(0x80 | (glyph & 0x3f));
    } else {
        *out++ = (char)(0xe0 | glyph >> 12);
        *out++ = (char)(0x80 | (glyph >> 6 & 0x3f));
        *out++ = (char)(0x80 | (glyph & 0x3f));
    }
    return out;
}

void sb_cells_row(const sb_cells *cells, int row, char *out, size_t size)
{
    const sb_cell *cell = &cells->cells[(size_t)row * (size_t)cells->width];
    int used = cells->width;
    while (used > 0 && cell[used - 1].glyph == L' ') used--;
    const char *end = out + size;
    for (int i = 0; i < used && end - out > 4; i++) out = put_glyph(out, cell[i].glyph);
    *out = 0;
}

sb_line sb_line_begin(sb_cells *cells, int row, int rows)
{
    return (sb_line){.cells = cells, .row = row, .right = cells->width, .rows = rows};
}

void sb_line_break(sb_line *line)
{
    if (line->rows <= 1) return;
    line->row++;
    line->rows--;
    line->column = line->left;
}

bool sb_line_add(sb_line *line, sb_style style, const char *format, ...)
{
    enum { BLANKS = 2 };
    char text[TEXT_BYTES];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    const int columns = sb_cells_columns(text);
    int begin = line->column > line->left ? line->column + BLANKS : line->left;
    if (begin + columns > line->right) {
        if (line->rows <= 1 || line->left + columns > line->right) return false;
        sb_line_break(line);
        begin = line->left;
    }
    line->column = sb_cells_put(line->cells, line->row, begin, style, text);
    return true;
}

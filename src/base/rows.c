#include "base/rows.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const size_t FILE_LIMIT = (size_t)1 << 30;
static const double NUMBER_LIMIT = 1e9;

/* Refuses the first byte that no text has, with its line. */
static sb_status check_text(const char *path, const char *text, size_t length, sb_error *error)
{
    size_t line = 1;
    for (size_t i = 0; i < length; i++) {
        const unsigned byte = (unsigned char)text[i];
        if (byte == '\n') line++;
        if (byte != 0x7f && (byte >= ' ' || (byte >= '\t' && byte <= '\r'))) continue;
        if (byte == 0)
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: contains a zero byte, expected a text table", path, line);
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: contains the control character 0x%02x, expected a text table",
                       path, line, byte);
    }
    return SB_OK;
}

sb_status sb_rows_open(const char *path, sb_rows *rows, sb_error *error)
{
    size_t length;
    *rows = (sb_rows){.path = path};
    sb_status status = sb_text_read(path, FILE_LIMIT, &rows->text, &length, error);
    if (status == SB_OK) status = check_text(path, rows->text, length, error);
    if (status != SB_OK) sb_rows_close(rows);
    rows->next = rows->text;
    return status;
}

void sb_rows_close(sb_rows *rows)
{
    sb_free(rows->text);
    rows->text = rows->next = NULL;
}

char *sb_rows_next(sb_rows *rows)
{
    while (rows->next) {
        char *line = rows->next, *end = line + strcspn(line, "\r\n");
        const size_t mark = strncmp(end, "\r\n", 2) == 0 ? 2 : 1;
        rows->next = *end ? end + mark : NULL;
        *end = '\0';
        rows->line++;
        line += strspn(line, " \t\r");
        if (*line) return line;
    }
    return NULL;
}

/* Removes blanks at the end, and quotes around the cell. */
static char *trim(char *cell)
{
    cell += strspn(cell, " \t\r");
    size_t length = strlen(cell);
    while (length > 0 && strchr(" \t\r", cell[length - 1])) cell[--length] = '\0';
    if (length < 2 || cell[0] != '"' || cell[length - 1] != '"') return cell;
    cell[length - 1] = '\0';
    return cell + 1;
}

sb_status sb_rows_cut(sb_rows *rows, char *line, sb_error *error)
{
    const bool marked = strpbrk(line, ",;") != NULL;
    const char *separators = marked ? ",;" : " \t\r";
    rows->cell_count = 0;
    while (line) {
        if (!marked) line += strspn(line, separators);
        if (!marked && !*line) break;
        if (rows->cell_count == SB_ROWS_CELLS)
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: has more columns than %d, expected at most %d", rows->path,
                           rows->line, SB_ROWS_CELLS, SB_ROWS_CELLS);
        char *end = line + strcspn(line, separators), *after = *end ? end + 1 : NULL;
        *end = '\0';
        rows->cells[rows->cell_count++] = trim(line);
        line = after;
    }
    return SB_OK;
}

sb_status sb_rows_number(const sb_rows *rows, size_t i, const char *what, double *value, sb_error *error)
{
    const char *text = i < rows->cell_count ? rows->cells[i] : "";
    char *end;
    *value = strtod(text, &end);
    if (*text && !*end && !text[strspn(text, "+-.0123456789eE")] && fabs(*value) <= NUMBER_LIMIT) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %s is %s%.40s, expected a number below 1e9", rows->path,
                   rows->line, what, *text ? "" : "missing", text);
}

const char *sb_rows_place(const sb_rows *rows, char place[SB_ROWS_PLACE])
{
    snprintf(place, SB_ROWS_PLACE, "%.500s:%zu", rows->path, rows->line);
    return place;
}

#include "sheet.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void sb_sheet_free(sb_sheet *sheet)
{
    sb_free(sheet->text);
    sb_free(sheet->fields);
    *sheet = (sb_sheet){0};
}

/* Reads a field at *at and ends it with a zero; moves *at behind its comma, or to NULL at the end of the line. Quotes
   around a field (RFC 4180) are removed. */
static char *take(char **at)
{
    char *field = *at, *out = *at, *c = *at;
    bool quoted = *c == '"';
    for (c += quoted; *c; c++) {
        if (quoted && *c == '"') {
            if (c[1] == '"')
                c++;
            else {
                quoted = false;
                continue;
            }
        } else if (!quoted && *c == ',')
            break;
        *out++ = *c;
    }
    *at = *c ? c + 1 : NULL;
    *out = '\0';
    return field;
}

static sb_status take_line(sb_sheet *sheet, char *line, size_t number, const char *path, sb_error *error)
{
    size_t count = 0, start = sheet->columns ? (sheet->rows + 1) * sheet->columns : 0;
    for (char *at = line; at; count++) {
        char *field = take(&at);
        if (sb_grow((void **)&sheet->fields, &sheet->capacity, start + count + 1, sizeof *sheet->fields) != 0)
            return sb_fail_memory(error, path);
        sheet->fields[start + count] = field;
    }
    if (sheet->columns && count != sheet->columns)
        return sb_fail(error, SB_BAD_INPUT, "%.400s:%zu: %zu fields, expected %zu", path, number, count,
                       sheet->columns);
    if (sheet->columns)
        sheet->rows++;
    else
        sheet->columns = count;
    return SB_OK;
}

sb_status sb_sheet_read(const char *path, sb_sheet *sheet, sb_error *error)
{
    sb_sheet made = {0};
    size_t length, number = 0;
    sb_status status = sb_file_read(path, (size_t)1 << 30, &made.text, &length, error);
    char *line = status == SB_OK ? made.text : NULL;
    while (status == SB_OK && line && *line) {
        char *end = strchr(line, '\n');
        number++;
        if (!end) break;
        *end = '\0';
        if (end > line && end[-1] == '\r') end[-1] = '\0';
        if (*line != '#' && *line) status = take_line(&made, line, number, path, error);
        line = end + 1;
    }
    if (status == SB_OK && made.columns == 0) status = sb_fail(error, SB_BAD_INPUT, "%.400s: no header line", path);
    if (status != SB_OK)
        sb_sheet_free(&made);
    else
        *sheet = made;
    return status;
}

void sb_sheet_put(FILE *out, const char *text)
{
    const bool quote = strpbrk(text, ",\"") != NULL;
    if (quote) fputc('"', out);
    for (; *text; text++) {
        if (*text == '"') fputc('"', out);
        fputc(*text, out);
    }
    if (quote) fputc('"', out);
}

size_t sb_sheet_column(const sb_sheet *sheet, const char *name)
{
    size_t length = strlen(name);
    for (size_t k = 0; k < sheet->columns; k++)
        if (strncmp(sheet->fields[k], name, length) == 0 &&
            (sheet->fields[k][length] == '\0' || strcmp(sheet->fields[k] + length, "_per_m") == 0))
            return k;
    return (size_t)-1;
}

const char *sb_sheet_text(const sb_sheet *sheet, size_t row, size_t column)
{
    return row < sheet->rows && column < sheet->columns ? sheet->fields[(row + 1) * sheet->columns + column] : "";
}

double sb_sheet_number(const sb_sheet *sheet, size_t row, size_t column)
{
    const char *text = sb_sheet_text(sheet, row, column);
    char *end;
    double value = strtod(text, &end);
    return end == text || *end != '\0' ? (double)NAN : value;
}

sb_status sb_sheet_curve(const sb_sheet *sheet, const char *where, const char *x, const char *y, sb_curve *curve,
                         sb_error *error)
{
    size_t x_column = sb_sheet_column(sheet, x), y_column = sb_sheet_column(sheet, y);
    sb_curve made = {0};
    sb_status status = SB_OK;
    if (x_column == (size_t)-1 || y_column == (size_t)-1)
        return sb_fail(error, SB_BAD_INPUT, "no column %s", x_column == (size_t)-1 ? x : y);
    for (size_t row = 0; row < sheet->rows; row++)
        if (!where || (sheet->columns > 1 && strcmp(sb_sheet_text(sheet, row, 1), where) == 0))
            sb_curve_add(&made, sb_sheet_number(sheet, row, x_column), sb_sheet_number(sheet, row, y_column));
    if (made.incomplete) status = sb_fail_memory(error, "a curve");
    if (status == SB_OK && made.count == 0) status = sb_fail(error, SB_BAD_INPUT, "no rows of %s", where ? where : y);
    if (status != SB_OK)
        sb_curve_free(&made);
    else
        *curve = made;
    return status;
}

#include "physics/number_rows.h"

#include "base/columns.h"
#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 64 << 20, NUMBER_LIMIT = 1000000000, COLUMNS_MAX = 8 };

typedef struct reading {
    const char *path, *expected;
    size_t columns;
    bool begun; /* a row or a line of names was read */
    size_t rows;
    sb_number_row *take;
    void *context;
} reading;

static size_t cell_length(const char *at)
{
    return strcspn(at, " \t\r,;");
}

/* Reads a number at *at and moves *at behind it and behind its separator. False, and *at as it was, if there is none.
 */
static bool read_number(char **at, double *value)
{
    const size_t length = cell_length(*at);
    char *end = *at + length, *stop;
    if (length == 0 || strspn(*at, "+-.0123456789eE") != length) return false;
    *value = strtod(*at, &stop);
    if (stop != end || !(fabs(*value) <= NUMBER_LIMIT)) return false;
    *at = end + strspn(end, " \t\r");
    if (**at == ',' || **at == ';') *at += 1 + strspn(*at + 1, " \t\r");
    return true;
}

/* found: numbers before `at`, where there is no further one or one too many. */
static sb_status refuse_line(const reading *r, size_t number, size_t found, const char *at, sb_error *error)
{
    const int shown = (int)cell_length(at) < 40 ? (int)cell_length(at) : 40;
    if (found == r->columns)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\" is one value too many, expected %zu numbers: \"%s\"",
                       r->path, number, shown, at, r->columns, r->expected);
    if (shown > 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\" is no number below 1e9, expected %zu numbers: \"%s\"",
                       r->path, number, shown, at, r->columns, r->expected);
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: value %zu is missing, expected %zu numbers: \"%s\"", r->path,
                   number, found + 1, r->columns, r->expected);
}

/* Fills units with the unit of each column, which `expected` has in parentheses. */
static void find_units(const char *expected, char units[COLUMNS_MAX + 1])
{
    size_t count = 0;
    for (const char *at = expected; count < COLUMNS_MAX && (at = strchr(at, '(')); at++)
        units[count++] = at[2] == ')' ? at[1] : '-';
    units[count] = '\0';
}

static sb_status check_header(const reading *r, size_t number, const char *line, sb_error *error)
{
    char units[COLUMNS_MAX + 1];
    const char *unit = sb_columns_unit(line, strlen(line));
    if (unit)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: its header names the unit %s, expected \"%s\"", r->path,
                       number, unit, r->expected);
    find_units(r->expected, units);
    const size_t column = sb_columns_misplaced(line, strlen(line), units);
    const size_t named = sb_columns_misnamed(line, strlen(line), r->expected);
    if (column == 0 && named == 0) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: column %zu has another %s in the header, expected \"%s\"", r->path,
                   number, column > 0 ? column : named, column > 0 ? "unit" : "name", r->expected);
}

/* Reads one line without its newline. A comment or an empty line is no row. */
static sb_status read_line(reading *r, char *line, size_t number, sb_error *error)
{
    double values[COLUMNS_MAX];
    size_t found = 0;
    char *at = line + strspn(line, " \t\r");
    at[strcspn(at, "#")] = '\0';
    if (!*at) return SB_OK;
    const bool first = !r->begun;
    r->begun = true;
    if (first && sb_columns_header(at, strlen(at))) return check_header(r, number, at, error);
    while (found < r->columns && read_number(&at, &values[found])) found++;
    if (found < r->columns || *at) return refuse_line(r, number, found, at, error);
    r->rows++;
    return r->take(r->context, number, values, error);
}

/* Finds the first byte that no text has, and its line. */
static bool find_control(const char *text, size_t length, size_t *line, unsigned *byte)
{
    *line = 1;
    for (size_t i = 0; i < length; i++) {
        *byte = (unsigned char)text[i];
        if (*byte == '\n') ++*line;
        if (*byte == 0x7f || (*byte < ' ' && !(*byte >= '\t' && *byte <= '\r'))) return true;
    }
    return false;
}

static sb_status read_text(const char *path, char **text, sb_error *error)
{
    char *read = NULL;
    size_t length, line;
    unsigned byte;
    sb_status status = sb_text_read(path, FILE_LIMIT, &read, &length, error);
    if (status == SB_OK && find_control(read, length, &line, &byte))
        status =
            byte == 0
                ? sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: contains a zero byte, expected a text table", path, line)
                : sb_fail(error, SB_BAD_INPUT,
                          "%.500s:%zu: contains the control character 0x%02x, expected a text table", path, line, byte);
    if (status == SB_OK)
        *text = read;
    else
        sb_free(read);
    return status;
}

sb_status sb_number_rows_visit(const char *path, size_t columns, size_t least, const char *expected,
                               sb_number_row *take, void *context, sb_error *error)
{
    char *text = NULL;
    size_t number = 1;
    reading r = {.path = path, .expected = expected, .columns = columns, .take = take, .context = context};
    sb_status status = read_text(path, &text, error);
    for (char *line = text; status == SB_OK && line; number++) {
        char *newline = strchr(line, '\n');
        if (newline) *newline = '\0';
        status = read_line(&r, line, number, error);
        line = newline ? newline + 1 : NULL;
    }
    sb_free(text);
    if (status != SB_OK || r.rows >= least) return status;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %zu row%s, expected at least %zu: \"%s\"", path, number - 1,
                   r.rows, r.rows == 1 ? "" : "s", least, expected);
}

typedef struct list {
    const char *path;
    size_t columns, values_capacity, lines_capacity;
    sb_number_rows rows;
} list;

static sb_status add_row(void *context, size_t line, const double *values, sb_error *error)
{
    list *l = context;
    sb_number_rows *rows = &l->rows;
    const size_t end = l->columns * (rows->count + 1);
    if (sb_grow((void **)&rows->values, &l->values_capacity, end, sizeof *values) != 0 ||
        sb_grow((void **)&rows->lines, &l->lines_capacity, rows->count + 1, sizeof line) != 0)
        return sb_fail_memory(error, l->path);
    memcpy(rows->values + end - l->columns, values, l->columns * sizeof *values);
    rows->lines[rows->count++] = line;
    return SB_OK;
}

sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, sb_number_rows *rows,
                              sb_error *error)
{
    list l = {.path = path, .columns = columns};
    const sb_status status = sb_number_rows_visit(path, columns, 1, expected, add_row, &l, error);
    if (status != SB_OK) sb_number_rows_free(&l.rows);
    *rows = l.rows;
    return status;
}

void sb_number_rows_free(sb_number_rows *rows)
{
    sb_free(rows->values);
    sb_free(rows->lines);
    *rows = (sb_number_rows){0};
}

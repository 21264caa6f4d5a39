#include "physics/wavemakers/number_rows.h"

#include "base/columns.h"
#include "base/memory.h"
#include "base/rows.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS_MAX = 8 };

typedef struct reading {
    const char *expected;
    size_t columns;
    bool begun; /* a row or a line of names was read */
    size_t count;
    sb_number_row *take;
    void *context;
} reading;

/* Fills units with the unit of each column, which `expected` has in parentheses. */
static void find_units(const char *expected, char units[COLUMNS_MAX + 1])
{
    size_t count = 0;
    for (const char *at = expected; count < COLUMNS_MAX && (at = strchr(at, '(')); at++)
        units[count++] = at[2] == ')' ? at[1] : '-';
    units[count] = '\0';
}

static sb_status check_header(const reading *r, const sb_rows *rows, const char *line, sb_error *error)
{
    char units[COLUMNS_MAX + 1];
    const char *unit = sb_columns_unit(line, strlen(line));
    if (unit)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: its header names the unit %s, expected \"%s\"", rows->path,
                       rows->line, unit, r->expected);
    find_units(r->expected, units);
    const size_t column = sb_columns_misplaced(line, strlen(line), units);
    const size_t named = sb_columns_misnamed(line, strlen(line), r->expected);
    if (column == 0 && named == 0) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: column %zu has another %s in the header, expected \"%s\"",
                   rows->path, rows->line, column > 0 ? column : named, column > 0 ? "unit" : "name", r->expected);
}

/* Removes blanks and one separator at the end, which begin no cell. */
static void cut_end(char *line)
{
    static const char blanks[] = " \t\r";
    size_t length = strlen(line);
    while (length > 0 && strchr(blanks, line[length - 1])) length--;
    if (length > 0 && strchr(",;", line[length - 1])) length--;
    line[length] = '\0';
}

/* Reads a line. A comment is no row. */
static sb_status read_line(reading *r, sb_rows *rows, char *line, sb_error *error)
{
    double values[COLUMNS_MAX];
    line[strcspn(line, "#")] = '\0';
    if (!*line) return SB_OK;
    const bool first = !r->begun;
    r->begun = true;
    if (first && sb_columns_header(line, strlen(line))) return check_header(r, rows, line, error);
    cut_end(line);
    sb_status status = sb_rows_cut(rows, line, error);
    if (status == SB_OK && rows->cell_count != r->columns)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: has %zu value%s, expected %zu: \"%s\"", rows->path,
                         rows->line, rows->cell_count, rows->cell_count == 1 ? "" : "s", r->columns, r->expected);
    for (size_t i = 0; status == SB_OK && i < r->columns; i++) {
        char what[200];
        snprintf(what, sizeof what, "value %zu of \"%s\"", i + 1, r->expected);
        status = sb_rows_number(rows, i, what, &values[i], error);
    }
    if (status != SB_OK) return status;
    r->count++;
    return r->take(r->context, rows->line, values, error);
}

sb_status sb_number_rows_visit(const char *path, size_t columns, size_t least, const char *expected,
                               sb_number_row *take, void *context, sb_error *error)
{
    sb_rows rows;
    reading r = {.expected = expected, .columns = columns, .take = take, .context = context};
    sb_status status = sb_rows_open(path, &rows, error);
    for (char *line; status == SB_OK && (line = sb_rows_next(&rows));) status = read_line(&r, &rows, line, error);
    if (status == SB_OK && r.count < least)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %zu row%s, expected at least %zu: \"%s\"", path, rows.line,
                         r.count, r.count == 1 ? "" : "s", least, expected);
    sb_rows_close(&rows);
    return status;
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

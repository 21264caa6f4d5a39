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

/* Reads a number at *at and moves *at behind it and behind its separator. False if there is none. */
static bool read_number(char **at, double *value)
{
    char *end = *at + strcspn(*at, " \t\r,;");
    if (end == *at || strspn(*at, "+-.0123456789eE") != (size_t)(end - *at)) return false;
    char *stop;
    *value = strtod(*at, &stop);
    *at = end + strspn(end, " \t\r");
    if (**at == ',' || **at == ';') *at += 1 + strspn(*at + 1, " \t\r");
    return stop == end && fabs(*value) <= NUMBER_LIMIT;
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
    if (first && sb_columns_header(at, strlen(at))) {
        const char *unit = sb_columns_unit(at, strlen(at));
        if (!unit) return SB_OK;
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: its header names the unit %s, expected seconds and metres",
                       r->path, number, unit);
    }
    while (found < r->columns && read_number(&at, &values[found])) found++;
    if (found < r->columns || *at)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: expected %zu numbers below 1e9, \"%s\"", r->path, number,
                       r->columns, r->expected);
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
    size_t columns, count, capacity; /* count: numbers */
    double *values;
} list;

static sb_status add_row(void *context, size_t line, const double *values, sb_error *error)
{
    list *l = context;
    (void)line;
    if (sb_grow((void **)&l->values, &l->capacity, l->count + l->columns, sizeof *values) != 0)
        return sb_fail_memory(error, l->path);
    memcpy(l->values + l->count, values, l->columns * sizeof *values);
    l->count += l->columns;
    return SB_OK;
}

sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, double **values, size_t *rows,
                              sb_error *error)
{
    list l = {.path = path, .columns = columns};
    sb_status status = sb_number_rows_visit(path, columns, 1, expected, add_row, &l, error);
    if (status != SB_OK) {
        sb_free(l.values);
        return status;
    }
    *values = l.values;
    *rows = l.count / columns;
    return SB_OK;
}

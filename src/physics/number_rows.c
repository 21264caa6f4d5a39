#include "physics/number_rows.h"

#include "base/columns.h"
#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 64 << 20, NUMBER_LIMIT = 1000000000 };

typedef struct reading {
    const char *path, *expected;
    size_t columns, count, capacity; /* count: numbers */
    double *values;
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

static sb_status read_line(reading *r, char *line, size_t number, bool *header, sb_error *error)
{
    char *at = line + strspn(line, " \t\r");
    at[strcspn(at, "#")] = '\0';
    if (!*at) return SB_OK;
    if (r->count == 0 && !*header && sb_columns_header(at, strlen(at))) {
        *header = true;
        const char *unit = sb_columns_unit(at, strlen(at));
        if (!unit) return SB_OK;
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: its header names the unit %s, expected seconds and metres",
                       r->path, number, unit);
    }
    if (sb_grow((void **)&r->values, &r->capacity, r->count + r->columns, sizeof *r->values) != 0)
        return sb_fail_memory(error, r->path);
    size_t found = 0;
    while (found < r->columns && read_number(&at, &r->values[r->count + found])) found++;
    if (found < r->columns || *at)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: expected %zu numbers below 1e9, \"%s\"", r->path, number,
                       r->columns, r->expected);
    r->count += found;
    return SB_OK;
}

sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, double **values, size_t *rows,
                              sb_error *error)
{
    char *text = NULL;
    size_t length, number = 1;
    bool header = false;
    reading r = {.path = path, .expected = expected, .columns = columns};
    sb_status status = sb_text_read(path, FILE_LIMIT, &text, &length, error);
    for (char *line = text; status == SB_OK && line; number++) {
        char *newline = strchr(line, '\n');
        if (newline) *newline = '\0';
        status = read_line(&r, line, number, &header, error);
        line = newline ? newline + 1 : NULL;
    }
    if (status == SB_OK && r.count == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: no rows, expected \"%s\"", path, expected);
    sb_free(text);
    if (status == SB_OK) {
        *values = r.values;
        *rows = r.count / columns;
    } else {
        sb_free(r.values);
    }
    return status;
}

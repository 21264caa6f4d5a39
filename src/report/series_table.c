#include "report/series_table.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LIMIT = 1 << 30, NAME_MAX_BYTES = 256 };

/* Takes the cell at *at, which may be quoted, and moves *at behind its comma. Returns false at the end of the line. */
static bool take_cell(const char **at, char *cell, size_t room)
{
    const char *from = *at;
    size_t length = 0;
    if (!from) return false;
    const bool quoted = *from == '"';
    for (from += quoted; *from && (quoted || *from != ','); from++) {
        if (quoted && *from == '"' && *++from != '"') break;
        if (length + 1 < room) cell[length++] = *from;
    }
    cell[length] = '\0';
    *at = *from == ',' ? from + 1 : NULL;
    return true;
}

static bool take_number(const char **at, double *value)
{
    char *end;
    *value = NAN;
    if (!*at) return false;
    if (**at != ',' && **at) {
        *value = strtod(*at, &end);
        if (end == *at || !isfinite(*value)) return false;
        *at = end;
    }
    if (**at != ',' && **at) return false;
    *at = **at == ',' ? *at + 1 : NULL;
    return true;
}

static sb_status read_header(const char *path, const char *line, size_t columns, bool named, sb_series_table *table,
                             sb_error *error)
{
    char cell[NAME_MAX_BYTES];
    if (strncmp(line, "time_s,", 7) != 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: line 1: %.60s: expected the header of a run's table, time_s,...",
                       path, line);
    for (size_t c = 0; table->columns < columns && take_cell(&line, cell, sizeof cell); c++) {
        if (named && c == 1) continue;
        if (!(table->names[table->columns] = sb_strdup(cell))) return sb_fail_memory(error, "a table");
        table->columns++;
    }
    return SB_OK;
}

/* guess: the series that probably has this name, since rows of a table take turns. */
static sb_series *series_of(sb_series_table *table, const char *name, size_t guess)
{
    for (size_t i = 0; i < table->count; i++) {
        sb_series *series = &table->series[(guess + i) % table->count];
        if (strcmp(series->name, name) == 0) return series;
    }
    if (sb_grow((void **)&table->series, &table->capacity, table->count + 1, sizeof *table->series) != 0) return NULL;
    sb_series *series = &table->series[table->count];
    *series = (sb_series){.name = sb_strdup(name)};
    if (!series->name) return NULL;
    table->count++;
    return series;
}

/* Returns whether the line is a row; false without an effect otherwise. */
static bool parse_row(const sb_series_table *table, bool named, const char *line, char name[NAME_MAX_BYTES],
                      double values[SB_SERIES_COLUMNS_MAX])
{
    *name = '\0';
    if (!take_number(&line, &values[0]) || isnan(values[0])) return false;
    if (named && !take_cell(&line, name, NAME_MAX_BYTES)) return false;
    for (size_t c = 1; c < table->columns; c++)
        if (!take_number(&line, &values[c])) return false;
    return true;
}

static sb_status read_rows(char *line, bool named, sb_series_table *table, sb_error *error)
{
    char name[NAME_MAX_BYTES];
    double values[SB_SERIES_COLUMNS_MAX];
    size_t guess = 0;
    for (char *end; *line && (end = strchr(line, '\n')); line = end + 1) {
        *end = '\0';
        if (end > line && end[-1] == '\r') end[-1] = '\0';
        if (!parse_row(table, named, line, name, values)) {
            table->damaged++;
            continue;
        }
        sb_series *series = series_of(table, name, guess);
        if (!series) return sb_fail_memory(error, "a table");
        guess = (size_t)(series - table->series) + 1;
        if (series->rows > 0 && values[0] <= sb_series_table_value(table, series, series->rows - 1, 0)) {
            table->damaged++;
            continue;
        }
        const size_t used = series->rows * table->columns;
        if (sb_grow((void **)&series->values, &series->capacity, used + table->columns, sizeof *values) != 0)
            return sb_fail_memory(error, "a table");
        memcpy(series->values + used, values, table->columns * sizeof *values);
        series->rows++;
    }
    return SB_OK;
}

sb_status sb_series_table_read(const char *path, size_t columns, bool named, sb_series_table *table, sb_error *error)
{
    sb_series_table made = {0};
    char *text = NULL;
    size_t length = 0;
    if (columns > SB_SERIES_COLUMNS_MAX) columns = SB_SERIES_COLUMNS_MAX;
    sb_status status = sb_text_read(path, LIMIT, &text, &length, error);
    if (status != SB_OK) return status;
    char *first = text, *end = strchr(text, '\n');
    if (end) *end = '\0';
    if (end && end > first && end[-1] == '\r') end[-1] = '\0';
    status = read_header(path, first, columns, named, &made, error);
    if (status == SB_OK && end) status = read_rows(end + 1, named, &made, error);
    sb_free(text);
    if (status == SB_OK)
        *table = made;
    else
        sb_series_table_free(&made);
    return status;
}

void sb_series_table_free(sb_series_table *table)
{
    for (size_t c = 0; c < SB_SERIES_COLUMNS_MAX; c++) sb_free(table->names[c]);
    for (size_t i = 0; i < table->count; i++) {
        sb_free(table->series[i].name);
        sb_free(table->series[i].values);
    }
    sb_free(table->series);
    *table = (sb_series_table){0};
}

const sb_series *sb_series_table_find(const sb_series_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; i++)
        if (strcmp(table->series[i].name, name) == 0) return &table->series[i];
    return NULL;
}

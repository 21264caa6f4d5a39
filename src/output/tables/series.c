#include "output/tables/series.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sb_series_free(sb_series *series)
{
    sb_free(series->names);
    sb_free(series->rows);
    *series = (sb_series){0};
}

/* Copies the field at *at into out, without quotes. Moves *at behind its comma; NULL at the line's end. */
static void take_field(const char **at, const char *end, char *out, size_t size)
{
    const char *c = *at;
    size_t n = 0;
    bool quoted = c < end && *c == '"';
    for (c += quoted; c < end; c++) {
        if (quoted && *c == '"') {
            if (c + 1 < end && c[1] == '"')
                c++;
            else {
                quoted = false;
                continue;
            }
        } else if (!quoted && *c == ',')
            break;
        if (n + 1 < size) out[n++] = *c;
    }
    out[n] = '\0';
    *at = c < end ? c + 1 : NULL;
}

static sb_status find_name(sb_series *series, const char *name, size_t *index, sb_error *error)
{
    size_t n = series->name_count;
    /* Names repeat in the same order, so the name after the last one is tried first. */
    size_t guess = series->row_count ? series->rows[series->row_count - 1].name + 1 : 0;
    for (size_t k = 0; k < n; k++) {
        *index = (guess + k) % n;
        if (strcmp(series->names[*index], name) == 0) return SB_OK;
    }
    if (sb_grow((void **)&series->names, &series->name_capacity, n + 1, sizeof *series->names) != 0)
        return sb_fail_memory(error, "plots");
    snprintf(series->names[n], SB_SERIES_NAME, "%s", name);
    *index = n;
    series->name_count++;
    return SB_OK;
}

static sb_status take_row(sb_series *series, const char *line, const char *end, bool named, sb_error *error)
{
    char field[256];
    sb_series_row row = {0};
    for (int k = 0; k < SB_SERIES_COLUMNS; k++) {
        row.values[k] = (double)NAN;
        if (!line) continue;
        take_field(&line, end, field, sizeof field);
        if (k == 0 && !named) {
            sb_status status = find_name(series, "", &row.name, error);
            if (status != SB_OK) return status;
        }
        if (k == 1 && named) {
            sb_status status = find_name(series, field, &row.name, error);
            if (status != SB_OK) return status;
        } else if (field[0])
            row.values[k] = strtod(field, NULL);
    }
    if (sb_grow((void **)&series->rows, &series->row_capacity, series->row_count + 1, sizeof *series->rows) != 0)
        return sb_fail_memory(error, "plots");
    series->rows[series->row_count++] = row;
    return SB_OK;
}

sb_status sb_series_read(const char *path, bool named, sb_series *series, sb_error *error)
{
    char *text;
    size_t length;
    sb_series made = {0};
    sb_status status = sb_text_read(path, (size_t)1 << 32, &text, &length, error);
    if (status != SB_OK) return status;
    const char *line = strchr(text, '\n');
    for (line = line ? line + 1 : NULL; status == SB_OK && line && *line;) {
        const char *end = strchr(line, '\n');
        if (!end) break;
        status = take_row(&made, line, end, named, error);
        line = end + 1;
    }
    sb_free(text);
    if (status != SB_OK)
        sb_series_free(&made);
    else
        *series = made;
    return status;
}

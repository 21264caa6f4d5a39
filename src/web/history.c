#include "web/history.h"

#include "base/memory.h"
#include "output/log/json.h"

#include <math.h>
#include <string.h>

/* 16 MB of values at most, however many bodies there are; and no more rows than a plot can show. */
enum { VALUES_MAX = 1 << 22, ROWS_MAX = 8192, ROWS_MIN = 64 };

void sb_history_clear(sb_history_table *table)
{
    sb_free(table->name);
    sb_free(table->time);
    sb_free(table->value);
    *table = (sb_history_table){.components = table->components, .stride = 1, .generation = table->generation + 1};
}

void sb_history_free(sb_history_table *table)
{
    sb_history_clear(table);
    *table = (sb_history_table){.components = table->components};
}

static size_t width_of(const sb_history_table *table)
{
    return table->names * (size_t)table->components;
}

static bool last_is_complete(const sb_history_table *table)
{
    return table->filled >= table->names && table->merged >= table->stride;
}

size_t sb_history_count(const sb_history_table *table)
{
    return table->rows > 0 && !last_is_complete(table) ? table->rows - 1 : table->rows;
}

void sb_history_cut(sb_history_table *table, double time)
{
    const size_t before = table->rows;
    while (table->rows > 0 && table->time[table->rows - 1] >= time) table->rows--;
    if (table->rows == before) return;
    table->filled = table->names;
    table->merged = table->stride;
    table->generation++;
}

static bool start(sb_history_table *table, size_t names)
{
    sb_history_clear(table);
    table->names = names;
    const size_t width = width_of(table);
    table->capacity = VALUES_MAX / width;
    if (table->capacity > ROWS_MAX) table->capacity = ROWS_MAX;
    if (table->capacity < ROWS_MIN) table->capacity = ROWS_MIN;
    table->name = sb_alloc(names, sizeof *table->name);
    table->time = sb_alloc_untouched(table->capacity, sizeof *table->time);
    table->value = sb_alloc_untouched(table->capacity * width, sizeof *table->value);
    if (table->name && table->time && table->value) return true;
    sb_history_clear(table);
    return false;
}

/* Of two values the one with the larger magnitude: a plot must not lose the peak. */
static float larger(float a, float b)
{
    return !(fabsf(a) >= fabsf(b)) && !isnan(b) ? b : a;
}

static void halve(sb_history_table *table)
{
    const size_t width = width_of(table);
    for (size_t r = 0; r + 1 < table->rows; r += 2) {
        const float *a = table->value + r * width, *b = a + width;
        float *to = table->value + r / 2 * width;
        for (size_t i = 0; i < width; i++) to[i] = larger(a[i], b[i]);
        table->time[r / 2] = table->time[r];
    }
    table->rows /= 2;
    table->stride *= 2;
    table->merged = table->stride;
    table->filled = table->names;
    table->generation++;
}

/* Makes room for the values of this time: in the last row, or in a new one. */
static void begin_row(sb_history_table *table, double time)
{
    const bool merges = table->rows > 0 && table->merged < table->stride;
    table->filled = 0;
    if (merges) {
        table->merged++;
        return;
    }
    if (table->rows == table->capacity) halve(table);
    table->filled = 0;
    table->merged = 1;
    float *row = table->value + table->rows * width_of(table);
    for (size_t i = 0; i < width_of(table); i++) row[i] = NAN;
    table->time[table->rows++] = time;
}

static bool has_other_names(const sb_history_table *table, const sb_history_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++)
        if (*table->name[rows->first + i] && strcmp(table->name[rows->first + i], rows->name[i]) != 0) return true;
    return false;
}

void sb_history_add(sb_history_table *table, const sb_history_rows *rows)
{
    if (rows->total == 0 || rows->first + rows->count > rows->total) return;
    if ((table->names != rows->total || has_other_names(table, rows)) && !start(table, rows->total)) return;
    /* The first part of a time begins a row; if it was lost, so does any part after a complete row. */
    if (rows->first == 0 || table->rows == 0 || table->filled >= table->names) begin_row(table, rows->time);
    const size_t components = (size_t)table->components;
    float *at = table->value + (table->rows - 1) * width_of(table) + rows->first * components;
    for (size_t i = 0; i < rows->count * components; i++) at[i] = larger(at[i], rows->value[i]);
    for (size_t i = 0; i < rows->count; i++) memcpy(table->name[rows->first + i], rows->name[i], sizeof *table->name);
    table->filled = rows->first + rows->count;
}

static void write_row(const sb_history_table *table, size_t row, FILE *stream)
{
    const size_t width = width_of(table);
    fprintf(stream, "[%.9g", table->time[row]);
    for (size_t i = 0; i < width; i++) {
        const double value = (double)table->value[row * width + i];
        if (isfinite(value))
            fprintf(stream, ",%.6g", value);
        else
            fputs(",null", stream);
    }
    fputc(']', stream);
}

void sb_history_write(const sb_history_table *table, uint64_t generation, size_t from, size_t limit, FILE *stream)
{
    const size_t count = sb_history_count(table);
    if (generation != table->generation || from > count) from = 0;
    sb_json json;
    sb_json_begin(&json, stream, false);
    sb_json_open(&json, NULL, '{');
    sb_json_count(&json, "generation", table->generation);
    sb_json_count(&json, "from", from);
    sb_json_count(&json, "stride", table->stride);
    sb_json_open(&json, "names", '[');
    for (size_t i = 0; i < table->names; i++) sb_json_text(&json, NULL, table->name[i]);
    sb_json_close(&json);
    fputs(",\"rows\":[", stream);
    const long begin = ftell(stream);
    size_t row = from;
    for (; row < count && (size_t)(ftell(stream) - begin) < limit; row++) {
        if (row > from) fputc(',', stream);
        write_row(table, row, stream);
    }
    fputc(']', stream);
    sb_json_bool(&json, "more", row < count);
    sb_json_close(&json);
}

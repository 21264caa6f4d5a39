#include "rows.h"

#include "base/file.h"
#include "base/memory.h"
#include "sheet.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char header[] = "subject,particles,threads,quantity,unit,least,median,most,repeats\n";

void sb_bench_sample(sb_bench_samples *samples, double value)
{
    if (samples->count < SB_BENCH_REPEATS_MAX) samples->value[samples->count++] = value;
}

static void append(sb_bench_rows *to, const sb_bench_row *row)
{
    to->incomplete |= sb_grow((void **)&to->rows, &to->capacity, to->count + 1, sizeof *to->rows) != 0;
    if (!to->incomplete) to->rows[to->count++] = *row;
}

sb_status sb_bench_complete(const sb_bench_rows *rows, sb_error *error)
{
    return rows->incomplete ? sb_fail_memory(error, "measured rows") : SB_OK;
}

double sb_bench_median(const sb_bench_samples *samples)
{
    sb_bench_samples sorted = *samples;
    return sb_median(sorted.value, (size_t)sorted.count);
}

void sb_bench_add(sb_bench_rows *rows, const char *subject, size_t particles, int threads, const char *quantity,
                  const char *unit, const sb_bench_samples *samples, double factor)
{
    sb_spread spread = sb_spread_none;
    sb_bench_row row = {.particles = particles, .threads = threads, .repeats = samples->count};
    snprintf(row.subject, sizeof row.subject, "%s", subject);
    snprintf(row.quantity, sizeof row.quantity, "%s", quantity);
    snprintf(row.unit, sizeof row.unit, "%s", unit);
    for (int i = 0; i < samples->count; i++) sb_spread_add(&spread, factor * samples->value[i]);
    row.least = spread.low;
    row.most = spread.high;
    row.median = factor * sb_bench_median(samples);
    append(rows, &row);
}

void sb_bench_add_value(sb_bench_rows *rows, const char *subject, size_t particles, int threads, const char *quantity,
                        const char *unit, double value)
{
    const sb_bench_samples one = {.value = {value}, .count = 1};
    sb_bench_add(rows, subject, particles, threads, quantity, unit, &one, 1);
}

void sb_bench_add_values(sb_bench_rows *rows, const char *subject, size_t particles, int threads,
                         const sb_bench_value *values, size_t count)
{
    for (size_t v = 0; v < count; v++)
        sb_bench_add_value(rows, subject, particles, threads, values[v].quantity, values[v].unit, values[v].value);
}

void sb_bench_rows_free(sb_bench_rows *rows)
{
    sb_free(rows->rows);
    *rows = (sb_bench_rows){0};
}

const sb_bench_row *sb_bench_find(const sb_bench_rows *rows, const char *subject, size_t particles, int threads,
                                  const char *quantity)
{
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (strcmp(row->subject, subject) == 0 && strcmp(row->quantity, quantity) == 0 &&
            (particles == 0 || row->particles == particles) && (threads == 0 || row->threads == threads))
            return row;
    }
    return NULL;
}

static void put_origin(FILE *out, const char *origin)
{
    for (const char *line = origin; *line;) {
        const size_t length = strcspn(line, "\n");
        fprintf(out, "# %.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

sb_status sb_bench_write(const sb_bench_rows *rows, const char *origin, const char *path, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    put_origin(file.stream, origin);
    fputs(header, file.stream);
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        sb_sheet_put(file.stream, row->subject);
        fprintf(file.stream, ",%zu,%d,", row->particles, row->threads);
        sb_sheet_put(file.stream, row->quantity);
        fprintf(file.stream, ",%s,%.6g,%.6g,%.6g,%d\n", row->unit, row->least, row->median, row->most, row->repeats);
    }
    return sb_atomic_commit(&file, 0, error);
}

static sb_status read_origin(const char *path, char *origin, size_t size, sb_error *error)
{
    char *text = NULL;
    size_t length, used = 0;
    sb_status status = sb_file_read(path, (size_t)1 << 26, &text, &length, error);
    origin[0] = '\0';
    for (const char *line = text; status == SB_OK && strncmp(line, "# ", 2) == 0 && used + 1 < size;) {
        const size_t end = strcspn(line, "\n");
        used += (size_t)snprintf(origin + used, size - used, "%.*s\n", (int)(end - 2), line + 2);
        line += end + (line[end] == '\n');
    }
    sb_free(text);
    return status;
}

/* Reads a count from a column. SB_BAD_INPUT: the error names the row. */
static sb_status count_of(const sb_sheet *sheet, size_t r, size_t column, const char *path, size_t *count,
                          sb_error *error)
{
    const double value = sb_sheet_number(sheet, r, column);
    if (!(value >= 0 && value < 1e9))
        return sb_fail(error, SB_BAD_INPUT, "%.400s: row %zu: %s: \"%.40s\", expected a number from 0 to 1e9", path,
                       r + 1, sheet->fields[column], sb_sheet_text(sheet, r, column));
    *count = (size_t)value;
    return SB_OK;
}

static sb_bench_row row_of(const sb_sheet *sheet, size_t r)
{
    sb_bench_row row = {.least = sb_sheet_number(sheet, r, 5),
                        .median = sb_sheet_number(sheet, r, 6),
                        .most = sb_sheet_number(sheet, r, 7)};
    snprintf(row.subject, sizeof row.subject, "%s", sb_sheet_text(sheet, r, 0));
    snprintf(row.quantity, sizeof row.quantity, "%s", sb_sheet_text(sheet, r, 3));
    snprintf(row.unit, sizeof row.unit, "%s", sb_sheet_text(sheet, r, 4));
    return row;
}

sb_status sb_bench_read(sb_bench_rows *rows, char *origin, size_t size, bool *found, const char *path, sb_error *error)
{
    enum { COLUMNS = 9 };
    sb_sheet sheet = {0};
    origin[0] = '\0';
    *found = access(path, R_OK) == 0;
    if (!*found) return SB_OK;
    sb_status status = read_origin(path, origin, size, error);
    if (status == SB_OK) status = sb_sheet_read(path, &sheet, error);
    if (status == SB_OK && sheet.columns != COLUMNS)
        status = sb_fail(error, SB_BAD_INPUT, "%.400s: %zu columns, expected %d", path, sheet.columns, COLUMNS);
    for (size_t r = 0; status == SB_OK && r < sheet.rows; r++) {
        sb_bench_row row = row_of(&sheet, r);
        size_t threads = 0, repeats = 0;
        status = count_of(&sheet, r, 1, path, &row.particles, error);
        if (status == SB_OK) status = count_of(&sheet, r, 2, path, &threads, error);
        if (status == SB_OK) status = count_of(&sheet, r, 8, path, &repeats, error);
        row.threads = (int)threads;
        row.repeats = (int)repeats;
        if (status == SB_OK) append(rows, &row);
    }
    if (status == SB_OK) status = sb_bench_complete(rows, error);
    sb_sheet_free(&sheet);
    if (status != SB_OK) sb_bench_rows_free(rows);
    return status;
}

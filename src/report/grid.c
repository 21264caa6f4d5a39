#include "report/grid.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LIMIT = 1 << 30, CELLS_MAX = 1 << 26 };

/* ---- reading ---- */

static sb_status read_head(const char *path, const char **at, sb_grid *grid, double *missing, sb_error *error)
{
    double columns = 0, rows = 0;
    const struct {
        const char *name;
        double *value;
    } heads[] = {{"ncols", &columns},         {"nrows", &rows},          {"xllcorner", &grid->x_min},
                 {"yllcorner", &grid->y_min}, {"cellsize", &grid->cell}, {"NODATA_value", missing}};
    for (size_t h = 0; h < sizeof heads / sizeof *heads; h++) {
        const size_t length = strlen(heads[h].name);
        char *end = NULL;
        if (strncmp(*at, heads[h].name, length) == 0) *heads[h].value = strtod(*at + length, &end);
        if (!end || *end != '\n' || !isfinite(*heads[h].value))
            return sb_fail(error, SB_BAD_INPUT, "%.500s: line %zu: expected %s and a number", path, h + 1,
                           heads[h].name);
        *at = end + 1;
    }
    if (!(columns >= 1 && rows >= 1 && columns * rows <= CELLS_MAX && grid->cell > 0))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %g x %g cells of %g m: expected 1 to %d cells, larger than 0",
                       path, columns, rows, grid->cell, CELLS_MAX);
    grid->columns = (size_t)columns;
    grid->rows = (size_t)rows;
    return SB_OK;
}

static void find_range(sb_grid *grid)
{
    grid->low = INFINITY;
    grid->high = -INFINITY;
    grid->wet = 0;
    for (size_t i = 0; i < grid->columns * grid->rows; i++) {
        const double value = (double)grid->values[i];
        if (isnan(value)) continue;
        grid->low = fmin(grid->low, value);
        grid->high = fmax(grid->high, value);
        grid->wet++;
    }
    if (grid->wet == 0) grid->low = grid->high = 0;
}

sb_status sb_grid_read(const char *path, sb_grid *grid, sb_error *error)
{
    sb_grid made = {0};
    char *text = NULL;
    size_t length = 0;
    double missing = -9999;
    sb_status status = sb_text_read(path, LIMIT, &text, &length, error);
    if (status != SB_OK) return status;
    const char *at = text;
    status = read_head(path, &at, &made, &missing, error);
    const size_t cells = made.columns * made.rows;
    if (status == SB_OK && !(made.values = sb_alloc(cells, sizeof *made.values)))
        status = sb_fail_memory(error, "a map");
    for (size_t i = 0; status == SB_OK && i < cells; i++) {
        char *end;
        const double value = strtod(at, &end);
        if (end == at || !isfinite(value))
            status =
                sb_fail(error, SB_BAD_INPUT, "%.500s: value %zu is no number: expected %zu values", path, i + 1, cells);
        made.values[i] = value == missing ? NAN : (float)value;
        at = end;
    }
    sb_free(text);
    if (status == SB_OK) {
        find_range(&made);
        *grid = made;
    } else
        sb_grid_free(&made);
    return status;
}

void sb_grid_free(sb_grid *grid)
{
    sb_free(grid->values);
    *grid = (sb_grid){0};
}

/* ---- picture ---- */

static sb_status halve(sb_grid *grid, sb_error *error)
{
    const size_t columns = (grid->columns + 1) / 2, rows = (grid->rows + 1) / 2, odd = grid->rows % 2;
    float *values = sb_alloc(columns * rows, sizeof *values);
    if (!values) return sb_fail_memory(error, "a map");
    for (size_t i = 0; i < columns * rows; i++) values[i] = NAN;
    for (size_t row = 0; row < grid->rows; row++) /* pairs begin in the south, at y_min */
        for (size_t column = 0; column < grid->columns; column++) {
            float *to = &values[(row + odd) / 2 * columns + column / 2];
            *to = fmaxf(*to, grid->values[row * grid->columns + column]);
        }
    sb_free(grid->values);
    grid->values = values;
    grid->columns = columns;
    grid->rows = rows;
    grid->cell *= 2;
    return SB_OK;
}

sb_status sb_grid_coarsen(sb_grid *grid, size_t most, sb_error *error)
{
    sb_status status = SB_OK;
    while (status == SB_OK && (grid->columns > most || grid->rows > most)) status = halve(grid, error);
    return status;
}

sb_stops sb_stops_of(const char *palette)
{
    sb_stops stops = {0};
    for (const char *at = palette; at && stops.count < SB_STOPS_MAX;) {
        unsigned rgb = 0;
        if (sscanf(at, "%lf '#%6x'", &stops.at[stops.count], &rgb) != 2) break;
        for (int c = 0; c < 3; c++) stops.rgb[stops.count][c] = (unsigned char)(rgb >> (16 - 8 * c));
        stops.count++;
        at = strchr(at, ',');
        at += at != NULL;
    }
    return stops;
}

static void colour(const sb_stops *stops, double t, unsigned char rgb[3])
{
    size_t k = 0;
    if (stops->count < 2) return;
    while (k + 2 < stops->count && t > stops->at[k + 1]) k++;
    const double s = fmin(fmax((t - stops->at[k]) / (stops->at[k + 1] - stops->at[k]), 0), 1);
    for (int c = 0; c < 3; c++) rgb[c] = (unsigned char)lround((1 - s) * stops->rgb[k][c] + s * stops->rgb[k + 1][c]);
}

sb_status sb_grid_draw(const sb_grid *grid, const sb_stops *stops, double low, double high, sb_image *image,
                       sb_error *error)
{
    static const unsigned char dry[3] = {0xe9, 0xe6, 0xe0};
    const sb_status status = sb_image_resize(image, (int)grid->columns, (int)grid->rows, error);
    if (status != SB_OK) return status;
    const double range = high > low ? high - low : 1;
    for (size_t i = 0; i < grid->columns * grid->rows; i++) {
        memcpy(image->rgb + 3 * i, dry, sizeof dry);
        if (!isnan(grid->values[i])) colour(stops, ((double)grid->values[i] - low) / range, image->rgb + 3 * i);
    }
    return SB_OK;
}

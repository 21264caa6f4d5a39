#include "compare/difference.h"

#include "base/memory.h"
#include "output/maps/esri.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sb_grid_same(const sb_grid *one, const sb_grid *other)
{
    return one->columns == other->columns && one->rows == other->rows && one->cell == other->cell &&
           one->x_min == other->x_min && one->y_min == other->y_min;
}

/* Adds values; a cell that is dry in one of the two counts as 0 there. */
static void add(sb_grid *sum, const sb_grid *grid, float factor)
{
    for (size_t i = 0; i < sum->columns * sum->rows; i++) {
        const float one = sum->values[i], other = grid->values[i];
        if (isnan(one) && isnan(other)) continue;
        sum->values[i] = (isnan(one) ? 0 : one) + factor * (isnan(other) ? 0 : other);
    }
}

static sb_status read_depth(const sb_compared_run *run, sb_grid *grid, sb_error *error)
{
    char path[SB_PATH_MAX];
    const sb_status status = sb_path_join(path, run->run.directory, "maps/max_depth.asc", error);
    return status == SB_OK ? sb_grid_read(path, grid, error) : status;
}

sb_status sb_group_depth(const sb_comparison *comparison, size_t group, sb_grid *depth, sb_error *error)
{
    sb_grid sum = {0};
    sb_status status = SB_OK;
    for (size_t r = 0; r < comparison->count && status == SB_OK; r++) {
        sb_grid grid = {0};
        if (comparison->runs[r].group != group) continue;
        status = read_depth(&comparison->runs[r], &grid, error);
        if (status == SB_OK && !sum.values) {
            sum = grid;
            continue;
        }
        if (status == SB_OK && !sb_grid_same(&sum, &grid))
            status = sb_fail(error, SB_BAD_INPUT, "%.300s: maps/max_depth.asc has other cells than the first run's",
                             comparison->runs[r].run.directory);
        if (status == SB_OK) add(&sum, &grid, 1);
        sb_grid_free(&grid);
    }
    for (size_t i = 0; status == SB_OK && i < sum.columns * sum.rows; i++)
        sum.values[i] /= (float)comparison->group[group].count;
    if (status == SB_OK)
        *depth = sum;
    else
        sb_grid_free(&sum);
    return status;
}

sb_status sb_grid_subtract(const sb_grid *one, const sb_grid *other, sb_grid *difference, sb_error *error)
{
    const size_t cells = one->columns * one->rows;
    sb_grid made = *other;
    made.values = sb_alloc(cells, sizeof *made.values);
    if (!made.values) return sb_fail_memory(error, "a map");
    memcpy(made.values, other->values, cells * sizeof *made.values);
    add(&made, one, -1);
    made.wet = 0;
    made.low = made.high = 0;
    for (size_t i = 0; i < cells; i++) {
        const double value = (double)made.values[i];
        if (isnan(value)) continue;
        made.wet++;
        made.low = fmin(made.low, value);
        made.high = fmax(made.high, value);
    }
    *difference = made;
    return SB_OK;
}

static int by_size(const void *a, const void *b)
{
    const float one = *(const float *)a, other = *(const float *)b;
    return (one > other) - (one < other);
}

double sb_grid_spread(const sb_grid *difference)
{
    float *sizes = sb_alloc(difference->columns * difference->rows, sizeof *sizes);
    size_t count = 0;
    if (!sizes) return fmax(-difference->low, difference->high);
    for (size_t i = 0; i < difference->columns * difference->rows; i++) {
        const float size = fabsf(difference->values[i]);
        if (size > 0) sizes[count++] = size; /* false for NaN */
    }
    if (count > 1) qsort(sizes, count, sizeof *sizes, by_size);
    const double spread = count > 0 ? (double)sizes[count - 1 - count / 100] : 0;
    sb_free(sizes);
    return spread;
}

sb_status sb_grid_write(const char *path, const sb_grid *grid, sb_error *error)
{
    const sb_map_record map = {
        .columns = grid->columns, .rows = grid->rows, .x_min = grid->x_min, .y_min = grid->y_min, .cell = grid->cell};
    float *values = sb_alloc(grid->columns * grid->rows, sizeof *values);
    if (!values) return sb_fail_memory(error, "a map");
    for (size_t row = 0; row < grid->rows; row++) /* a grid's first row is the northernmost, a map's the southernmost */
        memcpy(values + row * grid->columns, grid->values + (grid->rows - 1 - row) * grid->columns,
               grid->columns * sizeof *values);
    const sb_status status = sb_esri_write(path, &map, values, error);
    sb_free(values);
    return status;
}

/* Reads lines "x y z" that form a regular grid, in any order. */
#include "base/columns.h"
#include "base/memory.h"
#include "base/stop.h"
#include "geometry/grid/grid.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Coordinates that differ by less than same_line of their range lie on one grid line. A coordinate may differ from
   its grid line by off_line of the step, because of rounding in the file. */
static const double same_line = 1e-6, off_line = 0.05;

typedef struct point {
    double at[3];
    size_t line;
} point;

typedef struct cloud {
    const char *path;
    point *points;
    size_t count, capacity;
    bool header; /* a line with the columns' names was read */
} cloud;

/* Grid lines along one axis at low + i step, i < count. */
typedef struct axis {
    double low, step;
    size_t count;
} axis;

/* Reads the line that may give the columns' names before the first point. */
static sb_status read_header(cloud *all, const char *text, size_t length, size_t line, sb_error *error)
{
    const size_t skip = strspn(text, " \t\"'");
    const char *word = text + (skip < length ? skip : 0);
    all->header = true;
    if (strncasecmp(word, "y", 1) != 0 && strncasecmp(word, "lat", 3) != 0 && strncasecmp(word, "north", 5) != 0)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: columns \"%.*s\", expected x, y and z in this order", all->path,
                   line, (int)(length < 60 ? length : 60), text);
}

static sb_status read_line(cloud *all, const char *text, size_t length, size_t line, sb_error *error)
{
    static const char blank[] = " \t\r,;";
    const char *at = text + strspn(text, blank), *end = text + length;
    if (at >= end || *at == '#') return SB_OK;
    if (all->count == 0 && !all->header && sb_columns_header(text, length))
        return read_header(all, text, length, line, error);
    if (sb_grow((void **)&all->points, &all->capacity, all->count + 1, sizeof *all->points))
        return sb_fail_memory(error, "a terrain grid");
    point read = {.line = line};
    for (int k = 0; k < 3; ++k) {
        char *after;
        read.at[k] = sb_decimal(at, &after);
        /* strtod skips line ends, so the number must lie within this line. */
        const bool number = isfinite(read.at[k]) || (k == 2 && isnan(read.at[k])); /* a height may be missing */
        if (after == at || after > end || !number || (after < end && !strchr(blank, *after)))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\", expected x y z", all->path, line,
                           (int)(length < 60 ? length : 60), text);
        at = after + strspn(after, blank);
    }
    if (at < end)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\" after x y z, expected the end of the line", all->path,
                       line, (int)(end - at < 40 ? end - at : 40), at);
    all->points[all->count++] = read;
    return SB_OK;
}

static sb_status read_points(cloud *all, const char *text, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t line = 1; *text && status == SB_OK; ++line) {
        size_t length = strcspn(text, "\n");
        status = read_line(all, text, length, line, error);
        if (line % 4096 == 0 && sb_stop_signal()) return sb_stop_fail(error, "while terrain was read");
        text += length + (text[length] == '\n');
    }
    return status;
}

static int compare_numbers(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* Finds the grid lines that the coordinates lie on. The median gap is taken as one step, and larger gaps as
   multiples of it. The step is the range divided by the number of steps, so that rounding cancels. */
static sb_status find_axis(const cloud *all, int k, axis *found, sb_error *error)
{
    double *sorted = sb_alloc_untouched(all->count, sizeof *sorted);
    if (!sorted) return sb_fail_memory(error, "a terrain grid");
    for (size_t i = 0; i < all->count; ++i) sorted[i] = all->points[i].at[k];
    qsort(sorted, all->count, sizeof *sorted, compare_numbers);
    const double low = sorted[0], range = sorted[all->count - 1] - low;
    size_t gaps = 0;
    double last = low;
    for (size_t i = 1; i < all->count; ++i) {
        double here = sorted[i];
        if (here - last > same_line * range) {
            sorted[gaps++] = here - last; /* this part of the array was read already */
            last = here;
        }
    }
    qsort(sorted, gaps, sizeof *sorted, compare_numbers);
    double steps = 0;
    for (size_t i = 0; i < gaps; ++i) steps += round(sorted[i] / sorted[gaps / 2]);
    sb_free(sorted);
    if (!(steps >= 1 && steps < SB_GRID_NODES_MAX))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: %zu points with %zu values of %c, expected the points of a regular grid", all->path,
                       all->count, gaps + 1, "xyz"[k]);
    *found = (axis){low, range / steps, (size_t)steps + 1};
    return SB_OK;
}

/* Returns the number of the grid line that `value` lies on, or count if it lies on none. */
static size_t line_of(const axis *lines, double value)
{
    double place = (value - lines->low) / lines->step, nearest = round(place);
    return fabs(place - nearest) <= off_line ? (size_t)nearest : lines->count;
}

static sb_status place_points(const cloud *all, const axis axes[2], sb_grid *grid, sb_error *error)
{
    for (size_t i = 0; i < grid->columns * grid->rows; ++i) grid->heights[i] = (double)NAN;
    for (size_t i = 0; i < all->count; ++i) {
        const point *p = &all->points[i];
        size_t place[2];
        for (int k = 0; k < 2; ++k) {
            place[k] = line_of(&axes[k], p->at[k]);
            if (place[k] >= axes[k].count)
                return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %c is %.12g, expected %.12g plus a multiple of %.12g",
                               all->path, p->line, "xy"[k], p -> at[k], axes[k].low, axes[k].step);
        }
        double *height = &grid->heights[place[1] * grid->columns + place[0]];
        if (!isnan(*height))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a second height at (%.12g, %.12g), expected one",
                           all->path, p->line, p->at[0], p->at[1]);
        *height = p->at[2];
    }
    return SB_OK;
}

sb_status sb_grid_read_points(const char *path, const char *text, sb_grid *grid, sb_error *error)
{
    cloud all = {.path = path};
    sb_grid made = {0};
    axis axes[2] = {{0}};
    sb_status status = read_points(&all, text, error);
    if (status == SB_OK && all.count < 3)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: %zu points, expected 3 or more", path, all.count);
    for (int k = 0; k < 2 && status == SB_OK; ++k) status = find_axis(&all, k, &axes[k], error);
    if (status != SB_OK) goto done;
    made = (sb_grid){axes[0].count, axes[1].count, axes[0].low, axes[1].low, axes[0].step, axes[1].step, NULL};
    /* A coastline may fill little of its rectangle, but scattered points fill almost none of their grid. */
    if (made.columns * made.rows > SB_GRID_NODES_MAX || made.columns * made.rows / 100 > all.count) {
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.500s: %zu points would lie on %zu x %zu grid lines, expected a regular "
                         "grid",
                         path, all.count, made.columns, made.rows);
        goto done;
    }
    /* A few points may span many grid lines. */
    status = sb_grid_room(path, &made, 0, error);
    if (status != SB_OK) goto done;
    made.heights = sb_alloc_untouched(made.columns * made.rows, sizeof *made.heights);
    status = made.heights ? place_points(&all, axes, &made, error) : sb_fail_memory(error, "a terrain grid");
    if (status == SB_OK)
        *grid = made;
    else
        sb_free(made.heights);
done:
    sb_free(all.points);
    return status;
}

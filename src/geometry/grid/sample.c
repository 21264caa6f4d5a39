/* Interpolates, joins and completes the heights of grids. */
#include "geometry/grid/sample.h"

#include "base/memory.h"

/* Returns the node before the place and the fraction of a step after it; false: outside of all cells. */
static bool locate(double place, size_t count, size_t *node, double *fraction)
{
    const double last = (double)(count - 1);
    if (!(place >= -0.5 && place <= last + 0.5)) return false;
    place = fmin(fmax(place, 0), last);
    *node = (size_t)fmin(floor(place), last - 1);
    *fraction = place - (double)*node;
    return true;
}

double sb_grid_height(const sb_grid *grid, double x, double y)
{
    size_t i, j;
    double u, v;
    if (!locate((x - grid->x) / grid->dx, grid->columns, &i, &u) ||
        !locate((y - grid->y) / grid->dy, grid->rows, &j, &v))
        return (double)INFINITY;
    const double *at = grid->heights + j * grid->columns + i;
    const double z[4] = {at[0], at[1], at[grid->columns], at[grid->columns + 1]};
    const double weight[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    if (isnan(z[(u > 0.5) + 2 * (v > 0.5)])) return (double)NAN;
    double sum = 0, weights = 0;
    for (int k = 0; k < 4; ++k) {
        if (isnan(z[k])) continue;
        sum += weight[k] * z[k];
        weights += weight[k];
    }
    return sum / weights;
}

static void shorten(float *distance, float from, float step)
{
    if (from + step < *distance) *distance = from + step;
}

/* Distances in steps from the nodes without a height, by two passes over the grid with steps to the eight neighbours
   (Borgefors' chamfer distance with 1 and sqrt 2, at most 8 % above the straight one). */
static void measure(const size_t count[2], const double *heights, float *distance)
{
    const size_t columns = count[0], rows = count[1];
    const float slant = 1.41421356F;
    for (size_t n = 0; n < columns * rows; ++n) distance[n] = isfinite(heights[n]) ? HUGE_VALF : 0;
    for (size_t j = 0; j < rows; ++j)
        for (size_t i = 0; i < columns; ++i) {
            float *at = distance + j * columns + i;
            if (i > 0) shorten(at, at[-1], 1);
            if (j == 0) continue;
            const float *south = at - columns;
            shorten(at, south[0], 1);
            if (i > 0) shorten(at, south[-1], slant);
            if (i + 1 < columns) shorten(at, south[1], slant);
        }
    for (size_t j = rows; j-- > 0;)
        for (size_t i = columns; i-- > 0;) {
            float *at = distance + j * columns + i;
            if (i + 1 < columns) shorten(at, at[1], 1);
            if (j + 1 == rows) continue;
            const float *north = at + columns;
            shorten(at, north[0], 1);
            if (i > 0) shorten(at, north[-1], slant);
            if (i + 1 < columns) shorten(at, north[1], slant);
        }
}

void sb_grid_overlay(const size_t count[2], double width, const double *above, double *below, float *distance)
{
    measure(count, above, distance);
    for (size_t n = 0; n < count[0] * count[1]; ++n) {
        if (isnan(above[n]) && !isfinite(below[n])) below[n] = above[n];
        if (!isfinite(above[n])) continue;
        const double weight = isfinite(below[n]) ? fmin(1, (double)distance[n] / fmax(1, width)) : 1;
        below[n] = weight < 1 ? below[n] + weight * (above[n] - below[n]) : above[n];
    }
}

/* The mean of the finite heights among the four nodes that one node of half the grid stands for; NAN: none. */
static double mean_of_four(const size_t count[2], const double *heights, size_t i, size_t j)
{
    double sum = 0;
    int known = 0;
    for (size_t b = 2 * j; b < 2 * j + 2 && b < count[1]; ++b)
        for (size_t a = 2 * i; a < 2 * i + 2 && a < count[0]; ++a) {
            const double z = heights[b * count[0] + a];
            if (!isfinite(z)) continue;
            sum += z;
            ++known;
        }
    return known ? sum / known : (double)NAN;
}

/* Gives each node without a height one from a grid of half the size, which is filled in the same way. */
static sb_status fill_from_half(const size_t count[2], double *heights, sb_error *error)
{
    const size_t half[2] = {(count[0] + 1) / 2, (count[1] + 1) / 2};
    size_t missing = 0;
    for (size_t n = 0; n < count[0] * count[1]; ++n) missing += isfinite(heights[n]) == 0;
    if (missing == 0 || count[0] * count[1] <= 1) return SB_OK;
    double *means = sb_alloc_untouched(half[0] * half[1], sizeof *means);
    if (!means) return sb_fail_memory(error, "missing heights");
    for (size_t j = 0; j < half[1]; ++j)
        for (size_t i = 0; i < half[0]; ++i) means[j * half[0] + i] = mean_of_four(count, heights, i, j);
    sb_status status = fill_from_half(half, means, error);
    for (size_t n = 0; n < count[0] * count[1] && status == SB_OK; ++n)
        if (!isfinite(heights[n])) heights[n] = means[n / count[0] / 2 * half[0] + n % count[0] / 2];
    sb_free(means);
    return status;
}

/* Replaces each listed height by the mean of its neighbours. */
static void relax(const size_t count[2], const size_t *list, size_t length, double *heights)
{
    for (size_t k = 0; k < length; ++k) {
        const size_t n = list[k], i = n % count[0], j = n / count[0];
        double sum = 0;
        int known = 0;
        if (i > 0) sum += heights[n - 1], ++known;
        if (i + 1 < count[0]) sum += heights[n + 1], ++known;
        if (j > 0) sum += heights[n - count[0]], ++known;
        if (j + 1 < count[1]) sum += heights[n + count[0]], ++known;
        heights[n] = sum / known;
    }
}

sb_status sb_grid_fill(const size_t count[2], double *heights, size_t *filled, sb_error *error)
{
    enum { SWEEPS = 100 };
    const size_t nodes = count[0] * count[1];
    size_t length = 0, outside = 0, voids = 0;
    for (size_t n = 0; n < nodes; ++n) {
        voids += isnan(heights[n]) != 0;
        outside += isinf(heights[n]) != 0;
    }
    *filled = 0;
    if (voids == 0 || voids + outside == nodes) return SB_OK;
    /* Nodes outside of the files are filled on the way, so that they do not differ from voids, and are then removed. */
    size_t *list = sb_alloc_untouched(voids + outside, sizeof *list);
    uint8_t *kept = sb_alloc(nodes, 1);
    sb_status status = list && kept ? SB_OK : sb_fail_memory(error, "missing heights");
    for (size_t n = 0; n < nodes && status == SB_OK; ++n) {
        if (!isfinite(heights[n])) list[length++] = n;
        kept[n] = (uint8_t)(isinf(heights[n]) != 0);
    }
    if (status == SB_OK) status = fill_from_half(count, heights, error);
    for (int sweep = 0; sweep < SWEEPS && status == SB_OK; ++sweep) relax(count, list, length, heights);
    for (size_t n = 0; n < nodes && status == SB_OK; ++n)
        if (kept[n]) heights[n] = (double)INFINITY;
    if (status == SB_OK) *filled = voids;
    sb_free(list);
    sb_free(kept);
    return status;
}

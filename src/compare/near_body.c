#include "compare/near_body.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool sb_map_of(const sb_report_run *run, const char *name, sb_grid *grid)
{
    char path[SB_PATH_MAX], file[64];
    snprintf(file, sizeof file, "maps/%s.asc", name);
    return sb_path_join(path, run->directory, file, NULL) == SB_OK && sb_grid_read(path, grid, NULL) == SB_OK;
}

/* The body's plan rectangle: x and y, least and greatest. */
static bool rectangle_of(const sb_report_run *run, const char *name, double low[2], double high[2])
{
    size_t i;
    json_t *body;
    json_array_foreach(json_object_get(run->summary, "bodies"), i, body)
    {
        const char *its = json_string_value(json_object_get(body, "name"));
        const json_t *min = json_object_get(body, "min_m"), *max = json_object_get(body, "max_m");
        if (!its || strcmp(its, name) != 0) continue;
        for (size_t c = 0; c < 2; c++) {
            if (!json_is_number(json_array_get(min, c)) || !json_is_number(json_array_get(max, c))) return false;
            low[c] = json_number_value(json_array_get(min, c));
            high[c] = json_number_value(json_array_get(max, c));
        }
        return true;
    }
    return false;
}

/* The side of the rectangle [low, high] before which the point lies, at most `reach` away: 0 to 3; -1: none. */
static int side_before(const double low[2], const double high[2], const double at[2], double reach)
{
    for (int axis = 0; axis < 2; axis++) {
        const int other = 1 - axis;
        if (at[other] < low[other] || at[other] > high[other]) continue;
        if (at[axis] < low[axis] && low[axis] - at[axis] <= reach) return 2 * axis;
        if (at[axis] > high[axis] && at[axis] - high[axis] <= reach) return 2 * axis + 1;
    }
    return -1;
}

double sb_depth_near(const sb_report_run *run, const char *body, const sb_grid *depth)
{
    double low[2], high[2], sum[4] = {0}, most = NAN;
    size_t cells[4] = {0};
    const double spacing = sb_report_number(run, "resolution_m");
    if (!depth->values || !rectangle_of(run, body, low, high)) return NAN;
    const double reach = fmax(2 * (isnan(spacing) ? 0 : spacing), depth->cell);
    for (size_t row = 0; row < depth->rows; row++)
        for (size_t column = 0; column < depth->columns; column++) {
            const double at[2] = {depth->x_min + ((double)column + 0.5) * depth->cell,
                                  depth->y_min + ((double)(depth->rows - row) - 0.5) * depth->cell};
            const int side = side_before(low, high, at, reach);
            if (side < 0) continue;
            const double value = (double)depth->values[row * depth->columns + column];
            sum[side] += isnan(value) ? 0 : value;
            cells[side]++;
        }
    for (int side = 0; side < 4; side++)
        if (cells[side] > 0) most = fmax(most, sum[side] / (double)cells[side]);
    return most;
}

/* Whether a map is there and has the cells of another one. */
static bool fits(const sb_grid *map, const sb_grid *other)
{
    return map->values && map->columns == other->columns && map->rows == other->rows;
}

void sb_flooded(const sb_grid *wet, const sb_grid *depth, const sb_grid *ground, double *area, double *most)
{
    const bool same = fits(depth, wet), known = fits(ground, wet);
    size_t cells = 0;
    *most = NAN;
    for (size_t i = 0; i < wet->columns * wet->rows; i++) {
        if (!(wet->values[i] > 0) || (known && isnan(ground->values[i]))) continue;
        cells++;
        if (same) *most = fmax(*most, (double)depth->values[i]);
    }
    *area = (double)cells * wet->cell * wet->cell;
}

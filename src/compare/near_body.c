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

double sb_depth_near(const sb_report_run *run, const char *body, const sb_grid *depth)
{
    double low[2], high[2], most = NAN;
    const double spacing = sb_report_number(run, "resolution_m");
    if (!depth->values || !rectangle_of(run, body, low, high)) return NAN;
    const double reach = fmax(2 * (isnan(spacing) ? 0 : spacing), depth->cell);
    for (size_t row = 0; row < depth->rows; row++)
        for (size_t column = 0; column < depth->columns; column++) {
            const double x = depth->x_min + ((double)column + 0.5) * depth->cell;
            const double y = depth->y_min + ((double)(depth->rows - row) - 0.5) * depth->cell;
            const double out_x = fmax(low[0] - x, x - high[0]), out_y = fmax(low[1] - y, y - high[1]);
            if (fmax(out_x, out_y) <= 0 || hypot(fmax(out_x, 0), fmax(out_y, 0)) > reach) continue;
            const double value = (double)depth->values[row * depth->columns + column];
            most = fmax(most, isnan(value) ? 0 : value);
        }
    return most;
}

void sb_flooded(const sb_grid *arrival, const sb_grid *depth, double *area, double *most)
{
    const bool same = depth->values && depth->columns == arrival->columns && depth->rows == arrival->rows;
    size_t cells = 0;
    *most = NAN;
    for (size_t i = 0; i < arrival->columns * arrival->rows; i++) {
        if (!(arrival->values[i] > 0)) continue;
        cells++;
        if (same) *most = fmax(*most, (double)depth->values[i]);
    }
    *area = (double)cells * arrival->cell * arrival->cell;
}

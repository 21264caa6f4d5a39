#include "output/maps/esri.h"

#include "base/file.h"

sb_status sb_esri_write(const char *path, const sb_map_record *map, const float *values, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    fprintf(out.stream,
            "ncols %zu\nnrows %zu\nxllcorner %.12g\nyllcorner %.12g\ncellsize %.12g\n"
            "NODATA_value -9999\n",
            map->columns, map->rows, map->x_min, map->y_min, map->cell);
    for (size_t row = map->rows; row-- > 0;) /* the northernmost row comes first */
        for (size_t i = 0; i < map->columns; i++) {
            double value = (double)values[row * map->columns + i];
            fprintf(out.stream, "%.6g%c", isnan(value) ? -9999.0 : value, i + 1 < map->columns ? ' ' : '\n');
        }
    return sb_atomic_commit(&out, 0, error);
}

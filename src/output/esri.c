#include "output/esri.h"

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

const char *const sb_map_names[SB_MAPS + 1] = {"max_depth", "max_speed", "max_momentum_flux", "arrival_time"};

sb_status sb_maps_write(const char *directory, const sb_map_record *map, sb_error *error)
{
    const float *const values[SB_MAPS] = {map->depth, map->speed, map->flux, map->arrival};
    char path[SB_PATH_MAX], name[64];
    sb_status status = sb_make_folder(path, directory, "maps", error);
    for (size_t i = 0; status == SB_OK && i < SB_MAPS; i++) {
        snprintf(name, sizeof name, "maps/%s.asc", sb_map_names[i]);
        status = sb_path_join(path, directory, name, error);
        if (status == SB_OK) status = sb_esri_write(path, map, values[i], error);
    }
    return status;
}

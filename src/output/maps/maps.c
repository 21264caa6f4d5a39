#include "output/maps/maps.h"

#include "base/file.h"
#include "output/maps/esri.h"

const sb_map_row sb_map_rows[] = {
    {"max_depth", "grid_max_depth", offsetof(sb_map_record, depth), "greatest depth (m)",
     "0 '#ffffff', 0.02 '#deebf7', 0.4 '#6baed6', 1 '#08306b'", true, true},
    {"max_speed", "grid_max_speed", offsetof(sb_map_record, speed), "greatest speed (m/s)",
     "0 '#ffffe5', 0.5 '#fe9929', 1 '#662506'", true, true},
    {"max_momentum_flux", "grid_max_momentum_flux", offsetof(sb_map_record, flux), "greatest momentum flux (m³/s²)",
     "0 '#fff7f3', 0.5 '#f768a1', 1 '#49006a'", true, true},
    {"arrival_time", "grid_arrival_time", offsetof(sb_map_record, arrival), "arrival time (s)",
     "0 '#440154', 0.5 '#21918c', 1 '#fde725'", false, true},
    {"inundation_time", "grid_inundation_time", offsetof(sb_map_record, duration), "duration of inundation (s)",
     "0 '#ffffff', 0.02 '#e5f5e0', 0.5 '#41ab5d', 1 '#00441b'", true, true},
    {"ground", "grid_ground", offsetof(sb_map_record, ground), "ground (z, m)",
     "0 '#3b5b7a', 0.35 '#d8c9a3', 0.6 '#8fae7a', 1 '#7a5a3a'", false, false},
    {.name = NULL},
};

enum { MAPS = sizeof sb_map_rows / sizeof *sb_map_rows - 1 };

const char *sb_map_name(size_t map)
{
    return map < MAPS ? sb_map_rows[map].name : NULL;
}

const char *sb_grid_map_name(size_t map)
{
    return map < MAPS ? sb_map_rows[map].grid_name : NULL;
}

sb_status sb_maps_write(const char *directory, const sb_map_record *map, bool beside, sb_error *error)
{
    char path[SB_PATH_MAX], name[64];
    sb_status status = sb_make_folder(path, directory, "maps", error);
    for (size_t i = 0; status == SB_OK && i < MAPS; i++) {
        const float *const *values = (const void *)((const char *)map + sb_map_rows[i].values);
        if (!*values) continue;
        snprintf(name, sizeof name, "maps/%s.asc", beside ? sb_map_rows[i].grid_name : sb_map_rows[i].name);
        status = sb_path_join(path, directory, name, error);
        if (status == SB_OK) status = sb_esri_write(path, map, *values, error);
    }
    return status;
}

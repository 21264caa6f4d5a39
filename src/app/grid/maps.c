#include "app/grid/maps.h"

#include "base/memory.h"
#include "output/maps/maps.h"

#include <math.h>

/* A copy with `later` added, in which values below 0, "never", are NaN. */
static float *copy_map(const float *from, size_t cells, float later)
{
    float *copy = sb_alloc_untouched(cells, sizeof *copy);
    for (size_t k = 0; copy && k < cells; k++) copy[k] = from[k] >= 0 ? from[k] + later : NAN;
    return copy;
}

sb_status sb_grid_maps_write(const char *directory, const sb_offshore *water, const sb_offshore_maps *maps,
                             const sb_scene *nested, sb_error *error)
{
    enum { COPIES = 4 };
    const sb_offshore_view v = sb_offshore_read(water);
    const sb_offshore_map_view m = sb_offshore_maps_read(maps);
    const float *const from[COPIES] = {m.depth, m.speed, m.flux, m.arrival};
    const float later[COPIES] = {0, 0, 0, nested ? (float)nested->given.start : 0};
    float *copy[COPIES] = {0};
    sb_status status = SB_OK;
    for (size_t k = 0; status == SB_OK && k < COPIES; k++) {
        copy[k] = copy_map(from[k], m.columns * m.rows, later[k]);
        if (!copy[k]) status = sb_fail_memory(error, "maps");
    }
    const sb_map_record map = {m.columns, m.rows,  v.x,     v.y,        v.cell, copy[0],
                               copy[1],   copy[2], copy[3], m.duration, NULL};
    if (status == SB_OK) status = sb_maps_write(directory, &map, nested != NULL, error);
    for (size_t k = 0; k < COPIES; k++) sb_free(copy[k]);
    return status;
}

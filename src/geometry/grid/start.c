#include "geometry/grid/start.h"

#include "base/memory.h"
#include "geometry/grid/bed.h"

double sb_grid_bytes(const sb_scene *scene)
{
    const sb_offshore_options options = sb_offshore_options_of(scene, sb_bed_columns(scene), sb_bed_rows(scene));
    /* three arrays to begin with; maps, with their copies, and a frame later */
    return (double)sb_offshore_bytes(&options) + (double)(options.columns * options.rows) * 16 * sizeof(float);
}

static sb_status check_room(double bytes, sb_error *error)
{
    const double available = (double)sb_memory_available() * (1 - SB_MEMORY_SPARE);
    if (!(available > 0) || bytes <= available) return SB_OK;
    return sb_fail(error, SB_FAILED, "offshore: needs about %.0f MB and %.0f MB are available; expected larger cells",
                   bytes / 1e6, available / 1e6);
}

sb_status sb_grid_start_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    sb_offshore_start made = {.columns = sb_bed_columns(scene), .rows = sb_bed_rows(scene)};
    const size_t cells = made.columns * made.rows;
    sb_status status = check_room(sb_grid_bytes(scene), error);
    if (status != SB_OK) return status;
    made.bed = sb_alloc(cells, sizeof *made.bed);
    made.depth = sb_alloc(cells, sizeof *made.depth);
    made.hu = sb_alloc(cells, sizeof *made.hu);
    status = made.bed && made.depth && made.hu ? SB_OK : sb_fail_memory(error, "the bed of offshore");
    if (status == SB_OK) status = sb_bed_fill(scene, &made, error);
    if (status == SB_OK) status = sb_uplift_fill(scene, &made, error);
    if (status == SB_OK) status = sb_offshore_start_water(scene, &made, error);
    if (status != SB_OK) {
        sb_offshore_start_free(&made);
        return status;
    }
    *start = made;
    return SB_OK;
}

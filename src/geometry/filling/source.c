/* Water that is placed in parts: a rank of a run has a part of it, and no rank has all particles at once. */
#include "geometry/filling/parts.h"

#include "base/memory.h"

#include <string.h>

struct sb_fill_source {
    sb_fill_solid *solids;
    sb_columns columns;
    size_t *first; /* particle of each column */
};

void sb_fill_source_destroy(sb_fill_source *source)
{
    if (!source) return;
    sb_columns_free(&source->columns);
    sb_free(source->solids);
    sb_free(source->first);
    sb_free(source);
}

sb_status sb_fill_place(const sb_fill_source *source, size_t from, size_t here, sb_fluid *fluid, sb_error *error)
{
    const sb_status status = sb_columns_place(&source->columns, source->first, from, here, fluid, error);
    if (status == SB_OK) sb_fluid_displace(source->columns.scene, fluid);
    return status;
}

/* Finds the columns of the scene's only sea or box, and counts their particles. */
static sb_status create(const sb_scene *scene, const sb_fill_solid *solids, size_t count, sb_wave_room *wave,
                        double *still_depth, sb_fill_source **source, sb_error *error)
{
    sb_fill_source *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "water");
    const sb_fluid_box *box = scene->sea.present ? NULL : scene->boxes;
    made->solids = sb_alloc(count, sizeof *made->solids);
    sb_status status = made->solids ? SB_OK : sb_fail_memory(error, "water");
    if (status == SB_OK && count > 0) memcpy(made->solids, solids, count * sizeof *solids);
    if (status == SB_OK) status = sb_columns_fill(scene, made->solids, count, box, &made->columns, wave, error);
    if (status == SB_OK) status = sb_columns_count(&made->columns, &made->first, still_depth, error);
    if (status != SB_OK) {
        sb_fill_source_destroy(made);
        return status;
    }
    *source = made;
    return SB_OK;
}

sb_status sb_fill_part(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fill_share *share,
                       sb_fluid *fluid, sb_error *error)
{
    sb_fill_source *source = NULL;
    sb_fluid made = {0};
    sb_wave_room wave = {.wet = false};
    double still_depth = 0;
    sb_status status = create(scene, solids, count, &wave, &still_depth, &source, error);
    if (status != SB_OK) return status;
    const size_t all = source->first[source->columns.nx * source->columns.ny];
    const size_t from = all * share->part / share->parts, end = all * (share->part + 1) / share->parts;
    sb_box_share *boxes = sb_alloc(scene->box_count, sizeof *boxes);
    status = boxes ? sb_fill_place(source, from, end - from, &made, error) : sb_fail_memory(error, "water");
    if (status != SB_OK) {
        sb_free(boxes);
        sb_fill_source_destroy(source);
        return status;
    }
    if (scene->box_count > 0) boxes[0] = (sb_box_share){all, all};
    made.boxes = boxes;
    made.wave = wave;
    made.still_depth = still_depth;
    made.source = source;
    *fluid = made;
    return SB_OK;
}

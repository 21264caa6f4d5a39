/* The places near which measurements read boundary particles. */
#include "base/memory.h"
#include "measure/floors.h"
#include "measure/measure.h"
#include "measure/parts.h"
#include "measure/patch.h"

/* A place with a margin for rounding. */
static sb_model_place place(sb_vec3 at, sb_vec3 to, double range, bool column)
{
    return (sb_model_place){.at = at, .to = to, .range = 1.01 * range, .column = column};
}

sb_status sb_measure_places(const sb_scene *scene, sb_model_place **places, size_t *count, sb_error *error)
{
    const sb_measure_settings *settings = &scene->measure;
    const bool flat = scene->dimensions == 2;
    const double radius = sb_floors_radius(scene);
    sb_model_place *made = sb_alloc(
        settings->gauge_count + settings->plane_count + settings->probe_count + settings->runup_count, sizeof *made);
    if (!made) return sb_fail_memory(error, "measurements");
    *count = 0;
    for (size_t i = 0; i < settings->gauge_count; i++) {
        const sb_gauge *gauge = &settings->gauges[i];
        const sb_vec3 at = sb_vec(gauge->x, flat ? 0 : gauge->y, 0);
        if (gauge->water == SB_GAUGE_PARTICLES) made[(*count)++] = place(at, at, radius, true);
    }
    for (size_t i = 0; i < settings->plane_count; i++) {
        const sb_flow_plane *plane = &settings->planes[i];
        if (!plane->record) continue;
        made[(*count)++] =
            place(sb_vec(plane->ax, flat ? 0 : plane->ay, 0), sb_vec(plane->bx, flat ? 0 : plane->by, 0), radius, true);
    }
    for (size_t i = 0; i < settings->probe_count; i++)
        made[(*count)++] =
            place(settings->probes[i].at, settings->probes[i].at, sb_patch_range(scene, &settings->probes[i]), false);
    for (size_t i = 0; i < settings->runup_count; i++) {
        const sb_model_place of = sb_shore_place(scene, &settings->runups[i]);
        made[(*count)++] = place(of.at, of.to, of.range, of.column);
    }
    *places = made;
    return SB_OK;
}

#include "app/grid/water.h"

#include "geometry/grid/start.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

sb_status sb_grid_refuse(const sb_scene *scene, const char *command, sb_error *error)
{
    if (!sb_scene_grid_alone(scene)) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: has offshore and no particles, and %s needs particles; expected run or "
                   "check",
                   scene->path, command);
}

sb_status sb_grid_water_create(const sb_scene *scene, sb_offshore **water, sb_grid_facts *facts,
                               sb_offshore_told_list *told, sb_error *error)
{
    sb_offshore_start start = {0};
    sb_offshore *made = NULL;
    sb_status status = sb_grid_start_fill(scene, &start, error);
    if (status == SB_OK) status = sb_offshore_begin(scene, &start, &made, error);
    if (status == SB_OK)
        *facts = (sb_grid_facts){.columns = start.columns,
                                 .rows = start.rows,
                                 .wet = start.wet,
                                 .uncovered = start.uncovered,
                                 .deepest = start.deepest,
                                 .time_step = sb_offshore_time_step(made),
                                 .bytes = sb_grid_bytes(scene)};
    if (status == SB_OK) {
        *told = start.told;
        start.told = (sb_offshore_told_list){0};
    }
    sb_offshore_start_free(&start);
    if (status == SB_OK) *water = made;
    return status;
}

void sb_grid_wave_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const sb_offshore_settings *o = &scene->offshore;
    char text[400];
    const bool exact = o->wave.theory == SB_SOLITARY_SERRE && o->dispersion;
    if (o->wave.kind == SB_INITIAL_SOLITARY && !exact && o->wave.height > 0.2 * o->wave.depth) {
        snprintf(text, sizeof text,
                 "offshore.wave: a solitary wave of %.2g of the depth changes its form at the start%s",
                 o->wave.height / o->wave.depth,
                 o->dispersion ? "; expected theory: serre, which is exact here" : ", because shallow water has none");
        visit(context, text);
    }
    if (o->wave.kind == SB_INITIAL_SOLITARY) {
        const double length = 2 * o->wave.depth / sqrt(0.75 * o->wave.height / o->wave.depth);
        if (o->wave.position < o->x_min || o->wave.position > o->x_max) {
            snprintf(text, sizeof text,
                     "offshore.wave.position: the crest at x = %g m begins outside of the grid, which has at most the "
                     "wave's flank; expected a place from %g to %g m",
                     o->wave.position, o->x_min, o->x_max);
            visit(context, text);
        }
        if (o->cell > length / 10) {
            snprintf(text, sizeof text,
                     "offshore.cell: %g m is coarse for a solitary wave about %.3g m long; expected at most %.2g m",
                     o->cell, length, length / 10);
            visit(context, text);
        }
    }
}

void sb_grid_water_warnings(const sb_scene *scene, const sb_grid_facts *facts, const sb_offshore_told_list *told,
                            sb_warning_visit *visit, void *context)
{
    const bool ignored[] = {scene->measure.plane_count > 0,
                            scene->measure.map.present,
                            scene->measure.waves.present,
                            scene->measure.reflection_count > 0,
                            scene->render.interval > 0 && scene->render.camera_count > 0,
                            scene->stream.enabled};
    static const char *const names[] = {"measure.planes",      "measure.map", "measure.waves",
                                        "measure.reflections", "render",      "stream"};
    char text[400];
    for (size_t k = 0; k < sizeof ignored / sizeof *ignored; k++) {
        if (!ignored[k]) continue;
        snprintf(text, sizeof text, "%s: has no effect in a scene with offshore%s", names[k],
                 strcmp(names[k], "measure.map") == 0 ? ", whose maps have its own cells" : "");
        visit(context, text);
    }
    sb_grid_wave_warnings(scene, visit, context);
    for (size_t w = 0; w < told->warning_count; w++) visit(context, told->warnings[w]);
    bool ground = false; /* a floor beside shapes is usual; missing ground is not */
    for (size_t b = 0; b < scene->body_count; b++)
        ground = ground || scene->bodies[b].shape == SB_SHAPE_GRID || scene->bodies[b].shape == SB_SHAPE_MESH;
    if (facts->uncovered > 0 && ground) {
        snprintf(text, sizeof text,
                 "bodies: no surface above %zu of %zu cells of offshore; there the bed is the domain's floor at %g m",
                 facts->uncovered, facts->columns * facts->rows, scene->domain.min.z);
        visit(context, text);
    }
}

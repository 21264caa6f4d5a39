#include "app/grid_water.h"

#include "base/memory.h"
#include "geometry/grid/bed.h"
#include "physics/wave_theory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

sb_status sb_grid_refuse(const sb_scene *scene, const char *command, sb_error *error)
{
    if (!scene->offshore.present) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: has offshore and no particles, and %s needs particles; expected run or "
                   "check",
                   scene->path, command);
}

static sb_offshore_side side_of(const sb_scene *scene, int side)
{
    switch (scene->domain.side[side]) {
    case SB_SIDE_OPEN:
        return SB_OFFSHORE_OPEN;
    case SB_SIDE_PERIODIC:
        return SB_OFFSHORE_PERIODIC;
    case SB_SIDE_SEA: /* refused with the scene */
    case SB_SIDE_WALL:
        break;
    }
    return SB_OFFSHORE_WALL;
}

static sb_offshore_options options_of(const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    sb_offshore_options options = {.columns = sb_bed_columns(scene),
                                   .rows = sb_bed_rows(scene),
                                   .x = o->x_min,
                                   .y = scene->dimensions == 2 ? -0.5 * o->cell : o->y_min,
                                   .cell = o->cell,
                                   .gravity = scene->fluid.gravity,
                                   .manning = o->manning,
                                   .level = o->level,
                                   .dispersion = o->dispersion};
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) options.side[s] = side_of(scene, s);
    return options;
}

/* Elevation of the initial wave above the still water, and its velocity along x. */
static double wave_at(const sb_scene *scene, double x, double *u)
{
    const sb_initial_wave *wave = &scene->offshore.wave;
    *u = 0;
    if (wave->kind == SB_INITIAL_STANDING)
        return sb_standing_elevation(wave->height, wave->wavelength, x - wave->position);
    if (wave->kind == SB_INITIAL_NONE) return 0;
    const sb_solitary solitary = {wave->height, wave->depth, scene->fluid.gravity, wave->theory};
    const double eta = sb_solitary_elevation(&solitary, (x - wave->position) * wave->direction);
    /* Continuity of a wave of constant form gives the mean over the depth. */
    *u = wave->direction * sb_solitary_celerity(&solitary) * eta / (wave->depth + eta);
    return eta;
}

/* Fills depth and momentum. depth contains the uplift at first. Returns the number of wet cells. */
static size_t fill_water(const sb_scene *scene, const sb_offshore_options *options, const double *bed, double *depth,
                         double *hu)
{
    size_t wet = 0;
    for (size_t k = 0; k < options->columns * options->rows; k++) {
        const double x = options->x + ((double)(k % options->columns) + 0.5) * options->cell;
        const double still = scene->offshore.level - bed[k];
        double u = 0;
        depth[k] = still > 0 ? fmax(0, still + depth[k] + wave_at(scene, x, &u)) : 0;
        hu[k] = depth[k] * u;
        wet += depth[k] > 0;
    }
    return wet;
}

static sb_status check_room(double bytes, sb_error *error)
{
    const double available = (double)sb_memory_available() * (1 - SB_MEMORY_SPARE);
    if (!(available > 0) || bytes <= available) return SB_OK;
    return sb_fail(error, SB_FAILED, "offshore: needs about %.0f MB and %.0f MB are available; expected larger cells",
                   bytes / 1e6, available / 1e6);
}

sb_status sb_grid_water_create(const sb_scene *scene, sb_offshore **water, sb_grid_facts *facts, sb_error *error)
{
    const sb_offshore_options options = options_of(scene);
    const size_t cells = options.columns * options.rows;
    sb_grid_facts found = {.columns = options.columns,
                           .rows = options.rows,
                           /* three arrays to begin with; maps, with their copies, and a frame later */
                           .bytes = (double)sb_offshore_bytes(&options) + (double)cells * 16 * sizeof(float)};
    sb_status status = check_room(found.bytes, error);
    if (status != SB_OK) return status;
    double *bed = sb_alloc(cells, sizeof *bed), *depth = sb_alloc(cells, sizeof *depth);
    double *hu = sb_alloc(cells, sizeof *hu);
    sb_offshore *made = NULL;
    status = bed && depth && hu ? SB_OK : sb_fail_memory(error, "the bed of offshore");
    if (status == SB_OK) status = sb_bed_fill(scene, bed, &found.uncovered, error);
    if (status == SB_OK) status = sb_uplift_fill(scene, depth, error);
    if (status == SB_OK) {
        found.wet = fill_water(scene, &options, bed, depth, hu);
        for (size_t k = 0; k < cells; k++) found.deepest = fmax(found.deepest, depth[k]);
        if (found.wet == 0)
            status =
                sb_fail(error, SB_BAD_INPUT,
                        "offshore.level: %g m is below the whole bed, expected water somewhere; check the level, and "
                        "datum and positive of the terrain",
                        scene->offshore.level);
    }
    if (status == SB_OK) status = sb_offshore_create(&options, bed, depth, hu, NULL, &made, error);
    sb_free(bed);
    sb_free(depth);
    sb_free(hu);
    if (status != SB_OK) return status;
    found.time_step = sb_offshore_time_step(made);
    if (facts) *facts = found;
    *water = made;
    return SB_OK;
}

void sb_grid_water_warnings(const sb_scene *scene, const sb_grid_facts *facts, sb_warning_visit *visit, void *context)
{
    const sb_offshore_settings *o = &scene->offshore;
    const bool ignored[] = {scene->measure.plane_count > 0, scene->measure.map.present,
                            scene->render.interval > 0 && scene->render.camera_count > 0, scene->stream.enabled};
    static const char *const names[] = {"measure.planes", "measure.map", "render", "stream"};
    char text[400];
    for (size_t k = 0; k < sizeof ignored / sizeof *ignored; k++) {
        if (!ignored[k]) continue;
        snprintf(text, sizeof text, "%s: has no effect in a scene with offshore%s", names[k],
                 strcmp(names[k], "measure.map") == 0 ? ", whose maps have its own cells" : "");
        visit(context, text);
    }
    const bool exact = o->wave.theory == SB_SOLITARY_SERRE && o->dispersion;
    if (o->wave.kind == SB_INITIAL_SOLITARY && !exact && o->wave.height > 0.2 * o->wave.depth) {
        snprintf(text, sizeof text,
                 "offshore.wave: a solitary wave of %.2g of the depth changes its form at the start%s",
                 o->wave.height / o->wave.depth,
                 o->dispersion ? "; expected theory: serre, which is exact here" : ", because shallow water has none");
        visit(context, text);
    }
    bool ground = false; /* a floor beside shapes is usual; missing ground is not */
    for (size_t b = 0; b < scene->body_count; b++)
        ground = ground || scene->bodies[b].shape == SB_SHAPE_GRID || scene->bodies[b].shape == SB_SHAPE_MESH;
    if (facts->uncovered > 0 && ground) {
        snprintf(text, sizeof text,
                 "bodies: no surface above %zu of %zu cells of offshore; there the bed is the domain's floor at %g m",
                 facts->uncovered, facts->columns * facts->rows, scene->domain.min.z);
        visit(context, text);
    }
    if (o->wave.kind == SB_INITIAL_SOLITARY) {
        const double length = 2 * o->wave.depth / sqrt(0.75 * o->wave.height / o->wave.depth);
        if (o->cell > length / 10) {
            snprintf(text, sizeof text,
                     "offshore.cell: %g m is coarse for a solitary wave about %.3g m long; expected at most %.2g m",
                     o->cell, length, length / 10);
            visit(context, text);
        }
    }
}

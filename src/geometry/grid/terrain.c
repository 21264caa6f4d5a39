/* Makes the ground of a body from one grid or a stack of them. */
#include "geometry/grid/terrain.h"

#include "base/memory.h"
#include "base/stop.h"
#include "geometry/grid/layer.h"
#include "geometry/grid/sample.h"
#include "geometry/grid/tell.h"

#include <stdio.h>

/* Steps around the wanted area, so that the ground extends beyond the domain. */
enum { AROUND = 2 };

/* A UTM zone is 6 degrees wide. Three of them are the widest file for which one is chosen without being asked. */
static const double WIDEST = 18;

bool sb_terrain_applies(const sb_body *body)
{
    return body->file_count > 0 || (body->file && sb_raster_is(body->file)) || (body->crs && body->crs[0]) ||
           (body->projection && body->projection[0]) || body->window.present || body->resample > 0 ||
           body->voids == SB_VOIDS_FILL || body->origin[0] != 0 || body->origin[1] != 0;
}

static void close_layers(sb_terrain *ground)
{
    for (size_t i = 0; ground->layers && i < ground->count; ++i) sb_layer_close(&ground->layers[i]);
    sb_free(ground->layers);
    sb_free(ground->grid.heights);
}

static sb_status open_layers(const sb_body *body, sb_terrain *ground, sb_error *error)
{
    const sb_grid_file alone = {.file = body->file, .crs = body->crs};
    const sb_grid_file *files = body->file_count > 0 ? body->files : &alone;
    /* Where the scene says that all files have depths, they are made heights after the files are joined. */
    const double sign = body->positive == SB_POSITIVE_DOWN ? -1 : 1;
    const size_t count = body->file_count > 0 ? body->file_count : 1;
    ground->layers = sb_alloc(count, sizeof *ground->layers);
    if (!ground->layers) return sb_fail_memory(error, "terrain");
    sb_status status = SB_OK;
    for (; ground->count < count && status == SB_OK; ++ground->count) {
        const sb_grid_file *from = &files[ground->count];
        sb_layer *layer = &ground->layers[ground->count];
        status = sb_layer_open(from->file, from->crs, sign * from->datum, layer, error);
        layer->down = body->positive == SB_POSITIVE_AUTO && layer->about.down;
    }
    return status;
}

/* Chooses the UTM zone of the finest file that is in degrees. */
static sb_status choose_zone(sb_terrain *ground, sb_error *error)
{
    const sb_layer *finest = NULL;
    for (size_t i = 0; i < ground->count; ++i) {
        const sb_layer *each = &ground->layers[i];
        if (each->unit != SB_PROJECTION_DEGREES || !each->system[0]) continue;
        if (!finest || each->about.dx < finest->about.dx) finest = each;
    }
    if (!finest) return SB_OK;
    const sb_raster_about *of = &finest->about;
    const double width = of->dx * (double)of->columns, height = of->dy * (double)of->rows;
    if (width > WIDEST)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: longitude and latitude over %g degrees, where metres are expected: expected the key "
                       "projection, as EPSG:32654 for UTM zone 54 north",
                       finest->path, width);
    sb_projection_zone(of->x + 0.5 * width, of->y + 0.5 * height, ground->projection);
    ground->zone = true;
    return SB_OK;
}

static sb_status choose_projection(const sb_body *body, sb_terrain *ground, sb_error *error)
{
    sb_projection_unit unit = SB_PROJECTION_METRES;
    if (body->projection && body->projection[0]) {
        snprintf(ground->projection, sizeof ground->projection, "%s", body->projection);
        sb_status status = sb_projection_unit_of(ground->projection, &unit, error);
        if (status != SB_OK) return status;
        if (unit == SB_PROJECTION_METRES) return SB_OK;
        return sb_fail(error, SB_BAD_INPUT, "projection \"%.200s\" is not in metres, expected one in metres, as UTM",
                       ground->projection);
    }
    const sb_layer *other = NULL;
    for (size_t i = 0; i < ground->count; ++i) {
        const sb_layer *each = &ground->layers[i];
        if (!each->system[0]) continue;
        if (each->unit == SB_PROJECTION_METRES) {
            snprintf(ground->projection, sizeof ground->projection, "%s", each->system);
            return SB_OK;
        }
        if (each->unit == SB_PROJECTION_OTHER) other = each;
    }
    sb_status status = choose_zone(ground, error);
    if (status != SB_OK || ground->projection[0] || !other) return status;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s: its coordinate system %.100s is not in metres, expected the key projection with one that is",
        other->path, other->system);
}

/* Files with equal cells keep their order: the later one covers the earlier one. */
static void sort_layers(sb_terrain *ground)
{
    for (size_t i = 1; i < ground->count; ++i)
        for (size_t k = i; k > 0 && ground->layers[k - 1].cell < ground->layers[k].cell; --k) {
            const sb_layer kept = ground->layers[k];
            ground->layers[k] = ground->layers[k - 1];
            ground->layers[k - 1] = kept;
        }
}

static sb_status choose_area(const sb_body *body, const sb_terrain_area *wanted, sb_terrain *ground, sb_error *error)
{
    const sb_window *window = &body->window;
    sb_terrain_area files = ground->layers[0].area;
    for (size_t i = 1; i < ground->count; ++i)
        for (int k = 0; k < 2; ++k) {
            files.min[k] = fmin(files.min[k], ground->layers[i].area.min[k]);
            files.max[k] = fmax(files.max[k], ground->layers[i].area.max[k]);
        }
    ground->area = files;
    if (window->present)
        ground->area = (sb_terrain_area){{window->x_min, window->y_min}, {window->x_max, window->y_max}};
    else if (wanted)
        for (int k = 0; k < 2; ++k) {
            ground->area.min[k] = wanted->min[k] + body->origin[k];
            ground->area.max[k] = wanted->max[k] + body->origin[k];
        }
    const sb_terrain_area *of = &ground->area;
    if (of->min[0] < files.max[0] && of->max[0] > files.min[0] && of->min[1] < files.max[1] &&
        of->max[1] > files.min[1])
        return SB_OK;
    const bool degrees = !ground->projection[0] && files.min[0] >= -180 && files.max[0] <= 360 && files.min[1] >= -90 &&
                         files.max[1] <= 90;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.400s: it lies from (%.10g, %.10g) to (%.10g, %.10g)%s%.60s, the %s from (%.10g, %.10g) to (%.10g, "
        "%.10g): expected an overlap; %s",
        ground->layers[0].path, files.min[0], files.min[1], files.max[0], files.max[1],
        ground->projection[0] ? " m in " : "", ground->projection, window->present ? "window" : "domain", of->min[0],
        of->min[1], of->max[0], of->max[1],
        degrees ? "if the file has degrees, give crs: EPSG:4326" : "the key origin is the place that becomes (0, 0)");
}

/* Reads the nodes of the only file. */
static sb_status make_alone(sb_terrain *ground, bool windowed, sb_error *error)
{
    sb_layer *only = ground->layers;
    sb_status status = sb_layer_load(only, &ground->area, windowed ? 0 : AROUND, error);
    if (status != SB_OK) return status;
    ground->grid = only->grid;
    only->grid.heights = NULL;
    return SB_OK;
}

/* Plans the nodes of the ground at multiples of the step, so that they do not depend on the area. */
static sb_status plan_grid(const sb_body *body, bool windowed, sb_terrain *ground, sb_error *error)
{
    double step = body->resample, count[2], start[2];
    if (!(step > 0)) step = ground->layers[ground->count - 1].cell;
    for (int k = 0; k < 2; ++k) {
        const double around = windowed ? 0 : AROUND;
        start[k] = floor(ground->area.min[k] / step) - around;
        count[k] = ceil(ground->area.max[k] / step) + around - start[k] + 1;
    }
    if (!(count[0] * count[1] <= SB_GRID_NODES_MAX))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: %.0f x %.0f nodes of %g m, expected at most %d: a smaller window, or a larger resample",
                       ground->layers[0].path, count[0], count[1], step, SB_GRID_NODES_MAX);
    ground->grid = (sb_grid){.columns = (size_t)count[0],
                             .rows = (size_t)count[1],
                             .x = start[0] * step,
                             .y = start[1] * step,
                             .dx = step,
                             .dy = step};
    const size_t more = sizeof(double) + sizeof(float) + 6 * sizeof(uint32_t); /* layers, and two triangles */
    return sb_grid_room(ground->layers[0].path, &ground->grid, more, error);
}

static sb_status sample_layer(const sb_grid *grid, const sb_layer *layer, double *heights, sb_error *error)
{
    for (size_t j = 0; j < grid->rows; ++j) {
        if (sb_stop_signal()) return sb_stop_fail(error, "while terrain was read");
        for (size_t i = 0; i < grid->columns; ++i)
            heights[j * grid->columns + i] =
                sb_layer_height(layer, grid->x + (double)i * grid->dx, grid->y + (double)j * grid->dy);
    }
    return SB_OK;
}

/* Samples each file at the nodes and lays it over the coarser ones. A finer file gains its full weight within one cell
   of the next coarser one. */
static sb_status make_joined(sb_terrain *ground, sb_error *error)
{
    sb_grid *grid = &ground->grid;
    const size_t count[2] = {grid->columns, grid->rows}, nodes = grid->columns * grid->rows;
    const sb_terrain_area all = {
        {grid->x, grid->y},
        {grid->x + grid->dx * (double)(grid->columns - 1), grid->y + grid->dy * (double)(grid->rows - 1)}};
    grid->heights = sb_alloc_untouched(nodes, sizeof *grid->heights);
    double *above = sb_alloc_untouched(nodes, sizeof *above);
    float *distance = sb_alloc_untouched(nodes, sizeof *distance);
    sb_status status = grid->heights && above && distance ? SB_OK : sb_fail_memory(error, "terrain");
    for (size_t i = 0; i < ground->count && status == SB_OK; ++i) {
        sb_layer *layer = &ground->layers[i];
        status = sb_layer_load(layer, &all, AROUND, error);
        if (status == SB_OK) status = sample_layer(grid, layer, i == 0 ? grid->heights : above, error);
        if (status == SB_OK && i > 0)
            sb_grid_overlay(count, ground->layers[i - 1].cell / grid->dx, above, grid->heights, distance);
        sb_free(layer->grid.heights);
        layer->grid.heights = NULL;
    }
    sb_free(above);
    sb_free(distance);
    return status;
}

/* Fills voids if that is wanted, and counts what has no height. */
static sb_status complete(const sb_body *body, sb_terrain *ground, sb_error *error)
{
    sb_grid *grid = &ground->grid;
    const size_t count[2] = {grid->columns, grid->rows}, nodes = grid->columns * grid->rows;
    for (size_t n = 0; n < nodes; ++n) ground->voids += isnan(grid->heights[n]) != 0;
    sb_status status = SB_OK;
    if (body->voids == SB_VOIDS_FILL) status = sb_grid_fill(count, grid->heights, &ground->filled, error);
    for (size_t n = 0; n < nodes && status == SB_OK; ++n) {
        if (!isinf(grid->heights[n])) continue;
        ++ground->outside;
        grid->heights[n] = (double)NAN;
    }
    return status;
}

static sb_status make_grid(const sb_body *body, const sb_terrain_area *wanted, sb_terrain *ground, sb_error *error)
{
    const bool windowed = body->window.present;
    sb_status status = open_layers(body, ground, error);
    if (status == SB_OK) status = choose_projection(body, ground, error);
    for (size_t i = 0; i < ground->count && status == SB_OK; ++i)
        status = sb_layer_project(&ground->layers[i], ground->projection, error);
    if (status != SB_OK) return status;
    sort_layers(ground);
    status = choose_area(body, wanted, ground, error);
    if (status != SB_OK) return status;
    if (ground->count == 1 && !ground->layers->projection && !(body->resample > 0)) {
        status = make_alone(ground, windowed, error);
    } else {
        status = plan_grid(body, windowed || !wanted, ground, error);
        if (status == SB_OK) status = make_joined(ground, error);
    }
    return status == SB_OK ? complete(body, ground, error) : status;
}

sb_status sb_terrain_make(const sb_body *body, const sb_terrain_area *wanted, sb_mesh *mesh, sb_error *error)
{
    sb_terrain ground = {0};
    sb_mesh made = {0};
    sb_status status = make_grid(body, wanted, &ground, error);
    if (status == SB_OK) {
        ground.grid.x -= body->origin[0];
        ground.grid.y -= body->origin[1];
        status = sb_grid_mesh(ground.layers[0].path, &ground.grid, &made, error);
    }
    if (status == SB_OK) status = sb_terrain_tell(body, &ground, &made.told, error);
    if (status == SB_OK && ground.projection[0] && !(made.projection = sb_strdup(ground.projection)))
        status = sb_fail_memory(error, "terrain");
    if (status == SB_OK)
        *mesh = made;
    else
        sb_mesh_free(&made);
    close_layers(&ground);
    return status;
}

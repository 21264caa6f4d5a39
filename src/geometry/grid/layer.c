/* Places the files of a terrain in one projection, and reads the part of each that is used. */
#include "geometry/grid/layer.h"

#include "base/memory.h"
#include "geometry/grid/sample.h"

#include <stdio.h>

static sb_status open_text(const char *path, sb_layer *layer, sb_error *error)
{
    sb_status status = sb_grid_read_text(path, &layer->grid, error);
    if (status != SB_OK) return status;
    const sb_grid *grid = &layer->grid;
    layer->about = (sb_raster_about){
        .columns = grid->columns, .rows = grid->rows, .x = grid->x, .y = grid->y, .dx = grid->dx, .dy = grid->dy};
    return SB_OK;
}

/* Chooses the system and finds its unit. */
static sb_status find_system(const char *crs, sb_layer *layer, sb_error *error)
{
    const sb_raster_about *about = &layer->about;
    sb_error reason = {0};
    if (crs && crs[0])
        snprintf(layer->system, sizeof layer->system, "%s", crs);
    else if (about->crs == SB_RASTER_CRS_EPSG)
        snprintf(layer->system, sizeof layer->system, "EPSG:%u", about->epsg);
    else if (about->crs == SB_RASTER_CRS_OTHER)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: its coordinate system has no EPSG code, expected the key crs with its code or PROJ "
                       "string",
                       layer->path);
    if (!layer->system[0]) return SB_OK;
    if (sb_projection_unit_of(layer->system, &layer->unit, &reason) == SB_OK) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: its coordinate system %.700s", layer->path, reason.text);
}

sb_status sb_layer_open(const char *path, const char *crs, double datum, sb_layer *layer, sb_error *error)
{
    *layer = (sb_layer){.path = path, .datum = datum, .raster = sb_raster_is(path)};
    sb_status status = layer->raster ? sb_raster_about_file(path, &layer->about, error) : open_text(path, layer, error);
    if (status == SB_OK) status = find_system(crs, layer, error);
    if (status != SB_OK) sb_layer_close(layer);
    return status;
}

void sb_layer_close(sb_layer *layer)
{
    sb_projection_destroy(layer->projection);
    sb_free(layer->grid.heights);
    *layer = (sb_layer){.path = layer->path};
}

static void include(sb_terrain_area *area, const double place[2])
{
    for (int k = 0; k < 2; ++k) {
        area->min[k] = fmin(area->min[k], place[k]);
        area->max[k] = fmax(area->max[k], place[k]);
    }
}

static const sb_terrain_area nowhere = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

static void to_ground(const sb_layer *layer, double place[2])
{
    sb_projection_forward(layer->projection, place);
}

/* PROJ gives longitudes from -180 to 180 degrees. A file may have them from 0 to 360. */
static void to_file(const sb_layer *layer, double place[2])
{
    const double middle = layer->about.x + 0.5 * layer->about.dx * (double)layer->about.columns;
    sb_projection_backward(layer->projection, place);
    if (layer->unit == SB_PROJECTION_DEGREES) place[0] -= 360 * round((place[0] - middle) / 360);
}

/* Returns the extent of a rectangle after the transformation of places on its edges and within. */
static sb_terrain_area transformed(const sb_layer *layer, const sb_terrain_area *from,
                                   void transform(const sb_layer *, double[2]))
{
    enum { STEPS = 32 };
    if (!layer->projection) return *from;
    sb_terrain_area area = nowhere;
    for (int j = 0; j <= STEPS; ++j)
        for (int i = 0; i <= STEPS; ++i) {
            double place[2] = {from->min[0] + i * (from->max[0] - from->min[0]) / STEPS,
                               from->min[1] + j * (from->max[1] - from->min[1]) / STEPS};
            transform(layer, place);
            if (isfinite(place[0]) && isfinite(place[1])) include(&area, place);
        }
    return area;
}

/* Returns the length in m of a step from the middle of the grid along axis k. */
static double step_length(const sb_layer *layer, int k)
{
    const sb_raster_about *of = &layer->about;
    double from[2] = {of->x + 0.5 * of->dx * (double)of->columns, of->y + 0.5 * of->dy * (double)of->rows};
    double to[2] = {from[0] + (k == 0 ? of->dx : 0), from[1] + (k == 1 ? of->dy : 0)};
    if (!layer->projection) return k == 0 ? of->dx : of->dy;
    sb_projection_forward(layer->projection, from);
    sb_projection_forward(layer->projection, to);
    return hypot(to[0] - from[0], to[1] - from[1]);
}

sb_terrain_area sb_layer_cells(const sb_raster_about *of)
{
    return (sb_terrain_area){{of->x - 0.5 * of->dx, of->y - 0.5 * of->dy},
                             {of->x + of->dx * ((double)of->columns - 0.5), of->y + of->dy * ((double)of->rows - 0.5)}};
}

sb_status sb_layer_project(sb_layer *layer, const char *to, sb_error *error)
{
    const sb_raster_about *of = &layer->about;
    sb_error reason = {0};
    if (layer->system[0] && strcmp(layer->system, to) != 0 &&
        sb_projection_create(layer->system, to, &layer->projection, &reason) != SB_OK)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %.700s", layer->path, reason.text);
    const sb_terrain_area cells = sb_layer_cells(of);
    layer->area = transformed(layer, &cells, to_ground);
    layer->cell = fmin(step_length(layer, 0), step_length(layer, 1));
    if (isfinite(layer->cell) && layer->cell > 0 && layer->area.min[0] < layer->area.max[0]) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: its middle at (%g, %g) in %.100s has no place in the projection %.100s, expected the key "
                   "projection with one for that region",
                   layer->path, of->x + 0.5 * of->dx * (double)of->columns, of->y + 0.5 * of->dy * (double)of->rows,
                   layer->system, to);
}

/* Finds the nodes within [low, high] along one axis, and `around` more. Returns false if there are none. */
static bool find_nodes(double low, double high, double start, double step, uint64_t count, int around, uint64_t *first,
                       uint64_t *length)
{
    const double from = floor((low - start) / step) - around, to = ceil((high - start) / step) + around;
    const double least = fmax(from, 0), most = fmin(to, (double)(count - 1));
    if (!(most >= least)) return false;
    *first = (uint64_t)least;
    *length = (uint64_t)(most - least) + 1;
    if (*length == 1) { /* linear interpolation needs two */
        *first -= *first + 1 == count;
        *length = 2;
    }
    return true;
}

static void crop(sb_grid *grid, const sb_raster_part *part)
{
    for (size_t j = 0; j < part->rows; ++j)
        memmove(grid->heights + j * part->columns, grid->heights + (part->row + j) * grid->columns + part->column,
                part->columns * sizeof *grid->heights);
    grid->x += grid->dx * (double)part->column;
    grid->y += grid->dy * (double)part->row;
    grid->columns = (size_t)part->columns;
    grid->rows = (size_t)part->rows;
}

sb_status sb_layer_load(sb_layer *layer, const sb_terrain_area *area, int around, sb_error *error)
{
    const sb_raster_about *of = &layer->about;
    const sb_terrain_area own = transformed(layer, area, to_file);
    sb_raster_part part;
    if (!find_nodes(own.min[0], own.max[0], of->x, of->dx, of->columns, around, &part.column, &part.columns) ||
        !find_nodes(own.min[1], own.max[1], of->y, of->dy, of->rows, around, &part.row, &part.rows)) {
        sb_free(layer->grid.heights);
        layer->grid = (sb_grid){0};
        return SB_OK;
    }
    sb_status status = SB_OK;
    if (layer->raster)
        status = sb_raster_read(layer->path, &part, &layer->grid, error);
    else
        crop(&layer->grid, &part);
    for (size_t n = 0; n < layer->grid.columns * layer->grid.rows && status == SB_OK; ++n)
        layer->grid.heights[n] = layer->datum + (layer->down ? -1 : 1) * layer->grid.heights[n];
    return status;
}

double sb_layer_height(const sb_layer *layer, double x, double y)
{
    double place[2] = {x, y};
    if (!layer->grid.heights) return (double)INFINITY;
    if (layer->projection) to_file(layer, place);
    return sb_grid_height(&layer->grid, place[0], place[1]);
}

#include "geometry/grid/bed.h"
#include "base/memory.h"
#include "geometry/grid/missing.h"
#include "geometry/grid/projection.h"
#include "geometry/grid/raster.h"
#include "geometry/mesh/mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

size_t sb_bed_columns(const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    return (size_t)lround((o->x_max - o->x_min) / o->cell);
}

size_t sb_bed_rows(const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    return scene->dimensions == 2 ? 1 : (size_t)lround((o->y_max - o->y_min) / o->cell);
}

/* The cell centres to which heights are written. */
typedef struct raster {
    double x, y, cell; /* m, first centre */
    size_t columns, rows;
    double *height;        /* NAN: none yet */
    double min[2], max[2]; /* m, of all that was drawn */
    double floor, top;     /* m, where heights are expected */
    bool replace;          /* a new height replaces the one that is there; otherwise the higher one stays */
} raster;

static raster raster_of(const sb_scene *scene, double *height)
{
    const sb_offshore_settings *o = &scene->offshore;
    return (raster){.x = o->x_min + 0.5 * o->cell,
                    .y = scene->dimensions == 2 ? 0 : o->y_min + 0.5 * o->cell,
                    .cell = o->cell,
                    .columns = sb_bed_columns(scene),
                    .rows = sb_bed_rows(scene),
                    .min = {HUGE_VAL, HUGE_VAL},
                    .max = {-HUGE_VAL, -HUGE_VAL},
                    .floor = scene->domain.min.z,
                    .top = scene->domain.max.z,
                    .height = height};
}

static void include(raster *r, sb_vec3 v)
{
    r->min[0] = fmin(r->min[0], v.x);
    r->min[1] = fmin(r->min[1], v.y);
    r->max[0] = fmax(r->max[0], v.x);
    r->max[1] = fmax(r->max[1], v.y);
}

/* First and last centre within [low, high], clamped to the grid; *first > *last when there is none. */
static void range(double low, double high, double start, double cell, size_t count, long *first, long *last)
{
    const double edge = 1e-9; /* cells, so that a centre on the edge of a triangle is within */
    *first = (long)fmin(fmax(ceil((low - start) / cell - edge), 0), (double)count);
    *last = (long)fmin(fmax(floor((high - start) / cell + edge), -1), (double)count - 1);
}

/* Writes the heights of one triangle at the centres that it covers, seen from above. */
static void draw(const raster *r, sb_vec3 a, sb_vec3 b, sb_vec3 c)
{
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return; /* upright */
    long left, right, low, high;
    range(fmin(a.x, fmin(b.x, c.x)), fmax(a.x, fmax(b.x, c.x)), r->x, r->cell, r->columns, &left, &right);
    range(fmin(a.y, fmin(b.y, c.y)), fmax(a.y, fmax(b.y, c.y)), r->y, r->cell, r->rows, &low, &high);
    for (long j = low; j <= high; j++)
        for (long i = left; i <= right; i++) {
            const double x = r->x + (double)i * r->cell, y = r->y + (double)j * r->cell, slack = -1e-9;
            const double wb = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
            const double wc = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
            if (wb < slack || wc < slack || 1 - wb - wc < slack) continue;
            double *height = &r->height[(size_t)j * r->columns + (size_t)i];
            const double z = a.z + wb * (b.z - a.z) + wc * (c.z - a.z);
            if (r->replace || !(*height >= z)) *height = z;
        }
}

/* Moves the description of a grid from its mesh to the list. */
static sb_status keep_told(const char *name, sb_mesh *mesh, sb_offshore_told_list *told, sb_error *error)
{
    size_t capacity = told->count;
    if (!mesh->told) return SB_OK;
    if (sb_grow((void **)&told->items, &capacity, told->count + 1, sizeof *told->items))
        return sb_fail_memory(error, "the description of a terrain");
    sb_offshore_told *item = &told->items[told->count++];
    *item = (sb_offshore_told){.text = mesh->told};
    snprintf(item->name, sizeof item->name, "%s", name);
    mesh->told = NULL;
    return SB_OK;
}

static sb_status draw_meshes(raster *r, const char *name, sb_mesh *meshes, size_t count, sb_offshore_told_list *told,
                             sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t m = 0; m < count && status == SB_OK; m++) {
        const sb_vec3 *v = meshes[m].vertices;
        for (size_t i = 0; i < meshes[m].vertex_count; i++) include(r, v[i]);
        for (size_t t = 0; t < meshes[m].triangle_count; t++) {
            const uint32_t *corner = meshes[m].triangles[t];
            draw(r, v[corner[0]], v[corner[1]], v[corner[2]]);
        }
        status = keep_told(name, &meshes[m], told, error);
    }
    return status;
}

/* Warns of heights of a grid's nodes at the cells that are most likely missing ones. */
static sb_status warn_missing(const raster *r, const char *name, const sb_mesh *mesh, sb_offshore_told_list *told,
                              sb_error *error)
{
    const double side = r->rows > 1 ? 0.5 * r->cell : 0, half = 0.5 * r->cell;
    const sb_vec3 min = sb_vec(r->x - half, r->y - side, r->floor);
    const sb_vec3 max =
        sb_vec(r->x + r->cell * (double)r->columns - half, r->y + r->cell * (double)(r->rows - 1) + side, r->top);
    sb_missing found;
    char text[600];
    const sb_status status = sb_missing_find(mesh, min, max, &found, error);
    if (status != SB_OK || found.count == 0) return status;
    sb_missing_tell(&found, mesh, "model", text, sizeof text);
    return sb_offshore_warn(told, error, "%s: %s", name, text);
}

static void free_meshes(sb_mesh *meshes, size_t count)
{
    for (size_t m = 0; m < count; m++) sb_mesh_free(&meshes[m]);
    sb_free(meshes);
}

/* Keeps the projection of the first ground that has one. */
static void keep_projection(sb_mesh *mesh, sb_offshore_start *start)
{
    if (start->projection) return;
    start->projection = mesh->projection;
    mesh->projection = NULL;
}

/* alone: there is no model of the bodies, which warns of their grids. */
static sb_status draw_body(raster *r, const sb_body *body, bool alone, sb_offshore_start *start, sb_error *error)
{
    char name[SB_NAME_MAX + 8];
    snprintf(name, sizeof name, "body \"%s\"", body->name);
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_status status = sb_mesh_from_body(body, r->cell, &meshes, &count, error);
    for (size_t m = 0; m < count && status == SB_OK; m++) {
        keep_projection(&meshes[m], start);
        if (alone && meshes[m].node_count > 0) status = warn_missing(r, name, &meshes[m], &start->told, error);
    }
    if (status == SB_OK) status = draw_meshes(r, body->name, meshes, count, &start->told, error);
    free_meshes(meshes, count);
    return status;
}

/* ---- grids of the model itself ---- */

/* Fails when a place of the ground is elsewhere in the projection of the grids before it. */
static sb_status check_projection(const sb_body *body, const sb_mesh *ground, const char *before, double cell,
                                  sb_error *error)
{
    if (!ground->projection || !before || strcmp(ground->projection, before) == 0) return SB_OK;
    sb_projection *between = NULL;
    const sb_status status = sb_projection_create(ground->projection, before, &between, error);
    if (status != SB_OK) return status;
    const sb_vec3 at = sb_scale(sb_sub(ground->vertices[0], body->translate), 1 / body->scale);
    double place[2] = {at.x, at.y};
    sb_projection_forward(between, place);
    sb_projection_destroy(between);
    const double away = body->scale * hypot(place[0] - at.x, place[1] - at.y);
    if (away < cell) return SB_OK;
    if (!isfinite(away))
        return sb_fail(
            error, SB_BAD_INPUT,
            "its first node has no place in %.100s, the projection of the grids before it, expected the same "
            "projection for all grids",
            before);
    return sb_fail(error, SB_BAD_INPUT,
                   "its projection %.100s puts its first node %.3g m from where %.100s of the grids before it does, "
                   "expected the same projection for all grids",
                   ground->projection, away, before);
}

/* Draws the ground of a grid, whose projection is that of the grids before it. */
static sb_status draw_ground(raster *r, const sb_body *body, sb_offshore_start *start, sb_error *error)
{
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_status status = sb_mesh_from_body(body, r->cell, &meshes, &count, error);
    for (size_t m = 0; m < count && status == SB_OK; m++) {
        status = check_projection(body, &meshes[m], start->projection, r->cell, error);
        keep_projection(&meshes[m], start);
        if (status == SB_OK) status = warn_missing(r, body->name, &meshes[m], &start->told, error);
    }
    if (status == SB_OK) status = draw_meshes(r, body->name, meshes, count, &start->told, error);
    free_meshes(meshes, count);
    return status;
}

static sb_status draw_grid(raster *r, const sb_offshore_grid *grid, const char *key, sb_voids voids,
                           sb_offshore_start *start, sb_error *error)
{
    const bool own = grid->projection && grid->projection[0];
    const bool states = sb_raster_is(grid->file) || (grid->crs && grid->crs[0]); /* else it is in metres of any */
    sb_body body = {.shape = SB_SHAPE_GRID,
                    .role = SB_ROLE_TERRAIN,
                    .file = grid->file,
                    .scale = grid->scale,
                    .positive = grid->positive,
                    .datum = grid->datum,
                    .crs = grid->crs,
                    .projection = own || !states ? grid->projection : start->projection,
                    .voids = voids,
                    .translate = sb_vec(grid->x, grid->y, 0)};
    snprintf(body.name, sizeof body.name, "%s", key);
    const size_t first = start->told.count;
    sb_error reason = {0};
    const sb_status status = draw_ground(r, &body, start, &reason);
    if (status != SB_OK) {
        char prefix[80]; /* the scene has no such body */
        const int length = snprintf(prefix, sizeof prefix, "body \"%s\": ", key);
        const bool named = strncmp(reason.text, prefix, (size_t)length) == 0;
        return sb_fail(error, status, "%s: %s", key, reason.text + (named ? length : 0));
    }
    for (size_t k = first; k < start->told.count; k++) start->told.items[k].is_key = true;
    return status;
}

static void clear(const raster *r)
{
    for (size_t k = 0; k < r->columns * r->rows; k++) r->height[k] = (double)NAN;
}

/* What may be wrong with grids that are elsewhere than the model. */
static const char *remedy(const raster *r)
{
    const bool small = r->max[0] - r->min[0] < r->cell && r->max[1] - r->min[1] < r->cell;
    if (small && r->min[0] >= -180 && r->max[0] <= 360 && r->min[1] >= -90 && r->max[1] <= 90)
        return "; these look like longitudes and latitudes, expected metres, or the key crs, such as EPSG:4326";
    const double x = r->x + r->cell * (double)(r->columns - 1), y = r->y + r->cell * (double)(r->rows - 1);
    if (r->min[0] > x || r->max[0] < r->x || (r->rows > 1 && (r->min[1] > y || r->max[1] < r->y)))
        return "; the key shift of a grid moves it";
    return "";
}

/* Fails when a cell has no height. */
static sb_status check_covered(const raster *r, sb_error *error)
{
    size_t missing = 0, first = 0;
    for (size_t k = r->columns * r->rows; k-- > 0;)
        if (isnan(r->height[k])) {
            missing++;
            first = k;
        }
    if (missing == 0) return SB_OK;
    const double x = r->x + (double)(first % r->columns) * r->cell, y = r->y + (double)(first / r->columns) * r->cell;
    const bool hole = x >= r->min[0] && x <= r->max[0] && y >= r->min[1] && y <= r->max[1];
    char more[60] = "";
    if (missing > 1) snprintf(more, sizeof more, " and at %zu other cell%s", missing - 1, missing > 2 ? "s" : "");
    return sb_fail(error, SB_BAD_INPUT,
                   "offshore.terrain: no height at (%.9g, %.9g) m%s; its grids lie from (%.9g, %.9g) to (%.9g, %.9g); "
                   "expected grids that cover the model, or a smaller offshore.min and max%s",
                   x, y, more, r->min[0], r->min[1], r->max[0], r->max[1],
                   hole ? "; this place is in a void, or in a gap between grids: a coarse grid before them covers it"
                        : remedy(r));
}

/* What the voids of grid k of offshore.terrain are left to. */
static sb_voids voids_of(size_t k, size_t count)
{
    return k > 0 ? SB_VOIDS_SHOW : count > 1 ? SB_VOIDS_COVER : SB_VOIDS_BARE;
}

sb_status sb_bed_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    const sb_offshore_settings *o = &scene->offshore;
    double *bed = start->bed;
    raster r = raster_of(scene, bed);
    sb_status status = SB_OK;
    clear(&r);
    start->uncovered = 0;
    r.replace = o->terrain_count > 0;
    for (size_t k = 0; status == SB_OK && k < o->terrain_count; k++) {
        char key[48];
        snprintf(key, sizeof key, "offshore.terrain[%zu]", k);
        status = draw_grid(&r, &o->terrain[k], key, voids_of(k, o->terrain_count), start, error);
    }
    if (o->terrain_count > 0) return status == SB_OK ? check_covered(&r, error) : status;
    for (size_t b = 0; status == SB_OK && b < scene->body_count; b++)
        status = draw_body(&r, &scene->bodies[b], sb_scene_grid_alone(scene), start, error);
    for (size_t k = 0; k < r.columns * r.rows; k++) {
        start->uncovered += isnan(bed[k]) && scene->body_count > 0;
        if (!(bed[k] >= scene->domain.min.z)) bed[k] = scene->domain.min.z;
    }
    return status;
}

/* Fails when the uplift lies beside the model, where it would raise nothing. */
static sb_status check_reached(const raster *r, sb_error *error)
{
    for (size_t k = 0; k < r->columns * r->rows; k++)
        if (!isnan(r->height[k])) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "offshore.uplift: its grid lies from (%.9g, %.9g) to (%.9g, %.9g), and covers no cell of the model; "
                   "expected a grid within offshore.min and max%s",
                   r->min[0], r->min[1], r->max[0], r->max[1], remedy(r));
}

/* Part of the greatest depth from which on an uplift is probably no uplift, but heights of terrain or of another unit.
 */
static const double HIGH_UPLIFT = 0.5;

/* Warns of an uplift that moves the surface too far where there is water. */
static sb_status warn_high(const raster *r, const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    const double level = scene->offshore.level;
    double deepest = 0, most = 0;
    size_t at = 0;
    for (size_t k = 0; k < r->columns * r->rows; k++) {
        if (!(start->bed[k] < level)) continue;
        deepest = fmax(deepest, level - start->bed[k]);
        if (fabs(r->height[k]) <= most) continue;
        most = fabs(r->height[k]);
        at = k;
    }
    if (most <= HIGH_UPLIFT * deepest) return SB_OK;
    return sb_offshore_warn(&start->told, error,
                            "offshore.uplift: it moves the surface by %.4g m at (%.9g, %.9g), and the water is at most "
                            "%.4g m deep; expected by how much the ground moves, not its height; check scale",
                            r->height[at], r->x + (double)(at % r->columns) * r->cell,
                            r->y + (double)(at / r->columns) * r->cell, deepest);
}

sb_status sb_uplift_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error)
{
    raster r = raster_of(scene, start->depth);
    sb_status status = SB_OK;
    clear(&r);
    r.floor -= scene->offshore.level;
    r.top -= scene->offshore.level;
    if (scene->offshore.has_uplift) {
        status = draw_grid(&r, &scene->offshore.uplift, "offshore.uplift", SB_VOIDS_ZERO, start, error);
        if (status == SB_OK) status = check_reached(&r, error);
    }
    for (size_t k = 0; k < r.columns * r.rows; k++)
        if (isnan(r.height[k])) r.height[k] = 0;
    return status == SB_OK ? warn_high(&r, scene, start, error) : status;
}

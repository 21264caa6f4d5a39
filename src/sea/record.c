/* Given water from the record of an earlier run: surface and velocities over depth along a plane, of which only what
   comes in is replayed. */
#include "base/memory.h"
#include "base/rows.h"
#include "scene/record_columns.h"
#include "sea/line_check.h"
#include "sea/parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Channels of the series: as read, and, once `keep_incoming` has changed the rows, of the incoming part; its second
   channel is then the surface of the record. */
enum { SURFACE, BED, VELOCITY, CHANNELS = VELOCITY + 3 * SB_RECORD_LAYERS };
enum { RECORDED = BED };
_Static_assert((int)CHANNELS == (int)SB_LINE_CHANNELS, "a record fills a row of a series");

typedef struct record {
    double level, gravity;
    double inward[2]; /* unit vector, across the plane into the domain */
    double surface, speed;
    sb_line series;
} record;

static void destroy(void *state)
{
    record *sea = state;
    if (sea) sb_line_free(&sea->series);
    sb_free(sea);
}

/* A column that was dry, or a layer without particles, has empty cells: it is at rest, its surface is the bed. */
static sb_status read_row(const sb_rows *rows, double *x, double *y, double *time, double *values, sb_error *error)
{
    sb_status status = sb_rows_number(rows, SB_RECORD_TIME, "time_s", time, error);
    if (status == SB_OK) status = sb_rows_number(rows, SB_RECORD_X, "x_m", x, error);
    if (status == SB_OK) status = sb_rows_number(rows, SB_RECORD_Y, "y_m", y, error);
    if (status == SB_OK) status = sb_rows_number(rows, SB_RECORD_BED, "bed_m", &values[BED], error);
    if (status == SB_OK) values[SURFACE] = values[BED];
    if (status == SB_OK && *rows->cells[SB_RECORD_SURFACE])
        status = sb_rows_number(rows, SB_RECORD_SURFACE, "surface_m", &values[SURFACE], error);
    for (size_t c = 0; status == SB_OK && c < 3 * SB_RECORD_LAYERS; c++) {
        values[VELOCITY + c] = 0;
        if (*rows->cells[SB_RECORD_VELOCITY + c])
            status = sb_rows_number(rows, SB_RECORD_VELOCITY + c, "a velocity", &values[VELOCITY + c], error);
    }
    return status;
}

static sb_status read_rows(sb_rows *rows, const char *plane, sb_line *series, sb_error *error)
{
    char *line = sb_rows_next(rows), other[SB_NAME_MAX] = "";
    if (!line || strncmp(line, SB_RECORD_HEADER, strlen(SB_RECORD_HEADER)) != 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: does not begin with the header of a record, expected record.csv of a run", rows->path);
    sb_status status = SB_OK;
    while (status == SB_OK && (line = sb_rows_next(rows))) {
        char place[SB_ROWS_PLACE];
        double x, y, time, values[CHANNELS];
        status = sb_rows_cut(rows, line, error);
        if (status != SB_OK) return status;
        if (rows->cell_count != SB_RECORD_COLUMNS)
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %zu columns, expected %d", rows->path, rows->line,
                           rows->cell_count, SB_RECORD_COLUMNS);
        if (strcmp(rows->cells[SB_RECORD_PLANE], plane) != 0) {
            if (!*other) snprintf(other, sizeof other, "%.63s", rows->cells[SB_RECORD_PLANE]);
            continue;
        }
        status = read_row(rows, &x, &y, &time, values, error);
        if (status == SB_OK) status = sb_line_add(series, x, y, time, values, sb_rows_place(rows, place), error);
    }
    if (status == SB_OK && series->count == 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: has no rows of the plane %s, expected sea.plane: %s", rows->path,
                       plane, *other ? other : "the name of a recorded plane");
    return status;
}

/* Mean over the depth of the velocity across the plane. */
static double mean_across(const record *sea, const double *values)
{
    double sum = 0;
    for (int j = 0; j < SB_RECORD_LAYERS; j++)
        sum += values[VELOCITY + j] * sea->inward[0] + values[VELOCITY + SB_RECORD_LAYERS + j] * sea->inward[1];
    return sum / SB_RECORD_LAYERS;
}

/* Changes a row to what would pass if nothing came back. Long waves have the invariants u + 2 sqrt(g h), which comes
   in, and u - 2 sqrt(g h), which goes out and is that of still water in the incoming part. Water on land is not split.
 */
static void keep_incoming(const record *sea, double *values)
{
    const double bed = values[BED], h = values[SURFACE] - bed, still = sea->level - bed;
    values[RECORDED] = values[SURFACE];
    if (!(still > 0) || !(h > 1e-3 * still)) return;
    const double un = mean_across(sea, values), wave = sqrt(sea->gravity * h), rest = sqrt(sea->gravity * still);
    const double part = fmax(0.25 * (un + 2 * wave + 2 * rest), 0), change = 0.5 * (un + 2 * wave - 2 * rest) - un;
    values[SURFACE] = bed + part * part / sea->gravity;
    for (int j = 0; j < 2 * SB_RECORD_LAYERS; j++) values[VELOCITY + j] += change * sea->inward[j / SB_RECORD_LAYERS];
}

/* Between the middles of two layers, linear; beyond the outer ones, constant. */
static double over_depth(const double *values, int axis, double fraction)
{
    const double *layer = values + VELOCITY + axis * SB_RECORD_LAYERS;
    const double at = fmin(fmax(fraction * SB_RECORD_LAYERS - 0.5, 0), SB_RECORD_LAYERS - 1);
    const int low = (int)fmin(floor(at), SB_RECORD_LAYERS - 2);
    return layer[low] + (at - low) * (layer[low + 1] - layer[low]);
}

static void at(const void *state, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    const record *sea = state;
    double values[CHANNELS], rates[CHANNELS];
    sb_line_at(&sea->series, t, x, y, values, rates);
    out->surface = values[SURFACE];
    const double fraction = sb_sea_fraction(z, bed, out->surface);
    for (int axis = 0; axis < 3; axis++) {
        out->velocity[axis] = over_depth(values, axis, fraction);
        out->acceleration[axis] = over_depth(rates, axis, fraction);
    }
    out->velocity[2] += fraction * (rates[SURFACE] - rates[RECORDED]);
}

/* The plane's normal that points to the middle of the domain. */
static sb_status find_inward(record *made, const sb_scene *scene, sb_error *error)
{
    const sb_line_point *a = &made->series.points[0], *b = &made->series.points[made->series.count - 1];
    const sb_domain *domain = &scene->domain;
    const double tx = b->x - a->x, ty = b->y - a->y, length = hypot(tx, ty);
    const double nx = length > 0 ? ty / length : 1, ny = length > 0 ? -tx / length : 0;
    const double dx = 0.5 * (domain->min.x + domain->max.x) - 0.5 * (a->x + b->x);
    const double dy = scene->dimensions == 2 ? 0 : 0.5 * (domain->min.y + domain->max.y) - 0.5 * (a->y + b->y);
    const double ahead = dx * nx + dy * ny;
    if (!(fabs(ahead) > scene->resolution))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: the plane %s passes through the middle of the domain, expected it at a side",
                       scene->given.file, scene->given.plane);
    made->inward[0] = ahead > 0 ? nx : -nx;
    made->inward[1] = ahead > 0 ? ny : -ny;
    return SB_OK;
}

/* Changes all rows, and finds the greatest values. */
static void split_rows(record *made)
{
    made->surface = -HUGE_VAL;
    for (size_t p = 0; p < made->series.count; p++) {
        const sb_line_point *point = &made->series.points[p];
        for (size_t i = 0; i < point->count; i++) {
            double *values = point->values + i * CHANNELS;
            keep_incoming(made, values);
            made->surface = fmax(made->surface, values[SURFACE]);
            for (const double *u = values + VELOCITY; u < values + VELOCITY + SB_RECORD_LAYERS; u++)
                made->speed = fmax(made->speed, hypot(hypot(u[0], u[SB_RECORD_LAYERS]), u[2 * SB_RECORD_LAYERS]));
        }
    }
}

static sb_status fill(record *made, const sb_scene *scene, sb_sea_notes *notes, sb_error *error)
{
    const sb_given_sea *given = &scene->given;
    sb_rows rows;
    sb_status status = sb_rows_open(given->file, &rows, error);
    if (status != SB_OK) return status;
    status = read_rows(&rows, given->plane, &made->series, error);
    sb_rows_close(&rows);
    if (status == SB_OK) status = sb_line_check(&made->series, scene, given->file, error);
    if (status == SB_OK) status = find_inward(made, scene, error);
    if (status != SB_OK) return status;
    sb_line_doubt(&made->series, scene, notes->warning, sizeof notes->warning);
    split_rows(made);
    status = sb_line_finish(&made->series, error);
    snprintf(notes->about, sizeof notes->about, "the incoming part of the record of plane %s, %zu point%s",
             given->plane, made->series.count, made->series.count == 1 ? "" : "s");
    return status;
}

static sb_status create(const sb_scene *scene, const sb_offshore_start *grid, void **state, sb_sea_notes *notes,
                        sb_error *error)
{
    (void)grid;
    record *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "sea");
    made->level = scene->given.level;
    made->gravity = scene->fluid.gravity;
    made->series.channels = CHANNELS;
    sb_status status = fill(made, scene, notes, error);
    if (status != SB_OK) {
        destroy(made);
        return status;
    }
    *state = made;
    return SB_OK;
}

static double greatest_surface(const void *state)
{
    return ((const record *)state)->surface;
}

static double greatest_speed(const void *state)
{
    return ((const record *)state)->speed;
}

const sb_sea_form sb_sea_form_record = {create, at, greatest_surface, greatest_speed, destroy, NULL, NULL};

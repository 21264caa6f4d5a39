/* Given water from a table: surface and depth-averaged velocity at one or more points of a line. */
#include "base/memory.h"
#include "sea/line_check.h"
#include "sea/parts.h"
#include "sea/table_read.h"

#include <math.h>
#include <stdio.h>

typedef struct table {
    double datum;
    sb_line series;
} table;

static void destroy(void *state)
{
    table *sea = state;
    if (sea) sb_line_free(&sea->series);
    sb_free(sea);
}

/* Height of the surface over the still level where the run begins, at the point where it is nearest to it: points on
   land have that of the ground. */
static double first_height(const table *sea, const sb_scene *scene)
{
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < sea->series.count; i++) {
        double values[SB_TABLE_CHANNELS], rates[SB_TABLE_CHANNELS];
        const sb_line_point *point = &sea->series.points[i];
        sb_line_at(&sea->series, -scene->given.start, point->x, point->y, values, rates);
        const double away = sea->datum + values[SB_TABLE_ETA] - scene->given.level;
        if (fabs(away) < fabs(nearest)) nearest = away;
    }
    return nearest;
}

/* A wrong datum puts the first surface far from the still level. Half the depth below it is no wave that a run can
   begin with. */
static sb_status check_datum(const table *sea, const sb_scene *scene, sb_error *error)
{
    const double away = first_height(sea, scene), depth = scene->given.level - scene->domain.min.z;
    if (fabs(away) <= 0.5 * depth) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s: with sea.datum %g m the surface begins at %g m, %g m from the still level of %g m, expected "
        "at most %g m",
        scene->given.file, sea->datum, scene->given.level + away, fabs(away), scene->given.level, 0.5 * depth);
}

static double greatest_surface(const void *state)
{
    const table *sea = state;
    double most = -HUGE_VAL;
    for (size_t p = 0; p < sea->series.count; p++)
        for (size_t i = 0; i < sea->series.points[p].count; i++)
            most = fmax(most, sea->series.points[p].values[i * SB_TABLE_CHANNELS + SB_TABLE_ETA]);
    return sea->datum + most;
}

static double greatest_speed(const void *state)
{
    const table *sea = state;
    double most = 0;
    for (size_t p = 0; p < sea->series.count; p++)
        for (size_t i = 0; i < sea->series.points[p].count; i++) {
            const double *row = sea->series.points[p].values + i * SB_TABLE_CHANNELS;
            most = fmax(most, hypot(row[SB_TABLE_U], row[SB_TABLE_V]));
        }
    return most;
}

/* Multiple of the speed of long waves that no such water has: the front of a dam break has 2. */
static const double FAST = 3;

static void doubt_speed(const table *sea, const sb_scene *scene, char *text, size_t size)
{
    const double depth = greatest_surface(sea) - scene->domain.min.z, speed = greatest_speed(sea);
    const double waves = sqrt(scene->fluid.gravity * fmax(depth, 0));
    if (*text || !(waves > 0) || !(speed > FAST * waves)) return;
    snprintf(text, size,
             "sea.file: its velocities are up to %.3g m/s, %.2g times as fast as long waves in its water: are their "
             "units m/s?",
             speed, speed / waves);
}

static sb_status fill(table *made, const sb_scene *scene, sb_sea_notes *notes, sb_error *error)
{
    const sb_given_sea *given = &scene->given;
    sb_rows rows;
    sb_status status = sb_rows_open(given->file, &rows, error);
    if (status != SB_OK) return status;
    status = sb_table_read(&rows, scene, &made->series, error);
    sb_rows_close(&rows);
    for (size_t i = 0; i < made->series.count; i++) {
        made->series.points[i].x -= given->zero[0];
        made->series.points[i].y -= given->zero[1];
    }
    if (status == SB_OK) status = sb_line_check(&made->series, scene, given->file, error);
    if (status == SB_OK) status = sb_line_finish(&made->series, error);
    if (status == SB_OK) sb_line_doubt(&made->series, scene, notes->warning, sizeof notes->warning);
    if (status == SB_OK) status = check_datum(made, scene, error);
    if (status == SB_OK) doubt_speed(made, scene, notes->warning, sizeof notes->warning);
    const size_t count = made->series.count;
    snprintf(notes->about, sizeof notes->about, "a table of %zu point%s, datum %g m", count,
             count == 1 ? ", equal along the side" : "s", made->datum);
    return status;
}

static sb_status create(const sb_scene *scene, const sb_offshore_start *grid, void **state, sb_sea_notes *notes,
                        sb_error *error)
{
    (void)grid;
    table *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "sea");
    made->datum = scene->given.datum;
    made->series.channels = SB_TABLE_CHANNELS;
    sb_status status = fill(made, scene, notes, error);
    if (status != SB_OK) {
        destroy(made);
        return status;
    }
    *state = made;
    return SB_OK;
}

/* The horizontal velocity is uniform over the depth; the vertical one grows from the bed to that of the surface. A
   table does not determine the vertical acceleration: it is 0, as in long waves. */
static void at(const void *state, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    const table *sea = state;
    double values[SB_TABLE_CHANNELS], rates[SB_TABLE_CHANNELS];
    sb_line_at(&sea->series, t, x, y, values, rates);
    out->surface = sea->datum + values[SB_TABLE_ETA];
    for (int axis = 0; axis < 2; axis++) {
        out->velocity[axis] = values[SB_TABLE_U + axis];
        out->acceleration[axis] = rates[SB_TABLE_U + axis];
    }
    out->velocity[2] = sb_sea_fraction(z, bed, out->surface) * rates[SB_TABLE_ETA];
}

const sb_sea_form sb_sea_form_table = {create, at, greatest_surface, greatest_speed, destroy, NULL, NULL};

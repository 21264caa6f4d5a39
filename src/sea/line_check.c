#include "sea/line_check.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

/* Times from which on, and up to which, a series must have rows; a rounding error is allowed. */
static sb_status check_times(const sb_line_point *point, const sb_scene *scene, const char *path, sb_error *error)
{
    const double begin = 0 - scene->given.start, end = scene->duration - scene->given.start;
    const double slack = 1e-9 * (fabs(begin) + fabs(end));
    const double first = point->times[0], last = point->times[point->count - 1];
    if (first > begin + slack)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: the series at (%g, %g) begins at %g s, expected %g s or earlier, where the run begins; "
                       "sea.start is the time of the run at which the series has 0 s",
                       path, point->x, point->y, first, begin);
    if (last < end - slack)
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.500s: the series at (%g, %g) ends at %g s, expected %g s or later, where the run of %g s ends", path,
            point->x, point->y, last, end, scene->duration);
    return SB_OK;
}

/* Largest distance of a point from the first one, m. */
static double extent_of(const sb_line *series)
{
    const sb_line_point *first = series->points;
    double extent = 0;
    for (size_t i = 1; i < series->count; i++)
        extent = fmax(extent, hypot(series->points[i].x - first->x, series->points[i].y - first->y));
    return extent;
}

/* Distance of a point from the sides of the domain, from within or from outside, m. */
static double from_sides(const sb_domain *domain, const sb_line_point *point)
{
    const double x = fmax(domain->min.x - point->x, point->x - domain->max.x);
    const double y = fmax(domain->min.y - point->y, point->y - domain->max.y);
    return x > 0 || y > 0 ? hypot(fmax(x, 0), fmax(y, 0)) : -fmax(x, y);
}

/* Whether the points are most likely longitudes and latitudes: the side of a domain is a small part of a degree, and
   none of them is at a side, where points in metres would be. A table with a unit of its own has none. */
static bool like_degrees(const sb_line *series, const sb_scene *scene)
{
    const sb_domain *domain = &scene->domain;
    const double side = fmax(domain->max.x - domain->min.x, domain->max.y - domain->min.y);
    if (scene->given.source != SB_GIVEN_TABLE || scene->given.unit != SB_UNIT_M) return false;
    if (scene->given.zero[0] != 0 || scene->given.zero[1] != 0 || extent_of(series) > 0.05 * side) return false;
    for (size_t i = 0; i < series->count; i++) {
        const sb_line_point *point = &series->points[i];
        if (point->x < -180 || point->x > 360 || fabs(point->y) > 90) return false;
        if (from_sides(domain, point) <= scene->resolution) return false;
    }
    return true;
}

/* What may be wrong with points that lie within a spacing. */
static const char *near_remedy(const sb_line *series, const sb_scene *scene)
{
    if (like_degrees(series, scene)) return "; these look like longitudes and latitudes";
    return scene->given.source == SB_GIVEN_TABLE ? "; the key sea.units is the unit of the table" : "";
}

static sb_status check_places(const sb_line *series, const sb_scene *scene, const char *path, sb_error *error)
{
    const sb_domain *domain = &scene->domain;
    const bool flat = scene->dimensions == 2;
    const bool table = scene->given.source == SB_GIVEN_TABLE;
    const double width = domain->max.x - domain->min.x, length = flat ? 0 : domain->max.y - domain->min.y;
    for (size_t i = 0; i < series->count; i++) {
        const sb_line_point *point = &series->points[i];
        const double dx = fmax(fmax(domain->min.x - point->x, point->x - domain->max.x), 0);
        const double dy = flat ? 0 : fmax(fmax(domain->min.y - point->y, point->y - domain->max.y), 0);
        if (hypot(dx, dy) <= fmax(width, length)) continue;
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.500s: the point (%g, %g) lies %g m from the domain, expected points along its side, in metres "
            "of the scene%s",
            path, point->x, point->y, hypot(dx, dy),
            like_degrees(series, scene) ? "; these look like longitudes and latitudes"
            : table                     ? "; sea.zero is the place of the table that is (0, 0) of the scene"
                                        : "");
    }
    return SB_OK;
}

/* Refuses points that are all at one place for the scene, such as degrees read as metres. */
static sb_status check_extent(const sb_line *series, const sb_scene *scene, const char *path, sb_error *error)
{
    if (scene->dimensions == 2) return SB_OK;
    const double extent = extent_of(series);
    if (!(extent < scene->resolution)) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s: its %zu points lie within %.3g m of (%g, %g), less than a spacing of %g m, expected points along "
        "a side, in metres of the scene%s",
        path, series->count, extent, series->points[0].x, series->points[0].y, scene->resolution,
        near_remedy(series, scene));
}

/* Refuses points that are not in their order along the side: a line around a corner turns by 90 degrees at most. */
static sb_status check_order(const sb_line *series, const sb_scene *scene, const char *path, sb_error *error)
{
    if (scene->dimensions == 2) return SB_OK;
    for (size_t i = 1; i + 1 < series->count; i++) {
        const sb_line_point *before = &series->points[i - 1], *here = &series->points[i], *after = here + 1;
        const double in[2] = {here->x - before->x, here->y - before->y};
        const double out[2] = {after->x - here->x, after->y - here->y};
        const double least = fmin(hypot(in[0], in[1]), hypot(out[0], out[1]));
        if (least < scene->resolution || in[0] * out[0] + in[1] * out[1] >= -0.01 * least * least) continue;
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.500s: the line of its points turns back at (%g, %g), expected points in their order along the "
            "side",
            path, here->x, here->y);
    }
    return SB_OK;
}

sb_status sb_line_check(const sb_line *series, const sb_scene *scene, const char *path, sb_error *error)
{
    if (series->count == 0) return sb_fail(error, SB_BAD_INPUT, "%.500s: has no rows, expected at least 2", path);
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < series->count; i++) {
        const sb_line_point *point = &series->points[i];
        if (point->count < 2)
            return sb_fail(error, SB_BAD_INPUT, "%.500s: the series at (%g, %g) has 1 row, expected at least 2", path,
                           point->x, point->y);
        status = check_times(point, scene, path, error);
    }
    if (status == SB_OK && series->count > 1) status = check_places(series, scene, path, error);
    if (status == SB_OK && series->count > 1) status = check_extent(series, scene, path, error);
    return status == SB_OK ? check_order(series, scene, path, error) : status;
}

/* The only side at which the line's water is given; -1: there are several, such as two with their corner. */
static int only_side(const sb_scene *scene)
{
    int found = -1;
    for (int side = 0; side < 4; side++) {
        if (!sb_scene_given_side(scene, side)) continue;
        if (found >= 0) return -1;
        found = side;
    }
    return found;
}

void sb_line_doubt(const sb_line *series, const sb_scene *scene, char *text, size_t size)
{
    const int side = only_side(scene), axis = side / 2;
    if (side < 0 || scene->dimensions == 2 || series->count < 2) return;
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < series->count; i++) {
        const double at[2] = {series->points[i].x, series->points[i].y};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    const double across = high[axis] - low[axis], along = high[1 - axis] - low[1 - axis];
    const double middle = 0.5 * (low[axis] + high[axis]);
    const double centre = 0.5 * (sb_component(scene->domain.min, axis) + sb_component(scene->domain.max, axis));
    if (across > along)
        snprintf(
            text, size,
            "sea.file: the line of its points runs across the side %s, from %c = %.4g to %.4g m, and each place of "
            "the side has the water of the nearest point; expected points along the side",
            sb_side_names[side], "xy"[axis], low[axis], high[axis]);
    else if (side % 2 ? middle < centre : middle > centre)
        snprintf(text, size,
                 "sea.file: the line of its points, at %c = %.4g m, is nearer to the side %s than to %s, where its "
                 "water is given; expected points along that side; check sea.zero and sea.sides",
                 "xy"[axis], middle, sb_side_names[side ^ 1], sb_side_names[side]);
}

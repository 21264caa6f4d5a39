/* Writes what the files of a terrain state, and what was made of them. */
#include "geometry/grid/tell.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>

typedef struct lines {
    char *text;
    size_t length, capacity;
} lines;

__attribute__((format(printf, 2, 3))) static void add(lines *to, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    if (to->length < to->capacity) {
        const int added = vsnprintf(to->text + to->length, to->capacity - to->length, format, values);
        to->length += added > 0 ? (size_t)added : 0;
    }
    va_end(values);
}

/* What the scene does to heights that are missing and stay so. */
static const char *fate(const sb_body *body)
{
    switch (body->voids) {
    case SB_VOIDS_SHOW:
        return "left to the grids before it";
    case SB_VOIDS_COVER:
        return "left to the grids after it";
    case SB_VOIDS_BARE:
        return "in which no cell's centre may lie";
    case SB_VOIDS_ZERO:
        return "without uplift";
    case SB_VOIDS_KEEP:
    case SB_VOIDS_FILL:
        break;
    }
    return "kept as holes; `voids: fill` fills them";
}

static void tell_extent(const sb_body *body, const double min[2], const double max[2], lines *to)
{
    add(to, "from (%.10g, %.10g) to (%.10g, %.10g) m", min[0] * body->scale, min[1] * body->scale, max[0] * body->scale,
        max[1] * body->scale);
}

/* The transform of the body, in its order. */
static void tell_transform(const sb_body *body, lines *to)
{
    const sb_vec3 *turn = &body->rotate, *way = &body->translate;
    if (turn->x != 0 || turn->y != 0 || turn->z != 0)
        add(to, "; rotated by (%g, %g, %g) degrees", turn->x, turn->y, turn->z);
    if (way->x != 0 || way->y != 0 || way->z != 0)
        add(to, "; moved by (%.10g, %.10g, %.10g) m", way->x, way->y, way->z);
}

static void tell_layer(const sb_body *body, const sb_layer *of, lines *to)
{
    const char *name = strrchr(of->path, '/');
    const sb_raster_about *about = &of->about;
    const bool degrees = of->system[0] && of->unit == SB_PROJECTION_DEGREES;
    const bool other = (of->system[0] && of->unit == SB_PROJECTION_OTHER) || body->scale != 1;
    add(to, "%.200s: ", name ? name + 1 : of->path);
    if (of->system[0])
        add(to, "%.100s%s", of->system, of->projection ? ", projected" : "");
    else if (body->scale == 1)
        add(to, "no coordinate system, taken as metres");
    else
        add(to, "no coordinate system, units of %g m", body->scale);
    add(to, "; %llu x %llu nodes, %.6g x %.6g %s", (unsigned long long)about->columns, (unsigned long long)about->rows,
        about->dx, about->dy,
        degrees ? "degrees"
        : other ? "units"
                : "m");
    if (of->projection) add(to, " (%.4g m)", of->cell * body->scale);
    add(to, "; ");
    tell_extent(body, of->area.min, of->area.max, to);
    if (of->down)
        add(to, "; depths, as its attribute positive states");
    else if (about->down)
        add(to, "; its attribute positive: down is not used, because the key positive is %s",
            body->positive == SB_POSITIVE_DOWN ? "down" : "up");
    add(to, "; vertical datum: ");
    if (about->vertical)
        add(to, "EPSG:%u", about->vertical);
    else
        add(to, "%s", about->note[0] ? about->note : "none stated");
    const double datum = body->positive == SB_POSITIVE_DOWN ? -of->datum : of->datum;
    if (datum != 0) add(to, "; %+g m added to its heights", datum);
    add(to, "\n");
}

static void tell_ground(const sb_body *body, const sb_terrain *ground, lines *to)
{
    const sb_grid *grid = &ground->grid;
    const size_t nodes = grid->columns * grid->rows;
    const double sign = body->positive == SB_POSITIVE_DOWN ? -1 : 1;
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t n = 0; n < nodes; ++n) {
        const double height = sign * grid->heights[n]; /* NAN is neither */
        least = height < least ? height : least;
        most = height > most ? height : most;
    }
    const double first[2] = {grid->x + body->origin[0], grid->y + body->origin[1]};
    const double last[2] = {first[0] + grid->dx * (double)(grid->columns - 1),
                            first[1] + grid->dy * (double)(grid->rows - 1)};
    add(to, "ground: %.100s%s; %zu x %zu nodes of %.6g x %.6g m; ",
        ground->projection[0] ? ground->projection
        : body->scale == 1    ? "metres as in the file"
                              : "as in the file",
        ground->zone ? ", the UTM zone of the finest file" : "", grid->columns, grid->rows, grid->dx * body->scale,
        grid->dy * body->scale);
    tell_extent(body, first, last, to);
    add(to, "; heights %.6g to %.6g m", least * body->scale + body->datum, most * body->scale + body->datum);
    if (body->datum != 0) add(to, ", of which datum %+g m", body->datum);
    if (ground->voids == 0)
        add(to, "; no voids");
    else
        add(to, "; %zu voids (%.3g %%), %s", ground->voids, 100 * (double)ground->voids / (double)nodes,
            ground->filled ? "interpolated from the heights around them" : fate(body));
    if (ground->outside) add(to, "; %zu nodes in no file", ground->outside);
    tell_transform(body, to);
}

sb_status sb_terrain_tell(const sb_body *body, const sb_terrain *ground, char **text, sb_error *error)
{
    lines to = {.capacity = 1000 * (ground->count + 1)};
    to.text = sb_alloc(to.capacity, 1);
    if (!to.text) return sb_fail_memory(error, "the description of a terrain");
    for (size_t i = 0; i < ground->count; ++i) tell_layer(body, &ground->layers[i], &to);
    tell_ground(body, ground, &to);
    *text = to.text;
    return SB_OK;
}

/* Inside of the filling: columns of water. Private to src/geometry/fill*.c. */
#ifndef SB_GEOMETRY_FILL_PARTS_H
#define SB_GEOMETRY_FILL_PARTS_H

#include "geometry/fill.h"

/* A stretch of one column that is free of solids. Its cells are the layers whose centres lie in it.
 */
typedef struct sb_run {
    double low, high;     /* m */
    size_t cell;          /* of its first layer, in sb_columns.cells */
    int32_t first, count; /* layers */
    bool surface;         /* high is the free surface */
    bool wet;
} sb_run;

/* Bits of a cell: a surface stands between its centre and that of the next column along x or y. */
enum { SB_CELL_BLOCK_X = 1, SB_CELL_BLOCK_Y = 2 };

/* A rectangle of columns, fitted to its extent: dx, dy are as near to the spacing as whole numbers
   of columns allow. Layers are counted upwards from `base` and end at the level. Owned arrays. */
typedef struct sb_columns {
    const sb_scene *scene;
    const sb_fill_solid *solids;
    size_t solid_count;
    double spacing, x, y, dx, dy; /* m; (x, y) is the lower corner */
    int64_t nx, ny;
    double bottom, base, level, top; /* m; top: nothing is wet above */
    int32_t layers;
    bool waves;       /* the scene's initial wave shapes this water */
    sb_vec3 velocity; /* m/s */
    size_t *begin;    /* nx * ny + 1: runs of a column, from below */
    size_t run_count, cell_count;
    sb_run *runs;
    uint8_t *cells;
} sb_columns;

/* Columns of the domain below the sea's level, or of a box below its own. */
sb_status sb_columns_build(const sb_scene *scene, const sb_fill_solid *solids, size_t solid_count,
                           const sb_fluid_box *box, sb_columns *columns, sb_error *error);
void sb_columns_free(sb_columns *columns);

/* Centre of a column, and of a layer in it. */
static inline sb_vec3 sb_columns_center(const sb_columns *c, int64_t i, int64_t j, int64_t layer)
{
    bool flat = c->scene->dimensions == 2;
    return sb_vec(c->x + ((double)i + 0.5) * c->dx, flat ? 0 : c->y + ((double)j + 0.5) * c->dy,
                  c->base + ((double)layer + 0.5) * c->spacing);
}

/* Level of the water's surface at x, initial wave included, in m. */
double sb_columns_surface(const sb_columns *columns, double x);

/* Whether this water reaches the point. */
bool sb_columns_hold(const sb_columns *columns, sb_vec3 at);

/* No surface between two points. */
bool sb_columns_clear(const sb_columns *columns, sb_vec3 from, sb_vec3 to);

/* Marks the runs that the sea's seed reaches. */
sb_status sb_columns_flood(sb_columns *columns, sb_error *error);

/* Adds what these waters have of the scene's initial solitary wave; once their runs are marked. */
void sb_columns_wave(const sb_columns *columns, sb_wave_room *room);

/* Particles of all wet runs, in the order of the columns; still_depth is theirs. */
sb_status sb_columns_particles(const sb_columns *columns, sb_fluid *fluid, sb_error *error);

#endif

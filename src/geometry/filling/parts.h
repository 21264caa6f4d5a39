/* Columns of water, from which fill.h places particles. Private to src/geometry/fill*.c. */
#ifndef SB_GEOMETRY_FILL_PARTS_H
#define SB_GEOMETRY_FILL_PARTS_H

#include "geometry/filling/fill.h"

/* Part of one column that is free of solids. Its cells are the layers whose centres lie in it. */
typedef struct sb_run {
    double low, high;     /* m */
    size_t cell;          /* index of its first layer in sb_columns.cells */
    int32_t first, count; /* layers */
    bool surface;         /* `high` is the free surface */
    bool wet;
} sb_run;

/* Bits of a cell: a surface stands between its centre and that of the next column along x or y. */
enum { SB_CELL_BLOCK_X = 1, SB_CELL_BLOCK_Y = 2 };

/* A rectangle of columns. dx and dy are as near to the spacing as whole numbers of columns allow. Layers are counted
   upwards from `base` and end at the water level. Arrays are owned. */
typedef struct sb_columns {
    const sb_scene *scene;
    const sb_fill_solid *solids;
    size_t solid_count;
    double spacing, x, y, dx, dy; /* m; (x, y) is the lower corner */
    int64_t nx, ny;
    double bottom, base, level, top; /* m; there is no water above top */
    int32_t layers;
    bool waves;       /* the scene's initial wave shapes this water */
    bool sea;         /* it is the sea, not a box */
    sb_vec3 velocity; /* m/s */
    size_t *begin;    /* nx * ny + 1: first run of each column; its runs are sorted from below */
    size_t run_count, cell_count;
    sb_run *runs;
    uint8_t *cells;
} sb_columns;

/* Builds the columns of the domain below the sea's level, or those of a box below its own level. */
sb_status sb_columns_build(const sb_scene *scene, const sb_fill_solid *solids, size_t solid_count,
                           const sb_fluid_box *box, sb_columns *columns, sb_error *error);
void sb_columns_free(sb_columns *columns);

/* Centre of a layer's cell in a column. */
static inline sb_vec3 sb_columns_center(const sb_columns *c, int64_t i, int64_t j, int64_t layer)
{
    bool flat = c->scene->dimensions == 2;
    return sb_vec(c->x + ((double)i + 0.5) * c->dx, flat ? 0 : c->y + ((double)j + 0.5) * c->dy,
                  c->base + ((double)layer + 0.5) * c->spacing);
}

/* Level of the water's surface at x, initial wave included, in m. */
double sb_columns_surface(const sb_columns *columns, double x);

/* Whether the point lies in a wet run of these columns. */
bool sb_columns_hold(const sb_columns *columns, sb_vec3 at);

/* Whether no surface lies between two points. */
bool sb_columns_clear(const sb_columns *columns, sb_vec3 from, sb_vec3 to);

/* Marks the runs that are connected with the sea's seed as wet. */
sb_status sb_columns_flood(sb_columns *columns, sb_error *error);

/* Whether some layer connects a run, whose cells hold the bit of this step (SB_CELL_BLOCK_X, ..), with one of the next
   column. */
bool sb_columns_joined(const sb_columns *columns, const sb_run *run, const sb_run *next, uint8_t bit);

/* The water of a wet run: its area over that of a column, and the distance (m) from the column's axis to its middle.
   part: 1 and shift: 0 away from walls, and in boxes, which do not come to rest before t = 0. Areas are those between
   the column's axis and the walls beside it: over a whole wall they add up to the water's. Call it after the runs are
   marked. */
typedef struct sb_run_extent {
    double part;
    sb_vec3 shift;
} sb_run_extent;
sb_run_extent sb_columns_extent(const sb_columns *columns, int64_t i, int64_t j, const sb_run *run);

/* Adds the part of the scene's initial solitary wave that these columns contain. Call it after their runs are
   marked. */
void sb_columns_wave(const sb_columns *columns, sb_wave_room *room);

/* Counts the particles of the wet runs, in the order of the columns. *first: of each column the index of its first one,
   then their number (owned). *still_depth grows to the largest still depth. */
sb_status sb_columns_count(const sb_columns *columns, size_t **first, double *still_depth, sb_error *error);

/* Places the particles [from, from + here) of those that were counted. */
sb_status sb_columns_place(const sb_columns *columns, const size_t *first, size_t from, size_t here, sb_fluid *fluid,
                           sb_error *error);

/* Places the particles of all wet runs, and sets still_depth. */
sb_status sb_columns_particles(const sb_columns *columns, sb_fluid *fluid, sb_error *error);

/* source.c: sb_fill_water of a scene whose water can be placed in parts. */
sb_status sb_fill_part(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fill_share *share,
                       sb_fluid *fluid, sb_error *error);

/* fill.c: displaces the particles at random, by at most numerics.jitter spacings along each axis. */
void sb_fluid_displace(const sb_scene *scene, sb_fluid *fluid);

/* fill.c: finds the columns of the sea (box NULL) or of a box, and marks their wet runs. On error *columns is
   unchanged. */
sb_status sb_columns_fill(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fluid_box *box,
                          sb_columns *columns, sb_wave_room *wave, sb_error *error);

#endif

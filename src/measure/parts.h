/* The individual measurements behind measure.h. Private to src/measure. */
#ifndef SB_MEASURE_PARTS_H
#define SB_MEASURE_PARTS_H

#include "frame/records.h"
#include "measure/cloud.h"
#include "measure/floors.h"

#include <math.h>

/* The simulation and the instant at which a measurement reads it; shared by all measurements. */
typedef struct sb_measure_view {
    const sb_scene *scene;
    const sb_sim *sim;
    sb_vec3 min, max; /* m, the model's domain */
    double lag;       /* s, simulation time minus the instant that is read */
    sb_cloud *cloud;  /* scratch */
} sb_measure_view;

/* Period of the domain [min, max] along x (axis 0) or y (1), m; 0: not periodic. */
static inline double sb_repeat_length(const sb_scene *scene, sb_vec3 min, sb_vec3 max, int axis)
{
    double length = axis == 0 ? max.x - min.x : max.y - min.y;
    return sb_scene_repeats(scene, axis) ? length : 0;
}

/* Distance below which particles are connected, in spacings: that across a missing layer of water at rest. Rows of
   water that a steep wave stretches are nearer to each other, drops are farther from the water that they leave. */
#define SB_LINK 2.0

/* The cubic B-spline of support 2: it sums to 1 over the integers at any shift. */
static inline double sb_bspline(double u)
{
    u = fabs(u);
    if (u < 1) return 2.0 / 3 - u * u * (1 - u / 2);
    return u < 2 ? (2 - u) * (2 - u) * (2 - u) / 6 : 0;
}

/* Absolute elevation z of the free surface at (x, y) in m, NaN when dry. floors are those of (x, y). See gauge.c for
   the method. *water: depth of all water there in m, also where it is too thin to have a surface. */
sb_status sb_gauge_read(const sb_measure_view *view, double x, double y, const sb_floors *floors, double *z,
                        double *water, sb_error *error);

/* The same in the depth-averaged water beside the particles, at a time of the run, s. */
double sb_grid_gauge_read(const sb_sim *sim, const sb_scene *scene, const sb_gauge *gauge, double time);

/* The part of a wall around a probe: see patch.h. */
typedef struct sb_patch sb_patch;

/* Velocity (m/s) and pressure (Pa) at a point, NaN when dry. probe->radius in m; 0: the support radius. *pressure: on
   entry the mean pressure on a wall, which stays if it is not 0 or water is there; NaN: from the water around. */
sb_status sb_probe_read(const sb_measure_view *view, const sb_probe *probe, const sb_patch *patch, sb_vec3 *velocity,
                        double *pressure, sb_error *error);

/* The places on the surfaces of bodies that do not move at which there are boundary particles, near a run-up line and
   in the order along it. Zero-initialised: there are none, and water wets nothing. */
typedef struct sb_shore_point {
    double along; /* m, from the first end */
    sb_vec3 at;
} sb_shore_point;
typedef struct sb_shore {
    size_t count, capacity;
    sb_shore_point *points;
} sb_shore;
sb_status sb_shore_find(const sb_scene *scene, const sb_model *model, const sb_runup_line *line, sb_shore *shore,
                        sb_error *error);
void sb_shore_free(sb_shore *shore);
/* The place near which all ranks must have the boundary particles. */
sb_model_place sb_shore_place(const sb_scene *scene, const sb_runup_line *line);

/* Sets the `place`, `front` and `apart` of the record. shore: NULL: it is not known, and all connected water counts. */
sb_status sb_runup_read(const sb_measure_view *view, const sb_runup_line *line, const sb_shore *shore,
                        sb_runup_record *record, sb_error *error);

/* Counts the particles that pass a flow plane, from the side on which each was at the last step. */
typedef struct sb_plane_counter sb_plane_counter;
sb_status sb_plane_counter_create(const sb_measure_view *view, const sb_flow_plane *plane, sb_plane_counter **counter,
                                  sb_error *error);
void sb_plane_counter_destroy(sb_plane_counter *counter);
/* Adds the net volume that passed in the last step (m^3; m^2 in 2D) to *volume. */
sb_status sb_plane_counter_step(sb_plane_counter *counter, const sb_measure_view *view, double *volume,
                                sb_error *error);
size_t sb_plane_counter_bytes(const sb_plane_counter *counter);
/* Saves the particles near the plane in a section of an archive, and loads them into a counter of the same plane. */
void sb_plane_counter_save(const sb_plane_counter *counter, sb_archive_out *out);
sb_status sb_plane_counter_load(sb_plane_counter *counter, sb_archive_in *in, sb_error *error);

/* Greatest depth, speed, flux and first arrival of standing water on a grid, and the ground there. */
typedef struct sb_map_field sb_map_field;
sb_status sb_map_create(const sb_measure_view *view, const sb_model *model, sb_map_field **map, sb_error *error);
void sb_map_destroy(sb_map_field *map);
/* Reads all fluid particles if the time in which a wave crosses half a cell has passed since the last reading. */
void sb_map_step(sb_map_field *map, const sb_sim *sim);
const sb_map_record *sb_map_result(const sb_map_field *map);
size_t sb_map_bytes(const sb_map_field *map);
/* Saves the values so far within a section of an archive, and loads them into a map of the same grid. */
void sb_map_save(const sb_map_field *map, sb_archive_out *out);
void sb_map_load(sb_map_field *map, sb_archive_in *in);

/* Plan rectangle of the boundary particles of a body, of a paddle those of all its plates, at t = 0 (m). */
typedef struct sb_footprint {
    sb_vec3 min, max;
} sb_footprint;
sb_footprint sb_footprint_of(const sb_model *model, size_t body);
/* Sums over columns of water before a body's faces: weights, and weights times depths in spacings. */
typedef struct sb_approach {
    double weight, layers;
} sb_approach;
/* Adds the columns before the rectangle's sides at this instant. displacement: of the body since t = 0 (m). */
sb_status sb_face_approach(const sb_measure_view *view, const sb_footprint *footprint, sb_vec3 displacement,
                           sb_approach *sum, sb_error *error);

#endif

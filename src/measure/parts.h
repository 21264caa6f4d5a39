/* The single measurements behind measure.h. Inside src/measure. */
#ifndef SB_MEASURE_PARTS_H
#define SB_MEASURE_PARTS_H

#include "measure/cloud.h"
#include "measure/floors.h"
#include "measure/records.h"

/* Where and when to look: shared by all of them. */
typedef struct sb_sight {
    const sb_scene *scene;
    const sb_sim *sim;
    sb_vec3 min, max; /* m, the model's domain */
    double lag;       /* s that the wanted instant lies before the sim's time */
    sb_cloud *cloud;  /* scratch */
} sb_sight;

/* Length after which the domain [min, max] repeats along x (axis 0) or y (1), m; 0: it does not. */
static inline double sb_repeat_length(const sb_scene *scene, sb_vec3 min, sb_vec3 max, int axis)
{
    double length = axis == 0 ? max.x - min.x : max.y - min.y;
    return sb_scene_repeats(scene, axis) ? length : 0;
}

/* Distance below which particles belong together, in spacings: the diagonal of a lattice face is
   1.41, the next shell at 1.73 would bridge a missing layer. */
#define SB_LINK 1.5

/* Absolute elevation z of the free surface at (x, y) in m, NaN when dry; floors: of that place. See gauge.c for the
   choice. *water: m, the depth of all the water that is seen there, also where it is too thin to have a surface. */
sb_status sb_gauge_read(const sb_sight *sight, double x, double y, const sb_floors *floors, double *z, double *water,
                        sb_error *error);

/* The wall around a probe: see patch.h. */
typedef struct sb_patch sb_patch;

/* Velocity (m/s) and pressure (Pa) at a point, NaN when dry. probe->radius in m, 0: the support
   radius. On a wall the pressure is the force on the patch over its area. */
sb_status sb_probe_read(const sb_sight *sight, const sb_probe *probe, const sb_patch *patch, sb_vec3 *velocity,
                        double *pressure, sb_error *error);

/* The `place`, `front` and `apart` of the record. */
sb_status sb_runup_read(const sb_sight *sight, const sb_runup_line *line, sb_runup_record *record, sb_error *error);

/* A plane that counts particles by the side they were last seen on. */
typedef struct sb_gate sb_gate;
sb_status sb_gate_create(const sb_sight *sight, const sb_flow_plane *plane, sb_gate **gate, sb_error *error);
void sb_gate_destroy(sb_gate *gate);
/* Adds the net volume that passed in the last step (m^3; m^2 in 2D) to *volume. */
sb_status sb_gate_step(sb_gate *gate, const sb_sight *sight, double *volume, sb_error *error);
size_t sb_gate_bytes(const sb_gate *gate);
/* The particles seen last, within a section of an archive, and back into a gate on the same plane. */
void sb_gate_save(const sb_gate *gate, sb_archive_out *out);
sb_status sb_gate_load(sb_gate *gate, sb_archive_in *in, sb_error *error);

/* Greatest depth, speed, flux and first arrival on a grid. */
typedef struct sb_map_field sb_map_field;
sb_status sb_map_create(const sb_sight *sight, sb_map_field **map, sb_error *error);
void sb_map_destroy(sb_map_field *map);
/* Reads all fluid when half a cell's wave travel time has passed since the last reading. */
void sb_map_step(sb_map_field *map, const sb_sim *sim);
const sb_map_record *sb_map_result(const sb_map_field *map);
size_t sb_map_bytes(const sb_map_field *map);
/* What was seen so far, within a section of an archive, and back into a map of the same grid. */
void sb_map_save(const sb_map_field *map, sb_archive_out *out);
void sb_map_load(sb_map_field *map, sb_archive_in *in);

/* Plan rectangle of a body's wall particles at t = 0 (m). */
typedef struct sb_footprint {
    sb_vec3 min, max;
} sb_footprint;
sb_footprint sb_footprint_of(const sb_model *model, size_t body);
/* Deepest water along the rectangle's sides, in spacings; displacement moves the body (m). */
sb_status sb_face_layers(const sb_sight *sight, const sb_footprint *footprint, sb_vec3 displacement, double *layers,
                         sb_error *error);

#endif

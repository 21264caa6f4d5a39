/* Map projections, by the PROJ library. Private to src/geometry/grid. */
#ifndef SB_GEOMETRY_PROJECTION_H
#define SB_GEOMETRY_PROJECTION_H

#include "base/status.h"

/* What a coordinate system measures x and y in. */
typedef enum sb_projection_unit {
    SB_PROJECTION_METRES,
    SB_PROJECTION_DEGREES, /* longitude and latitude */
    SB_PROJECTION_OTHER    /* another length */
} sb_projection_unit;

typedef struct sb_projection sb_projection;

/* Finds the unit of a coordinate system: "EPSG:32654", WKT or a PROJ string. SB_BAD_INPUT names it and the reason. The
   library is loaded by the first call. */
sb_status sb_projection_unit_of(const char *system, sb_projection_unit *unit, sb_error *error);

/* Writes the UTM zone of a place on WGS 84, as "EPSG:32654". */
void sb_projection_zone(double longitude, double latitude, char text[24]);

/* The transformation between two systems. x is easting or longitude in both. The caller destroys it. */
sb_status sb_projection_create(const char *from, const char *to, sb_projection **projection, sb_error *error);
void sb_projection_destroy(sb_projection *projection);

/* Transform place[0], place[1] from the first system to the second, and back. Not finite: there is no such place. */
void sb_projection_forward(const sb_projection *projection, double place[2]);
void sb_projection_backward(const sb_projection *projection, double place[2]);

#endif

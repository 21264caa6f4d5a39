/* A closed mesh of triangles: the surface of the water of a frame. */
#ifndef SB_SURFACE_WATER_MESH_H
#define SB_SURFACE_WATER_MESH_H

#include "base/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Each edge belongs to two triangles, which run along it in opposite directions. A zero-initialised mesh is empty. */
typedef struct sb_water_mesh {
    sb_vec3 origin; /* m, added to every position */
    size_t vertices, triangles;
    float (*position)[3];  /* m */
    float (*normal)[3];    /* unit, out of the water */
    float (*velocity)[3];  /* m/s, of the water at the vertex */
    float *pressure;       /* Pa, of the water at the vertex */
    uint32_t (*corner)[3]; /* of each triangle, counter-clockwise from outside */
} sb_water_mesh;

void sb_water_mesh_free(sb_water_mesh *mesh);

/* m^3 within the mesh; the water of a frame is count x spacing^3. */
double sb_water_mesh_volume(const sb_water_mesh *mesh);

#endif

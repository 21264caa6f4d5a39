/* The triangles of a cube of the grid for each of the 256 ways in which its corners lie in the water or outside, as in
   marching cubes (Lorensen and Cline 1987). The table is computed, not listed. */
#ifndef SB_SURFACE_CUBES_H
#define SB_SURFACE_CUBES_H

#include <stdint.h>

/* Corner c of a cube is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e is along axis e / 4. */
enum { SB_CUBE_EDGES = 12, SB_CUBE_TRIANGLES = 10 };

typedef struct sb_cube_case {
    uint8_t count; /* of triangles */
    uint8_t corners[SB_CUBE_TRIANGLES]
                   [3]; /* edges on which the triangle's corners lie, counter-clockwise from outside */
} sb_cube_case;

/* Fills the cases; bit c of the index is set if corner c is in the water. On a face with two opposite corners in the
   water these are connected, so that thin sheets have no holes. Cubes that share a face agree on its lines, and no
   triangle has an edge within a face besides these lines, so that each edge of a mesh belongs to two triangles. */
void sb_cube_cases(sb_cube_case cases[256]);

/* The corner at the lower end of an edge. */
int sb_cube_edge_corner(int edge);

#endif

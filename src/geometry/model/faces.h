/* The faces of bodies, on which loads are measured and shown, and the triangles near a place. */
#ifndef SB_GEOMETRY_FACES_H
#define SB_GEOMETRY_FACES_H

#include "geometry/model/model.h"

/* A face is all that a body has in one plane, on the same side of it. */
typedef struct sb_face {
    sb_vec3 normal; /* unit, towards the water */
    double area;    /* m^2, with the dry part */
    size_t body;    /* index in the model */
} sb_face;

typedef struct sb_face_triangle {
    sb_vec3 corner[3], normal; /* m, scene; unit */
    uint32_t face;
} sb_face_triangle;

typedef struct sb_faces {
    size_t count;
    sb_face *list;               /* those of one body follow each other */
    size_t triangle_count;       /* of these faces */
    sb_face_triangle *triangles; /* those of one face follow each other */
    size_t body_count, *first;   /* per body: its first triangle of these; first[body_count]: triangle_count */
    size_t capacity;             /* triangles of the bodies with faces */
    size_t all_count;            /* triangles of all bodies */
    uint32_t *of;                /* per triangle of all bodies: its face; UINT32_MAX: of a body without faces */
    struct sb_face_grid *grid;
} sb_faces;

/* Finds the faces of all bodies but terrain and those that move. spacing: m, of the particles; reach: m, see
   sb_faces_near. Two models with the same bodies have the same faces in the same order. The model is not used
   afterwards. A zeroed structure is empty; free it with sb_faces_free. On error *faces is unchanged. */
sb_status sb_faces_make(const sb_model *model, double spacing, double reach, sb_faces *faces, sb_error *error);
void sb_faces_free(sb_faces *faces);
size_t sb_faces_bytes(const sb_faces *faces);

/* Returns the number of triangles that may be at most `reach` away from a place, and their indices, ascending. */
size_t sb_faces_near(const sb_faces *faces, sb_vec3 at, const uint32_t **triangles);

/* Returns the face of a body on which a force at a place acts: that of the triangle with the least distance + spacing
   (1 - n . along), n its normal, which is `along` (unit) as far as the water presses straight on it. On a tie the first
   triangle counts. UINT32_MAX: the body has no faces. */
uint32_t sb_faces_nearest(const sb_faces *faces, size_t body, sb_vec3 at, sb_vec3 along);

#endif

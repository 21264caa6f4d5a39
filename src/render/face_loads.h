/* The mean pressure of the water on the faces of bodies, and the colours that show it. */
#ifndef SB_RENDER_FACE_LOADS_H
#define SB_RENDER_FACE_LOADS_H

#include "frame/frame.h"
#include "geometry/model/model.h"

/* A face is all that a body has in one plane, on the same side of it. */
typedef struct sb_load_face {
    sb_vec3 normal; /* unit, towards the water */
    double area;    /* m^2, with the dry part */
    double force;   /* N, of the water on it in the frame computed last */
    size_t body;    /* index in the model */
} sb_load_face;

typedef struct sb_face_loads {
    size_t face_count;
    sb_load_face *faces;
    size_t triangle_count;                   /* of all bodies */
    uint32_t *face;                          /* per triangle; UINT32_MAX: of a body without a load */
    unsigned char (*paint)[4], (*colors)[4]; /* per corner: without a load, and of the frame computed last */
    struct sb_load_grid *grid;
} sb_face_loads;

/* Finds the faces of all bodies but terrain and those that move. spacing: m, of the particles. The model is not used
   afterwards. A zeroed struct is empty. */
sb_status sb_face_loads_create(const sb_model *model, double spacing, sb_face_loads *loads, sb_error *error);
void sb_face_loads_free(sb_face_loads *loads);

/* Computes the force on each face: the mean of the pressure over a layer of one spacing before it, which has as many
   particles as the face has squares of the spacing. Then colours the corners; `most` (Pa) is the mean pressure at the
   upper end of SB_COLORMAP_FIRE. */
void sb_face_loads_compute(sb_face_loads *loads, const sb_frame *frame, double most);

#endif

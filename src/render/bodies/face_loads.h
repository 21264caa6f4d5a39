/* The mean pressure of the water on the faces of bodies, and the colours that show it. */
#ifndef SB_RENDER_FACE_LOADS_H
#define SB_RENDER_FACE_LOADS_H

#include "frame/frame.h"
#include "geometry/model/faces.h"

typedef struct sb_face_loads {
    sb_faces faces;
    double *force;                           /* N, per face: of the water on it in the frame computed last */
    unsigned char (*paint)[4], (*colors)[4]; /* per corner: without a load, and of the frame computed last */
} sb_face_loads;

/* Finds the faces of all bodies but terrain and those that move. spacing: m, of the particles. The model is not used
   afterwards. A zeroed struct is empty. */
sb_status sb_face_loads_create(const sb_model *model, double spacing, sb_face_loads *loads, sb_error *error);
void sb_face_loads_free(sb_face_loads *loads);

/* Takes the force on each face from the frame, whose means are those of the interval that finished last. If it has
   none, computes them at its instant: the mean of the pressure over a layer of one spacing before a face, which has as
   many particles as the face has squares of the spacing. Then colours the corners; `most` (Pa) is the mean pressure at
   the upper end of SB_COLORMAP_FIRE. */
void sb_face_loads_compute(sb_face_loads *loads, const sb_frame *frame, double most);

#endif

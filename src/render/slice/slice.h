/* Draws the slice of a camera over a picture: the cut water in the colours of a field, the cut bodies, velocities and
   streamlines. Nothing lies before the plane, so that all of it is visible. */
#ifndef SB_RENDER_SLICE_H
#define SB_RENDER_SLICE_H

#include "render/image/image.h"
#include "render/slice/section.h"
#include "render/slice/streamlines.h"
#include "render/water/fields.h"

/* What the slices of all cameras share; of the picture drawn last. A zeroed struct is empty. */
typedef struct sb_slicer {
    sb_solids solids;
    sb_section section;
    sb_plane_field field;
    sb_streamlines streamlines;
    sb_values values;
    sb_density density; /* of pictures that show the plane only */
    size_t cell_capacity[2];
    float *terrain, *bodies; /* per pixel: the share that is solid */
} sb_slicer;

/* A picture, and what is drawn. */
typedef struct sb_slice_job {
    const sb_slice *slice;
    const sb_frame *frame;
    const sb_view *view;
    const sb_density *density; /* of the frame; NULL: it is computed */
    const sb_ground *ground;   /* as in sb_density_build */
    sb_vec3 min, max;          /* m, scene: the box outside of which nothing is drawn */
    double range[2];           /* of the field */
    double vector_speed;       /* m/s */
    int threads;
} sb_slice_job;

/* Takes copies of the bodies. */
sb_status sb_slicer_create(const sb_model *model, sb_slicer *slicer, sb_error *error);
void sb_slicer_free(sb_slicer *slicer);

/* Sets the view to cut off what lies between its eye and the plane. */
void sb_slice_cut(const sb_slice *slice, sb_view *view);

/* Draws the slice. With slice->behind false, all pixels are drawn, else only those of the plane. */
sb_status sb_slicer_draw(sb_slicer *slicer, const sb_slice_job *job, sb_image *image, sb_error *error);

/* Draws an arrow above `slots` legends whose length is that of a round speed's arrow at `target` (m, scene). */
sb_status sb_slice_legend(sb_image *image, const sb_slice_job *job, sb_vec3 target, int slots, sb_error *error);

/* Draws the parts of the picture on the plane, which the slicer has computed. Private to slice.c and slice_paint.c. */
void sb_slice_paint(const sb_slicer *slicer, const sb_slice_job *job, const sb_plane *plane, const sb_plane_area *area,
                    sb_image *image);

#endif

/* One picture of a camera, and the texts and marks over it. */
#ifndef SB_RENDER_CAPTIONS_H
#define SB_RENDER_CAPTIONS_H

#include "render/slice/slice.h"

/* One picture, while it is drawn. */
typedef struct sb_shot {
    const sb_frame *frame;
    const sb_camera *camera;
    sb_camera_key key; /* at the frame's time */
    sb_view view;
    sb_vec3 min, max; /* m, scene: what is drawn */
    double range[2];  /* of the water's colours */
    double load_max;  /* Pa, of the bodies' colours; 0: they show no loads */
    double paint_max; /* m, of the greatest depth painted on them and on the ground; 0: none is */
} sb_shot;

/* Draws title, time, legends, scale bar and arrow to the north, as the scene says. job: of the camera's slice, NULL
   without one. */
sb_status sb_captions_draw(const sb_scene *scene, const sb_shot *shot, const sb_slice_job *job, sb_image *image,
                           sb_error *error);

#endif

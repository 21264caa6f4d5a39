/* Draws pictures of frames without a screen: water coloured by its speed, bodies, sky and legend. */
#ifndef SB_RENDER_RENDERER_H
#define SB_RENDER_RENDERER_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "render/image/image.h"
#include "render/water/reached.h"

typedef struct sb_renderer sb_renderer;

/* Creates a renderer for pictures of the size scene->render.width x height from scene->render.cameras. The scene must
   stay valid while the renderer is used. Of the model only bodies, min, max and still_depth are read, and only by this
   function. Starts OSMesa's drawing threads (LP_NUM_THREADS, two unless set), which inherit the caller's processor
   mask. */
sb_status sb_renderer_create(const sb_scene *scene, const sb_model *model, sb_renderer **renderer, sb_error *error);

/* From now on the renderer adds the water of its frames to this map, and shows it as the highest water so far
   (wet_ground, greatest_depth), instead of one of its own. The map is of the same scene and model, and must outlive the
   renderer; renderers that share one draw one at a time. */
void sb_renderer_share(sb_renderer *renderer, sb_reached *reached);

/* Draws a frame from scene->render.cameras[camera] at the frame's time, and resizes image as needed. May be called from
   any thread, one at a time. */
sb_status sb_renderer_draw(sb_renderer *renderer, const sb_frame *frame, size_t camera, sb_image *image,
                           sb_error *error);

/* NULL has no effect. */
void sb_renderer_destroy(sb_renderer *renderer);

#endif

/* Pictures of frames: water by its speed, bodies, sky and legend, drawn without a screen. */
#ifndef SB_RENDER_RENDERER_H
#define SB_RENDER_RENDERER_H

#include "frame/frame.h"
#include "geometry/model.h"
#include "render/image.h"

typedef struct sb_renderer sb_renderer;

/* For pictures of scene->render's size from scene->render.cameras. The scene must outlive the
   renderer; of the model only bodies, min, max and still_depth are read, and only here. Starts its
   drawing threads (LP_NUM_THREADS, two unless set): they inherit the caller's processor mask. */
sb_status sb_renderer_create(const sb_scene *scene, const sb_model *model, sb_renderer **renderer, sb_error *error);

/* Draws a frame as scene->render.cameras[camera] sees it at the frame's time. Makes image the right
   size. From any thread, one at a time. */
sb_status sb_renderer_draw(sb_renderer *renderer, const sb_frame *frame, size_t camera, sb_image *image,
                           sb_error *error);

/* NULL is fine. */
void sb_renderer_destroy(sb_renderer *renderer);

#endif

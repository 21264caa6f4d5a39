/* Draws the pictures of a recorded stream. */
#ifndef SB_APP_RENDER_LOG_H
#define SB_APP_RENDER_LOG_H

#include "app/frames/consumers.h"

/* Reads the scene of the first run in the log. The caller frees scene and model. SB_BAD_INPUT if the log has no
   complete scene. */
sb_status sb_render_log_scene(const char *path, sb_scene *scene, sb_model *model, sb_error *error);

/* Draws each complete frame of the log. Prints a line for each unless quiet. SB_BAD_INPUT if there is none. */
sb_status sb_render_log_draw(const char *path, sb_pictures *pictures, bool quiet, sb_error *error);

#endif

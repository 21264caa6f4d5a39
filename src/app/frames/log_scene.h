/* Turns what a subscriber knows of a run into the scene, model and frames that a renderer takes. */
#ifndef SB_APP_LOG_SCENE_H
#define SB_APP_LOG_SCENE_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "stream/live.h"

/* Makes the scene and model: what pictures need, and nothing else. A scene without cameras gets one named "view". The
   names of cameras become names of folders, so that other characters than those of names are replaced by "_". The
   caller frees both. SB_BAD_INPUT if two cameras have the same name. */
sb_status sb_log_scene(const sb_live_scene *live, sb_scene *scene, sb_model *model, sb_error *error);

/* Makes a frame of the scene's run. Velocities point along x; their length is the speed. NULL without memory. */
sb_frame *sb_log_frame(const sb_live_scene *scene, const sb_live_frame *live);

#endif

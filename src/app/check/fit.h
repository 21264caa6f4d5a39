/* Requirements of `run` and `check` on a scene, in addition to the ranges of its keys, which all commands require. */
#ifndef SB_APP_FIT_H
#define SB_APP_FIT_H

#include "base/status.h"
#include "scene/scene.h"

/* SB_BAD_INPUT when water would pass through the walls of the scene. */
sb_status sb_fit_check(const sb_scene *scene, sb_error *error);

#endif

/* What a run asks of a scene beyond the reader's ranges, which other commands share. */
#ifndef SB_APP_FIT_H
#define SB_APP_FIT_H

#include "base/status.h"
#include "scene/scene.h"

/* SB_BAD_INPUT when the walls of such a scene would not hold its water. */
sb_status sb_fit_check(const sb_scene *scene, sb_error *error);

#endif

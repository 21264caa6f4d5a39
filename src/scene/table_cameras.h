/* The table of one camera. Private to src/scene. */
#ifndef SB_SCENE_TABLE_CAMERAS_H
#define SB_SCENE_TABLE_CAMERAS_H

#include "scene/reader.h"

extern const sb_table sb_camera_table;

#endif

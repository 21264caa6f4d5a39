/* The presets of the numerics: YAML text by key. */
#ifndef SB_SCENE_PRESETS_H
#define SB_SCENE_PRESETS_H

#include "scene/scene.h"

/* A preset's YAML text for a key of `numerics`; NULL if there is no such row. */
const char *sb_preset_value(sb_preset preset, const char *key);

#endif

/* The presets of the numerics, as text by key. */
#ifndef SB_SCENE_PRESETS_H
#define SB_SCENE_PRESETS_H

#include "scene/scene.h"

/* The YAML text that a preset gives to a key of `numerics`, or NULL when it has no such row. */
const char *sb_preset_value(sb_preset preset, const char *key);

#endif

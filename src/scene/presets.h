/* The presets of the numerics: YAML text by key. */
#ifndef SB_SCENE_PRESETS_H
#define SB_SCENE_PRESETS_H

#include "scene/scene.h"

/* In the order of sb_preset; the last entry is NULL. */
extern const char *const sb_preset_names[];

/* A preset's YAML text for a key of `numerics` in a scene of that many dimensions; NULL if there is no such row. */
const char *sb_preset_value(sb_preset preset, int dimensions, const char *key);

#endif

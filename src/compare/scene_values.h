/* The keys and values of a run's scene.yaml, as text: by them runs are grouped and their differences are listed. */
#ifndef SB_COMPARE_SCENE_VALUES_H
#define SB_COMPARE_SCENE_VALUES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct sb_scene_value {
    char *key;   /* bodies.sea-wall.max: an entry of a list has its name, or its number from 1 */
    char *value; /* with its unit */
} sb_scene_value;

typedef struct sb_scene_values {
    size_t count, capacity;
    sb_scene_value *values; /* in the order of the file */
} sb_scene_values;

/* Reads the text of a scene that shorebreak has written: one key or entry per line. Lines of any other form are left
   out. SB_FAILED when memory runs out. */
sb_status sb_scene_values_read(const char *text, sb_scene_values *values, sb_error *error);
void sb_scene_values_free(sb_scene_values *values);

/* The value of a key; NULL: there is none. */
const char *sb_scene_values_find(const sb_scene_values *values, const char *key);

/* Whether a key changes the results of a run; false: only its name, pictures, stream or files. */
bool sb_scene_values_matter(const char *key);

#endif

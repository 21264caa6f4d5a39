/* Small scenes written to a temporary file, and read from it. */
#ifndef SB_TESTS_SCENE_FILES_H
#define SB_TESTS_SCENE_FILES_H

#include "../check.h"
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>

#define SCENE_HEAD                                                                                                     \
    "resolution: 0.1\nduration: 1\ndomain: {min: [0, 0, 0], max: [2, 1, 1]}\n"                                         \
    "water: {level: 0.5, seed: [1, 0.5, 0.2]}\n"
#define SCENE_SEA                                                                                                      \
    "resolution: 0.1\nduration: 1\ndomain: {min: [0, 0, 0], max: [2, 1, 1], sides: {x_min: sea}}\n"                    \
    "water: {level: 0.5, seed: [1, 0.5, 0.2]}\n"
#define SCENE_FLAT                                                                                                     \
    "dimensions: 2\nresolution: 0.1\nduration: 1\ndomain: {min: [0, 0], max: [2, 1]}\n"                                \
    "water: {level: 0.5, seed: [1, 0.2]}\n"

/* Writes text to a new file and stores its name in path. */
static inline void scene_file(const char *text, char path[256])
{
    snprintf(path, 256, "%s/scene-XXXXXX", SB_BINARY_DIR);
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static inline sb_status scene_read_text(const char *text, const char *preset, const sb_override *overrides,
                                        size_t count, sb_scene *scene, sb_error *error)
{
    char path[256];
    scene_file(text, path);
    sb_status status = sb_scene_read(path, preset, overrides, count, scene, error);
    remove(path);
    return status;
}

/* Fails the test with the message if the text is refused. */
static inline void scene_must_read(const char *text, const char *preset, const sb_override *overrides, size_t count,
                                   sb_scene *scene)
{
    sb_error error = {0};
    if (scene_read_text(text, preset, overrides, count, scene, &error) != SB_OK) fail_msg("%s", error.text);
}

#endif

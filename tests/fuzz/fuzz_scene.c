/* Fuzzes the text of a scene. A scene that is read must not change when it is written and read again. */
#include "fuzz.h"

#include "base/file.h"
#include "base/memory.h"
#include "scene/scene.h"

#include <string.h>

enum { WRITTEN_MAX = 64 << 20 };

/* Writes the scene to a file and returns its text. */
static char *write_out(const sb_scene *scene, const char *name)
{
    char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s", fuzz_save(name, NULL, 0));
    sb_error error = {0};
    char *text = NULL;
    size_t length;
    FUZZ_CHECK(sb_scene_write(scene, path, &error) == SB_OK);
    FUZZ_CHECK(sb_file_read(path, WRITTEN_MAX, &text, &length, &error) == SB_OK);
    return text;
}

/* Skips the comment lines at the beginning, which name the file that the scene was read from. */
static const char *body_of(const char *text)
{
    while (*text == '#') {
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
    return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sb_scene scene = {0}, again = {0};
    sb_error error = {0};
    sb_status status = sb_scene_read(fuzz_save("scene.yaml", data, size), NULL, NULL, 0, &scene, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return 0;
    }
    char *first = write_out(&scene, "written.yaml");
    status =
        sb_scene_read(fuzz_save("again.yaml", (const uint8_t *)first, strlen(first)), NULL, NULL, 0, &again, &error);
    if (status != SB_OK) fprintf(stderr, "%s\n%s", error.text, first);
    FUZZ_CHECK(status == SB_OK);
    char *second = write_out(&again, "written.yaml");
    FUZZ_CHECK(strcmp(body_of(first), body_of(second)) == 0);
    sb_free(first);
    sb_free(second);
    sb_scene_free(&scene);
    sb_scene_free(&again);
    return 0;
}

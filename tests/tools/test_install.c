/* Tests of `cmake --install` into an empty folder: programs run, scenes find their meshes. */
#include "base/file.h"
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char prefix[] = "/tmp/sb-install-XXXXXX";

static int run(const char *format, const char *argument)
{
    char command[SB_PATH_MAX];
    snprintf(command, sizeof command, format, argument, prefix);
    return system(command);
}

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(prefix) ? run("cmake --install '%s' --prefix '%s' >/dev/null", SB_BINARY_DIR) : -1;
}

static int tear_down(void **state)
{
    (void)state;
    return run("rm -rf -- %s'%s'", "");
}

static const char *installed(const char *name)
{
    static char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", prefix, name);
    return path;
}

static void test_programs_are_installed_and_run(void **state)
{
    (void)state;
    assert_int_equal(run("'%2$s/bin/%1$s' --version >/dev/null", "shorebreak-make-plant"), 0);
    assert_int_equal(run("'%2$s/bin/%1$s' --help >/dev/null", "shorebreak-monitor"), 0);
    if (access(SB_BINARY_DIR "/shorebreak", X_OK) == 0)
        assert_int_equal(run("'%2$s/bin/%1$s' --version >/dev/null", "shorebreak"), 0);
}

static void test_scenes_find_their_meshes(void **state)
{
    (void)state;
    sb_scene scene = {0};
    sb_error error = {0};
    const char *path = installed("share/shorebreak/scenes/plant.yaml");
    if (sb_scene_read(path, NULL, NULL, 0, &scene, &error) != SB_OK) fail_msg("%s", error.text);
    size_t with_file = 0;
    for (size_t i = 0; i < scene.body_count; i++) {
        if (!scene.bodies[i].file) continue;
        with_file++;
        assert_memory_equal(scene.bodies[i].file, prefix, strlen(prefix));
    }
    assert_true(with_file >= 2);
    sb_scene_free(&scene);
}

static void test_licence_and_message_types_are_installed(void **state)
{
    (void)state;
    static const char *const files[] = {"share/doc/shorebreak/LICENSE", "share/shorebreak/meshes/README.md",
                                        "share/shorebreak/lcmtypes/status_t.lcm"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (access(installed(files[i]), R_OK) != 0) fail_msg("%s is missing", installed(files[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_programs_are_installed_and_run),
        cmocka_unit_test(test_scenes_find_their_meshes),
        cmocka_unit_test(test_licence_and_message_types_are_installed),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}

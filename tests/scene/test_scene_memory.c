/* Each allocation of a read fails once: an error each time, and no leak (checked by ASan). */
#include "base/memory.h"
#include "scene_files.h"

#include <string.h>

static const char text[] = SCENE_HEAD "title: a\n"
                                      "bodies:\n  - {name: a, shape: box, min: [0, 0, 0], max: [1, 1, 1]}\n"
                                      "wavemakers: [{name: w, body: a, kind: goring, height: 0.1, depth: 0.5}]\n"
                                      "measure: {gauges: [{name: g, x: 1, y: 0.5}]}\n"
                                      "render:\n  cameras:\n    - {name: c, eye: [0, 0, 1], target: [1, 1, 1]}\n"
                                      "    - {name: d, path: [{time: 0, eye: [0, 0, 1], target: [1, 1, 1]},\n"
                                      "                       {time: 1, eye: [0, 0, 1], target: [1, 1, 1]}]}\n"
                                      "stream: {url: \"memq://\"}\n";

static void test_each_allocation(void **state)
{
    (void)state;
    char path[256];
    scene_file(text, path);
    const sb_override overrides[] = {{"bodies.a.max.2", "2"}, {"output.plots", "false"}};
    long n = 1;
    for (;; n++) {
        sb_scene scene;
        memset(&scene, 0x5a, sizeof scene);
        sb_scene before = scene;
        sb_error error = {0};
        sb_memory_fail_at(n);
        sb_status status = sb_scene_read(path, "paper", overrides, 2, &scene, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) {
            assert_near(scene.bodies[0].max.z, 2, 0);
            sb_scene_free(&scene);
            break;
        }
        assert_int_equal(status, SB_FAILED);
        assert_int_equal(error.status, SB_FAILED);
        if (!strstr(error.text, "out of memory")) fail_msg("allocation %ld: %s", n, error.text);
        assert_memory_equal(&scene, &before, sizeof scene);
    }
    remove(path);
    assert_true(n > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_allocation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

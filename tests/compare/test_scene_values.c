/* The keys and values of a written scene: lists by name and by number, units, quotes, damaged lines. */
#include "../check.h"

#include "base/memory.h"
#include "compare/scene_values.h"

#include <string.h>

static void assert_value(const sb_scene_values *values, const char *key, const char *expected)
{
    const char *value = sb_scene_values_find(values, key);
    if (!value) fail_msg("no key %s", key);
    assert_string_equal(value, expected);
}

static void keys_and_values(void **state)
{
    (void)state;
    static const char text[] = "# A scene.\n"
                               "title: \"A # \\\"wave\\\" of 25 m\"\n"
                               "resolution: 9 # m\n"
                               "domain:\n"
                               "  min: [-20, 0, -50] # m\n"
                               "  sides:\n"
                               "    x_min: wall\n"
                               "bodies:\n"
                               "  - name: \"sea wall\"\n"
                               "    max: [1, 2, 3] # m\n"
                               "  - name: \"house\"\n"
                               "    max: [4, 5, 6] # m\n"
                               "render:\n"
                               "  cameras:\n"
                               "    - name: \"side\"\n"
                               "      path:\n"
                               "        - time: 0 # s\n"
                               "          fov: 30 # deg\n"
                               "        - time: 7 # s\n"
                               "          fov: 40 # deg\n"
                               "    - name: \"top\"\n"
                               "      fov: 50 # deg\n"
                               "fluid:\n"
                               "  density: 1000 # kg/m3\n";
    sb_scene_values values;
    assert_int_equal(sb_scene_values_read(text, &values, NULL), SB_OK);
    assert_value(&values, "title", "A # \"wave\" of 25 m");
    assert_value(&values, "resolution", "9 m");
    assert_value(&values, "domain.min", "[-20, 0, -50] m");
    assert_value(&values, "domain.sides.x_min", "wall");
    assert_value(&values, "bodies.sea wall.max", "[1, 2, 3] m");
    assert_value(&values, "bodies.house.max", "[4, 5, 6] m");
    assert_value(&values, "render.cameras.side.path.1.fov", "30 deg");
    assert_value(&values, "render.cameras.side.path.2.time", "7 s");
    assert_value(&values, "render.cameras.top.fov", "50 deg");
    assert_value(&values, "fluid.density", "1000 kg/m3");
    assert_null(sb_scene_values_find(&values, "bodies"));
    sb_scene_values_free(&values);
}

static void keys_that_matter(void **state)
{
    (void)state;
    static const char *const yes[] = {"resolution", "bodies.wall.max", "numerics.seed", "rendering"};
    static const char *const no[] = {"title", "bodies.wall.color", "render.interval", "stream.enabled",
                                     "output.particle_interval"};
    for (size_t k = 0; k < sizeof yes / sizeof *yes; k++) assert_true(sb_scene_values_matter(yes[k]));
    for (size_t k = 0; k < sizeof no / sizeof *no; k++) assert_false(sb_scene_values_matter(no[k]));
}

/* Text of any kind is read to its end: deep, long, without colons. */
static void damaged_text(void **state)
{
    (void)state;
    enum { SIZE = 20000 };
    static char text[SIZE + 1];
    static const char alphabet[] = "ab: -\n\"#\\  \n  - :";
    unsigned random = 7;
    for (int round = 0; round < 50; round++) {
        for (int i = 0; i < SIZE; i++) {
            random = random * 1664525u + 1013904223u;
            text[i] = alphabet[(random >> 16) % (sizeof alphabet - 1)];
        }
        sb_scene_values values;
        assert_int_equal(sb_scene_values_read(text, &values, NULL), SB_OK);
        sb_scene_values_free(&values);
    }
    memset(text, 'k', SIZE);
    memcpy(text, "a: ", 3);
    sb_scene_values values;
    assert_int_equal(sb_scene_values_read(text, &values, NULL), SB_OK);
    assert_int_equal(values.count, 1);
    sb_scene_values_free(&values);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(keys_and_values), cmocka_unit_test(keys_that_matter),
                                       cmocka_unit_test(damaged_text)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

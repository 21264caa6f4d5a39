/* --set KEY=VALUE: keys by dots, indices and names, with the same checks as in the file. */
#include "scene_files.h"

#include <string.h>

#define SCENE_BODIES                                                                                                   \
    SCENE_HEAD "bodies:\n"                                                                                             \
               "  - {name: a, shape: box, min: [0, 0, 0], max: [1, 1, 1]}\n"                                           \
               "  - {name: a.b, shape: box, min: [0, 0, 0], max: [1, 1, 1]}\n"                                         \
               "  - {name: 0, shape: box, min: [0, 0, 0], max: [1, 1, 1]}\n"

static void read_with(const char *text, const char *key, const char *value, sb_scene *scene)
{
    sb_override one = {key, value};
    scene_must_read(text, NULL, &one, 1, scene);
}

static void refuse(const char *text, const char *key, const char *value, const char *expected)
{
    sb_override one = {key, value};
    sb_scene scene;
    sb_error error = {0};
    assert_int_equal(scene_read_text(text, NULL, &one, 1, &scene, &error), SB_BAD_INPUT);
    if (strcmp(error.text, expected) != 0) fail_msg("%s=%s\n  %s\nexpected\n  %s", key, value, error.text, expected);
}

static void test_values(void **state)
{
    (void)state;
    sb_scene scene;
    read_with(SCENE_HEAD, "resolution", "0.05", &scene);
    assert_near(scene.resolution, 0.05, 0);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD, "numerics.solver", "jacobi", &scene);
    assert_int_equal(scene.numerics.solver, SB_SOLVER_JACOBI);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD, "domain.sides.x_max", "open", &scene);
    assert_int_equal(scene.domain.side[SB_X_MAX], SB_SIDE_OPEN);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD, "domain.max", "[3, 1, 1]", &scene);
    assert_near(scene.domain.max.x, 3, 0);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD, "domain.max.2", "5", &scene);
    assert_near(scene.domain.max.z, 5, 0);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD, "measure.gauges", "[{name: g, x: 1, y: 0.5}]", &scene);
    assert_int_equal(scene.measure.gauge_count, 1);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD "render:\n", "render.width", "640", &scene);
    assert_int_equal(scene.render.width, 640);
    sb_scene_free(&scene);
    read_with(SCENE_HEAD "title: a\n", "title", "\"\"", &scene);
    assert_string_equal(scene.title, "");
    sb_scene_free(&scene);
}

static void test_later_wins(void **state)
{
    (void)state;
    const sb_override two[] = {{"resolution", "0.05"}, {"resolution", "0.2"}};
    sb_scene scene;
    scene_must_read(SCENE_HEAD, NULL, two, 2, &scene);
    assert_near(scene.resolution, 0.2, 0);
    sb_scene_free(&scene);
}

static void test_items(void **state)
{
    (void)state;
    static const struct {
        const char *key;
        size_t body;
    } cases[] = {{"bodies.a.max", 0},   {"bodies.1.max", 1},  {"bodies[1].max", 1},
                 {"bodies.a.b.max", 1}, {"bodies[0].max", 0}, {"bodies.0.max", 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sb_scene scene;
        read_with(SCENE_BODIES, cases[i].key, "[1, 1, 7]", &scene);
        for (size_t body = 0; body < 3; body++) assert_near(scene.bodies[body].max.z, body == cases[i].body ? 7 : 1, 0);
        sb_scene_free(&scene);
    }
}

/* null removes a key, which then has its default, an item, and a block; then the key can be given again. */
static void test_null_removes(void **state)
{
    (void)state;
    sb_scene scene;
    read_with(SCENE_BODIES, "bodies.a", "null", &scene);
    assert_int_equal(scene.body_count, 2);
    assert_string_equal(scene.bodies[0].name, "a.b");
    assert_string_equal(scene.bodies[1].name, "0");
    sb_scene_free(&scene);
    read_with(SCENE_BODIES, "bodies[2]", "~", &scene);
    assert_int_equal(scene.body_count, 2);
    assert_string_equal(scene.bodies[1].name, "a.b");
    sb_scene_free(&scene);
    read_with(SCENE_HEAD "title: a\nrender: {width: 640}\n", "render.width", "null", &scene);
    assert_int_not_equal(scene.render.width, 640);
    sb_scene_free(&scene);
    const sb_override again[] = {{"bodies", "null"},
                                 {"bodies", "[{name: z, shape: box, min: [0, 0, 0], max: [1, 1, 1]}]"}};
    scene_must_read(SCENE_BODIES, NULL, again, 2, &scene);
    assert_int_equal(scene.body_count, 1);
    assert_string_equal(scene.bodies[0].name, "z");
    sb_scene_free(&scene);
    refuse(SCENE_HEAD, "titel", "null", "--set: titel: null removes a key, and the scene has no such key");
    refuse(SCENE_HEAD, "render.width", "null",
           "--set: render.width: null removes a key, and the scene has no such key");
    read_with(SCENE_HEAD, "title", "\"null\"", &scene);
    assert_string_equal(scene.title, "null");
    sb_scene_free(&scene);
}

static void test_alias_is_a_copy(void **state)
{
    (void)state;
    sb_scene scene;
    read_with(SCENE_HEAD "bodies:\n"
                         "  - {name: a, shape: box, min: [0, 0, 0], max: &m [1, 1, 1]}\n"
                         "  - {name: b, shape: box, min: [0, 0, 0], max: *m}\n",
              "bodies.b.max.2", "7", &scene);
    assert_near(scene.bodies[0].max.z, 1, 0);
    assert_near(scene.bodies[1].max.z, 7, 0);
    sb_scene_free(&scene);
}

static void test_refused_keys(void **state)
{
    (void)state;
    refuse(SCENE_HEAD, "resolutoin", "1", "--set: resolutoin: unknown key, did you mean resolution?");
    refuse(SCENE_HEAD, "numerics.solvr", "cg", "--set: numerics.solvr: unknown key, did you mean solver?");
    refuse(SCENE_HEAD, "numerics.sleep", "true",
           "--set: numerics.sleep: this key was removed: still water is always computed; delete the key");
    refuse(
        SCENE_HEAD, "numerics.wall_gamma", "0.7",
        "--set: numerics.wall_gamma: this key was removed: boundary particles have their published volume; delete the "
        "key");
    refuse(SCENE_HEAD, "", "1", "--set: : a part is empty, expected KEY.KEY=VALUE");
    refuse(SCENE_HEAD, "domain..max", "1", "--set: domain..max: a part is empty, expected KEY.KEY=VALUE");
    refuse(SCENE_HEAD, "domain.", "1", "--set: domain.: ends in a dot, expected KEY.KEY=VALUE");
    refuse(SCENE_HEAD, "resolution.x", "1",
           "--set: resolution.x: the part before x is a single value, expected a block or a list");
    refuse(SCENE_BODIES, "bodies.c.max", "1",
           "--set: bodies.c.max: no such item in a list of 3, expected an item's name or its "
           "index from 0");
    refuse(SCENE_BODIES, "bodies[3].max", "1",
           "--set: bodies[3].max: no such item in a list of 3, expected an item's name or its "
           "index from 0");
    refuse(SCENE_BODIES, "bodies[0", "1",
           "--set: bodies[0: no such item in a list of 3, expected an item's name or its "
           "index from 0");
}

static void test_refused_values(void **state)
{
    (void)state;
    refuse(SCENE_HEAD, "resolution", "5m", "--set: resolution: 5m is not a number, expected metres > 0");
    refuse(SCENE_HEAD, "resolution", "", "--set: resolution: has no value, expected metres > 0");
    refuse(SCENE_HEAD, "resolution", "-1", "--set: resolution: -1 is out of range, expected metres > 0");
    refuse(SCENE_HEAD, "water.level", "4",
           "--set: water.level: 4 m is outside of the domain, expected metres > 0 and <= 1");
    refuse(SCENE_BODIES, "bodies.a.radius", "1",
           "--set: bodies[0].radius: does not apply here, expected only for shape cylinder");
    refuse(SCENE_HEAD, "domain", "[1, 2", "--set: domain: not valid YAML: did not find expected ',' or ']'");
    refuse(SCENE_HEAD, "title", "a\nb: c",
           "--set: title: not valid YAML: mapping values are not allowed in this context");
    refuse(SCENE_HEAD, "title", "a\n---\nb", "--set: title: a second YAML document, expected one");
    refuse(SCENE_HEAD, "title", "\xff", "--set: title: not UTF-8 text: invalid leading UTF-8 octet");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),       cmocka_unit_test(test_later_wins),
        cmocka_unit_test(test_items),        cmocka_unit_test(test_alias_is_a_copy),
        cmocka_unit_test(test_refused_keys), cmocka_unit_test(test_refused_values),
        cmocka_unit_test(test_null_removes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

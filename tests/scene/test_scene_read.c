/* Reading a scene: values, defaults, 2D and 3D, and defaults that depend on other keys. */
#include "scene_files.h"

#include <string.h>
#include <unistd.h>

static void test_defaults(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_HEAD, NULL, NULL, 0, &scene);
    assert_string_equal(scene.title, "");
    assert_int_equal(scene.dimensions, 3);
    assert_near(scene.resolution, 0.1, 0);
    assert_near(scene.fluid.density, 1000, 0);
    assert_near(scene.fluid.gravity, 9.81, 0);
    assert_near(scene.fluid.viscosity, 1e-6, 0);
    for (int side = 0; side < SB_SIDES; side++)
        assert_int_equal(scene.domain.side[side], side == SB_Z_MAX ? SB_SIDE_OPEN : SB_SIDE_WALL);
    assert_true(scene.sea.present);
    assert_near(scene.sea.level, 0.5, 0);
    assert_int_equal(scene.wave.kind, SB_INITIAL_NONE);
    assert_int_equal(scene.box_count + scene.body_count + scene.wavemaker_count, 0);
    assert_false(scene.measure.map.present);
    assert_int_equal(scene.render.width, 1280);
    assert_int_equal(scene.render.height, 720);
    assert_true(scene.render.video);
    assert_false(scene.stream.enabled);
    assert_string_equal(scene.stream.prefix, "shorebreak");
    assert_true(scene.output.plots);
    sb_scene_free(&scene);
    assert_null(scene.title);
    sb_scene_free(&scene);
}

static void test_periodic_sides(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read("resolution: 0.1\nduration: 1\n"
                    "domain: {min: [0, 0, 0], max: [2, 1, 1], sides: {y_max: periodic, "
                    "y_min: periodic}}\n"
                    "water: {level: 0.5, seed: [1, 0.5, 0.2]}\n"
                    "bodies: [{name: b, shape: box, min: [0, 0, 0], max: [0.3, 1, 1]}]\n"
                    "wavemakers: [{name: w, body: b, kind: stroke, stroke: 1, speed: 2}]\n",
                    NULL, NULL, 0, &scene);
    assert_true(!sb_scene_repeats(&scene, 0) && sb_scene_repeats(&scene, 1));
    assert_false(sb_scene_repeats(&scene, 2));
    sb_scene_free(&scene);
    /* In 2D the sides in y have no effect, alone or both. */
    scene_must_read("dimensions: 2\nresolution: 0.1\nduration: 1\n"
                    "domain: {min: [0, 0], max: [2, 1], sides: {y_max: periodic, "
                    "x_min: periodic, x_max: periodic}}\n"
                    "water: {level: 0.5, seed: [1, 0.2]}\n",
                    NULL, NULL, 0, &scene);
    assert_true(sb_scene_repeats(&scene, 0) && !sb_scene_repeats(&scene, 1));
    sb_scene_free(&scene);
}

static void test_boxes(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read("resolution: 0.1\nduration: 1\ndomain: {min: [0, 0, 0], max: [2, 1, 1]}\n"
                    "water:\n  boxes:\n"
                    "    - {min: [0, 0, 0], max: [1, 1, 0.5]}\n"
                    "    - {min: [1, 0, 0], max: [2, 1, 1], level: 0.2, velocity: [1, 0, -2]}\n",
                    NULL, NULL, 0, &scene);
    assert_false(scene.sea.present);
    assert_int_equal(scene.box_count, 2);
    assert_near(scene.boxes[0].level, 0.5, 0);
    assert_near(scene.boxes[1].level, 0.2, 0);
    assert_near(scene.boxes[1].velocity.z, -2, 0);
    sb_scene_free(&scene);
}

static void test_bodies(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_HEAD "bodies:\n"
                               "  - {name: pier, shape: box, min: [0, 0, 0], max: [1, 1, 1], "
                               "moment_point: [1, 2, 3], color: [0, 0.5, 1]}\n"
                               "  - {name: beach, shape: plane, role: terrain, center: [1, 0, 0], "
                               "normal: [-3, 0, 4], width: 1, length: 2}\n"
                               "  - {name: 12, shape: cylinder, center: [1, 0, 0], radius: 1, height: 2, "
                               "report: false}\n",
                    NULL, NULL, 0, &scene);
    const sb_body *bodies = scene.bodies;
    assert_true(bodies[0].report && bodies[0].has_moment_point);
    assert_near(bodies[0].moment_point.y, 2, 0);
    assert_near((double)bodies[0].color[1], 0.5, 0);
    assert_int_equal(bodies[0].role, SB_ROLE_SOLID);
    assert_int_equal(bodies[1].role, SB_ROLE_TERRAIN);
    assert_false(bodies[1].report || bodies[1].has_moment_point);
    assert_true(bodies[1].color[0] < 0);
    assert_near(bodies[1].normal.x, -0.6, 1e-15);
    assert_near(bodies[1].normal.z, 0.8, 1e-15);
    assert_string_equal(bodies[2].name, "12");
    assert_false(bodies[2].report);
    sb_scene_free(&scene);
}

static void test_files(void **state)
{
    (void)state;
    char mesh[256], text[800], folder[4096];
    scene_file("0 0 0\n", mesh);
    const char *name = strrchr(mesh, '/') + 1;
    snprintf(text, sizeof text,
             SCENE_HEAD "bodies:\n  - {name: bed, shape: grid, file: %s, datum: 2}\n"
                        "  - {name: town, shape: mesh, file: ./%s, up: y, scale: 0.001}\n",
             name, name);
    sb_scene scene;
    scene_must_read(text, NULL, NULL, 0, &scene);
    remove(mesh);
    assert_non_null(realpath(SB_BINARY_DIR, folder));
    char path[5000];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_string_equal(scene.bodies[0].file, path);
    assert_int_equal(scene.bodies[0].role, SB_ROLE_TERRAIN);
    assert_false(scene.bodies[0].report);
    assert_near(scene.bodies[0].datum, 2, 0);
    assert_int_equal(scene.bodies[1].up, 'y');
    assert_near(scene.bodies[1].scale, 0.001, 0);
    assert_int_equal(scene.bodies[1].file[0], '/');
    sb_scene_free(&scene);
}

static void test_two_dimensions(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_FLAT "bodies:\n  - {name: wall, shape: box, min: [1, 0], max: [2, 1]}\n"
                               "  - {name: thick, shape: box, min: [1, -3, 0], max: [2, 4, 1]}\n"
                               "  - {name: beach, shape: plane, center: [1, 0], normal: [0, 2], length: 1}\n"
                               "wavemakers: [{name: w, body: wall, kind: stroke, stroke: 1, speed: 2, "
                               "direction: [0, 5], after: return, return_time: 9}]\n"
                               "measure:\n  gauges: [{name: g, x: 1}]\n  planes: [{name: p, from: [1]}]\n"
                               "  map: {}\n",
                    NULL, NULL, 0, &scene);
    assert_near(scene.domain.max.y, 0, 0);
    assert_near(scene.domain.max.z, 1, 0);
    assert_near(scene.sea.seed.z, 0.2, 0);
    double half_width = 2 * scene.numerics.support * 0.1;
    assert_near(scene.bodies[0].min.y, -half_width, 0);
    assert_near(scene.bodies[0].max.y, half_width, 0);
    assert_near(scene.bodies[1].max.y, 4, 0);
    assert_near(scene.bodies[2].width, 2 * half_width, 0);
    assert_near(scene.bodies[2].normal.z, 1, 0);
    assert_near(scene.wavemakers[0].direction.z, 1, 0);
    assert_near(scene.wavemakers[0].law.gravity, 9.81, 0);
    assert_int_equal(scene.wavemakers[0].law.after, SB_AFTER_RETURN);
    assert_near(scene.measure.planes[0].by - scene.measure.planes[0].ay, 1, 0);
    assert_near(scene.measure.planes[0].bx, 1, 0);
    assert_near(scene.measure.map.y_max - scene.measure.map.y_min, 0.2, 1e-15);
    sb_scene_free(&scene);
}

static void test_measure_and_cameras(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_HEAD "measure:\n  planes: [{name: p, from: [1, 0], to: [1, 1], z_max: 0.7}]\n"
                               "  map: {cell: 0.5}\n"
                               "render:\n  cameras:\n    - {name: a, eye: [0, 0, 1], target: [1, 1, 1]}\n"
                               "    - name: b\n      path:\n"
                               "        - {time: 0, eye: [0, 0, 1], target: [1, 1, 1], fov: 20}\n"
                               "        - {time: 2, eye: [0, 0, 2], target: [1, 1, 1]}\n",
                    NULL, NULL, 0, &scene);
    assert_near(scene.measure.planes[0].z_min, 0, 0);
    assert_near(scene.measure.planes[0].z_max, 0.7, 0);
    assert_true(scene.measure.map.present);
    assert_near(scene.measure.map.x_max, 2, 0);
    assert_near(scene.measure.map.cell, 0.5, 0);
    assert_near(scene.measure.map.threshold, 0.1, 0);
    const sb_camera *cameras = scene.render.cameras;
    assert_int_equal(cameras[0].key_count, 1);
    assert_near(cameras[0].keys[0].fov, 45, 0);
    assert_int_equal(cameras[1].key_count, 2);
    assert_near(cameras[1].keys[0].fov, 20, 0);
    assert_near(cameras[1].keys[1].time, 2, 0);
    assert_near(cameras[1].keys[1].eye.z, 2, 0);
    sb_scene_free(&scene);
}

/* Of a plane that reaches beyond the domain the part within counts, with its direction. */
static void test_planes_end_with_the_domain(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_HEAD "measure:\n  planes: [{name: p, from: [1.5, 3], to: [1.5, -1]}, "
                               "{name: q, from: [-1, -0.25], to: [3, 0.75]}, {name: r, from: [0, 0], to: [2, 1]}]\n",
                    NULL, NULL, 0, &scene);
    const sb_flow_plane *p = scene.measure.planes;
    assert_true(p[0].ax == 1.5 && p[0].bx == 1.5 && p[0].ay == 1 && p[0].by == 0);
    assert_true(p[1].ax == 0 && p[1].ay == 0 && p[1].bx == 2 && p[1].by == 0.5);
    assert_true(p[2].ax == 0 && p[2].ay == 0 && p[2].bx == 2 && p[2].by == 1);
    sb_scene_free(&scene);
}

static void test_aliases(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(SCENE_HEAD "render:\n  cameras:\n    - {name: a, eye: &e [0, 0, 1], target: [1, 1, 1]}\n"
                               "    - {name: b, eye: *e, target: [2, 1, 1]}\n",
                    NULL, NULL, 0, &scene);
    assert_near(scene.render.cameras[1].keys[0].eye.z, 1, 0);
    sb_scene_free(&scene);
}

/* Some editors write a byte order mark; errors still have the right place. */
static void test_a_byte_order_mark(void **state)
{
    (void)state;
    sb_scene scene;
    sb_error error = {0};
    scene_must_read("\xef\xbb\xbf" SCENE_HEAD, NULL, NULL, 0, &scene);
    assert_near(scene.resolution, 0.1, 0);
    sb_scene_free(&scene);
    assert_int_equal(scene_read_text("\xef\xbb\xbf"
                                     "wide: 1\n" SCENE_HEAD,
                                     NULL, NULL, 0, &scene, &error),
                     SB_BAD_INPUT);
    assert_non_null(strstr(error.text, ":1:1: wide: "));
}

static void test_presets(void **state)
{
    (void)state;
    sb_scene paper, usual, mixed;
    scene_must_read(SCENE_HEAD, "paper", NULL, 0, &paper);
    assert_int_equal(paper.numerics.preset, SB_PRESET_PAPER);
    assert_int_equal(paper.numerics.solver, SB_SOLVER_JACOBI);
    assert_int_equal(paper.numerics.tolerance_rule, SB_TOLERANCE_DENSITY);
    assert_int_equal(paper.numerics.time_step_rule, SB_TIME_STEP_PAPER);
    assert_near(paper.numerics.tolerance, 1e-3, 0);
    assert_near(paper.numerics.time_step_factor, 0.075, 0);
    assert_near(paper.numerics.warm_start, 0.6, 0);
    assert_string_equal(paper.numerics.kernel->name, "cubic");
    scene_must_read(SCENE_HEAD, NULL, NULL, 0, &usual);
    assert_int_equal(usual.numerics.preset, SB_PRESET_DEFAULT);
    assert_true(memcmp(&usual.numerics, &paper.numerics, sizeof usual.numerics) != 0);
    /* The scene's own keys win over the preset, and --preset over the scene's preset. */
    scene_must_read(SCENE_HEAD "numerics: {preset: default, relaxation: 0.25}\n", "paper", NULL, 0, &mixed);
    assert_near(mixed.numerics.relaxation, 0.25, 0);
    mixed.numerics.relaxation = paper.numerics.relaxation;
    assert_memory_equal(&mixed.numerics, &paper.numerics, sizeof mixed.numerics);
    sb_error error = {0};
    assert_int_equal(scene_read_text(SCENE_HEAD, "fast", NULL, 0, &mixed, &error), SB_BAD_INPUT);
    assert_string_equal(error.text, "--preset: fast is not known, expected default, paper or wen");
    sb_scene_free(&paper);
    sb_scene_free(&usual);
    sb_scene_free(&mixed);
}

/* The check before the parser counts brackets and anchors, but not those in comments, quoted texts or text blocks. */
static void test_brackets_in_texts_do_not_count(void **state)
{
    (void)state;
    char text[16384] = SCENE_HEAD "# ", title[64];
    for (int i = 0; i < 1500; i++) strcat(text, i % 100 == 99 ? "[\n# " : "[{&a ");
    snprintf(title, sizeof title, "\ntitle: \"a # [[[[");
    strcat(text, title);
    for (int i = 0; i < 1500; i++) strcat(text, "[");
    strcat(text, "\" # [[[\n");
    sb_scene scene;
    scene_must_read(text, NULL, NULL, 0, &scene);
    assert_int_equal(strlen(scene.title), strlen("a # [[[[") + 1500);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_periodic_sides),
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_bodies),
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_two_dimensions),
        cmocka_unit_test(test_measure_and_cameras),
        cmocka_unit_test(test_planes_end_with_the_domain),
        cmocka_unit_test(test_aliases),
        cmocka_unit_test(test_a_byte_order_mark),
        cmocka_unit_test(test_presets),
        cmocka_unit_test(test_brackets_in_texts_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

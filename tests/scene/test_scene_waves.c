/* Sponges and measurements that take period and depth from the scene's waves. */
#include "scene_files.h"

#include "physics/waves/dispersion.h"
#include "scene/scene_waves.h"

#include <math.h>
#include <string.h>

#define BODIES                                                                                                         \
    "bodies: [{name: a, shape: box, min: [-0.5, 0], max: [0, 1.8]}, {name: b, shape: box, min: [19, 0], max: [20, "    \
    "1.8]}]\n"
#define FLUME(paddles, more)                                                                                           \
    "dimensions: 2\nresolution: 0.1\nduration: 1\ndomain: {min: [-1, 0], max: [20, 2]}\nwater: {level: 1, seed: [2, "  \
    "0.5]}\n" BODIES "wavemakers: [" paddles "]\n" more
#define REGULAR "{name: w, body: a, kind: regular, height: 0.1, period: 2, depth: 1}"
#define BEACH "sponges: [{name: beach, side: x_max}]\n"
#define GAUGES "interval: 0.05, gauges: [{name: g, x: 3}, {name: h, x: 3.7}, {name: i, x: 5}], "
#define SPLIT "reflections: [{name: r, gauges: [g, h, i]}]"

static void keys_follow_the_wave_maker(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(FLUME(REGULAR, BEACH "measure: {" GAUGES SPLIT ", waves: {}}\n"), NULL, NULL, 0, &scene);
    assert_near(scene.sponges[0].period, 2, 0);
    assert_near(scene.sponges[0].depth, 1, 0);
    assert_near(scene.sponges[0].length, 2 * M_PI / sb_wave_number(2, 1, 9.81), 1e-9);
    assert_near(scene.measure.waves.period, 2, 0);
    assert_near(scene.measure.reflections[0].period, 2, 0);
    assert_near(scene.measure.reflections[0].depth, 1, 0);
    assert_near(scene.measure.reflections[0].window, 10, 0);
    /* Fenton's series for 0.1 m and 2 s on 1 m; the linear wave has 5.215 m. */
    assert_near(scene.measure.reflections[0].length, 5.224, 0.002);
    sb_scene_free(&scene);
    const sb_override period = {"wavemakers.w.period", "1.5"};
    scene_must_read(FLUME(REGULAR, BEACH), NULL, &period, 1, &scene);
    assert_near(scene.sponges[0].period, 1.5, 0);
    sb_scene_free(&scene);
}

static void keys_that_are_given_stay(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(FLUME(REGULAR, "sponges: [{name: s, side: x_max, length: 3, depth: 0.8}]\n"
                                   "measure: {" GAUGES "waves: {period: 0}}\n"),
                    NULL, NULL, 0, &scene);
    assert_near(scene.sponges[0].period, 2, 0);
    assert_near(scene.sponges[0].depth, 0.8, 0);
    assert_near(scene.sponges[0].length, 3, 0);
    assert_near(scene.measure.waves.period, 0, 0);
    sb_scene_free(&scene);
}

/* A spectrum has the period of its peak, which is none for harmonics. */
static void spectra_have_their_peak(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(FLUME("{name: w, body: a, kind: irregular, height: 0.1, period: 2, depth: 1}",
                          BEACH "measure: {" GAUGES "waves: {}}\n"),
                    NULL, NULL, 0, &scene);
    assert_near(scene.sponges[0].period, 2, 0);
    assert_near(scene.measure.waves.period, 0, 0);
    sb_scene_free(&scene);
}

/* Waves at the start and an absorber beside the paddle; two paddles. */
static void waves_of_a_scene_are_those_of_all_that_make_them(void **state)
{
    (void)state;
    sb_scene scene;
    scene_must_read(
        FLUME(REGULAR ", {name: v, body: b, direction: [-1, 0], kind: absorber, period: 3, depth: 1}", BEACH), NULL,
        NULL, 0, &scene);
    const sb_scene_waves waves = sb_scene_waves_of(&scene);
    assert_near(waves.period, 2, 0);
    assert_string_equal(waves.name, "w");
    assert_true(waves.regular);
    sb_scene_free(&scene);
#define SECOND(period)                                                                                                 \
    FLUME(REGULAR ", {name: v, body: b, direction: [-1, 0], kind: regular, height: 0.1, depth: 1, period: " period     \
                  "}",                                                                                                 \
          "")
    scene_must_read(SECOND("2"), NULL, NULL, 0, &scene);
    assert_near(sb_scene_waves_of(&scene).period, 2, 0);
    sb_scene_free(&scene);
    scene_must_read(SECOND("3"), NULL, NULL, 0, &scene);
    assert_near(sb_scene_waves_of(&scene).period, 0, 0);
    sb_scene_free(&scene);
    scene_must_read("dimensions: 2\nresolution: 0.1\nduration: 1\ndomain: {min: [0, 0], max: [5, 1], sides: {x_min: "
                    "periodic, x_max: periodic}}\nwater: {level: 0.5, seed: [1, 0.2], wave: {kind: regular, height: "
                    "0.05, depth: 0.5, wavelength: 5}}\n",
                    NULL, NULL, 0, &scene);
    assert_near(sb_scene_waves_of(&scene).depth, 0.5, 0);
    assert_near(sb_scene_waves_of(&scene).period, 2 * M_PI / sqrt(9.81 * 2 * M_PI / 5 * tanh(M_PI / 5)), 0.02);
    sb_scene_free(&scene);
}

static void scenes_without_such_waves_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *why;
    } cases[] = {
        {FLUME("", BEACH), "sponges[0]: period is missing, and the scene has no waves that it could be that of, "
                           "expected seconds > 0"},
        {FLUME("", "sponges: [{name: s, side: x_max, period: 2}]\n"), "sponges[0]: depth is missing"},
        {FLUME("{name: w, body: a, kind: irregular, height: 0.1, period: 2, depth: 1}",
               "measure: {" GAUGES SPLIT "}\n"),
         "measure.reflections[0]: period is missing, and the scene has no regular waves"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sb_scene scene;
        sb_error error = {0};
        assert_int_equal(scene_read_text(cases[i].text, NULL, NULL, 0, &scene, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[i].why)) fail_msg("%s", error.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_follow_the_wave_maker), cmocka_unit_test(keys_that_are_given_stay),
        cmocka_unit_test(spectra_have_their_peak), cmocka_unit_test(waves_of_a_scene_are_those_of_all_that_make_them),
        cmocka_unit_test(scenes_without_such_waves_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A written scene is read back equal, for every scene of the project and for one with all keys. */
#include "scene_files.h"

#include <glob.h>
#include <string.h>
#include <unistd.h>

static const char everything[] =
    "title: \"Grüße \\u2028 \\\"quoted\\\" \\\\ \\t end\\u2029 \\U0001F30A\"\n"
    "resolution: 0.1234567890123456789\nduration: 1e-3\n"
    "fluid: {density: 1025, gravity: 9.80665, viscosity: 0}\n"
    "domain: {min: [-1e5, -0.1, 0], max: [2, 1, 1], sides: {x_min: open, y_min: sea, y_max: open}}\n"
    "numerics: {preset: paper, kernel: KERNEL, support: 2.7, seed: 18446744073709551615,\n"
    "  solver: chebyshev, time_step_max: 0.1, settle_steps: 7}\n"
    "water:\n  level: 0.3\n  seed: [1, 0.5, 0.2]\n  boxes:\n"
    "    - {min: [0, 0, 0], max: [1, 1, 1], level: 0.3, velocity: [0.1, 0.2, 0.3]}\n"
    "    - {min: [1, 0, 0], max: [2, 1, 0.7]}\n"
    "  wave: {kind: solitary, height: 0.1, depth: 0.3, position: 0.7, direction: -1}\n"
    "sea: {source: theory, wave: components, depth: 0.3, start: -3.5, components:\n"
    "  [{amplitude: 0.01, period: 2.3, direction: 30, phase: -7}, {amplitude: 0.02, period: 1}]}\n"
    "bodies:\n"
    "  - {name: null_, shape: mesh, file: FILE, up: y, scale: 0.3048, split: true,\n"
    "     rotate: [10, 20, 30], translate: [1, 2, 3]}\n"
    "  - {name: bed, shape: grid, file: FILE, crs: 'EPSG:4326', datum: -0.1, resample: 0.5, voids: fill}\n"
    "  - {name: coast, shape: grid, files: [FILE, {file: FILE, crs: '+proj=utm +zone=54 +type=crs', datum: 2}],\n"
    "     projection: 'EPSG:32654', origin: [5.5e5, 4.25e6], window: {min: [1, 2], max: [3, 4]}}\n"
    "  - {name: b-1, shape: box, min: [0, 0, 0], max: [1, 1, 1], color: [0.1, 0.2, 0.3]}\n"
    "  - {name: c.d, shape: cylinder, center: [0, 0, 0], radius: 1, height: 2, report: false}\n"
    "  - {name: 1e5, shape: plane, center: [0, 0, 0], normal: [1, 2, 3], width: 1, length: 2,\n"
    "     moment_point: [4, 5, 6], role: terrain}\n"
    "  - {name: \"true\", shape: basin, min: [0, 0, 0], max: [1, 1, 1]}\n"
    "wavemakers:\n"
    "  - {name: w, body: b-1, kind: stroke, stroke: 1, speed: 0.1, direction: [1, 1, 1],\n"
    "     start: 0.1, after: return, return_time: 3}\n"
    "  - {name: v, body: c.d, kind: goring, height: 0.1, depth: 0.3, start: command}\n"
    "measure:\n  interval: 0.001\n  gauges: [{name: g, x: 1, y: 0.5}, {name: h, x: 1.1, y: 0.6}, {name: i, x: 1.3, y: "
    "0.8}]\n"
    "  reflections: [{name: s, gauges: [g, {name: h}, i], period: 0.7, depth: 0.3}]\n"
    "  probes: [{name: p, at: [1, 0.5, 0.1], radius: 0.1}]\n"
    "  planes: [{name: q, from: [1, 0], to: [1, 1], z_min: 0.1, z_max: 0.9, record: true, record_interval: 0.003}]\n"
    "  runups: [{name: r, from: [1, 0], to: [1, 1]}]\n"
    "  map: {min: [0, 0], max: [1, 1], cell: 0.3, threshold: 0.07}\n"
    "render:\n  interval: 0.1\n  speed_max: 3\n  video: false\n  stills: [0.1, {time: 0.3}]\n  still_width: 333\n"
    "  insets: [{force: b-1, axis: z}, {force: b-1}, {gauge: g}]\n  cameras:\n"
    "    - {name: c, closeup: b-1, direction: [1, 2, 0.3], margin: 2, fov: 12}\n"
    "    - {name: d, orbit: {target: [1, 1, 0], radius: 3, turns: -0.3, from: 7}}\n"
    "    - {name: e, orbit: {target: [1, 1, 0], radius: 3, height: 1, period: 0.7}, fov: 20,\n"
    "       slice: {point: [0.1, 0.2, 0.3], normal: [0, 3, -0.7], behind: false, field: depth, field_max: 0.7,\n"
    "               vectors: 123, vector_speed: 0.3, streamlines: 345.6}}\n"
    "    - {name: f, eye: [0, 0, 1], target: [1, 1, 1], follow: crest, travel: true, width: 0.4, to: [1, 1]}\n"
    "    - {name: a, eye: [0, 0, 1], target: [1, 1, 1], fov: 33.3}\n"
    "    - {name: b, path: [{time: 0.1, eye: [0, 0, 1], target: [1, 1, 1], ease: out},\n"
    "                       {time: 0.2, eye: [0, 0, 2], target: [1, 1, 1], fov: 20}]}\n"
    "stream: {enabled: true, url: \"memq://\", prefix: A.B, interval: 0.3, decimation: 4}\n"
    "control: {enabled: true, paused: true}\n"
    "output: {particle_interval: 0.25, plots: false}\n";

#define SAME_ITEMS(a, b, items, count)                                                                                 \
    do {                                                                                                               \
        assert_int_equal((a)->count, (b)->count);                                                                      \
        if ((a)->count > 0) assert_memory_equal((a)->items, (b)->items, (a)->count * sizeof *(a)->items);              \
    } while (0)

static void same_text(char **a, char **b)
{
    assert_int_equal(*a != NULL, *b != NULL);
    if (*a) assert_string_equal(*a, *b);
}

static void same_given(const sb_scene *a, const sb_scene *b)
{
    sb_given_sea one, other;
    memcpy(&one, &a->given, sizeof one);
    memcpy(&other, &b->given, sizeof other);
    SAME_ITEMS(&one, &other, components, component_count);
    same_text(&one.file, &other.file);
    one.file = other.file = NULL;
    one.components = other.components = NULL;
    assert_memory_equal(&one, &other, sizeof one);
}

static void same_files(const sb_body *a, const sb_body *b)
{
    assert_int_equal(a->file_count, b->file_count);
    for (size_t i = 0; i < a->file_count; i++) {
        same_text(&a->files[i].file, &b->files[i].file);
        same_text(&a->files[i].crs, &b->files[i].crs);
        assert_near(a->files[i].datum, b->files[i].datum, 0);
    }
}

static void same_bodies(const sb_scene *a, const sb_scene *b)
{
    assert_int_equal(a->body_count, b->body_count);
    for (size_t i = 0; i < a->body_count; i++) {
        sb_body one, other;
        memcpy(&one, &a->bodies[i], sizeof one);
        memcpy(&other, &b->bodies[i], sizeof other);
        same_text(&one.file, &other.file);
        same_text(&one.crs, &other.crs);
        same_text(&one.projection, &other.projection);
        same_files(&one, &other);
        one.file = one.crs = one.projection = other.file = other.crs = other.projection = NULL;
        one.files = other.files = NULL;
        assert_memory_equal(&one, &other, sizeof one);
    }
}

static void same_wavemakers(const sb_scene *a, const sb_scene *b)
{
    assert_int_equal(a->wavemaker_count, b->wavemaker_count);
    for (size_t i = 0; i < a->wavemaker_count; i++) {
        sb_wavemaker_use one, other;
        memcpy(&one, &a->wavemakers[i], sizeof one);
        memcpy(&other, &b->wavemakers[i], sizeof other);
        same_text(&one.law.file, &other.law.file);
        one.law.file = other.law.file = NULL;
        assert_memory_equal(&one, &other, sizeof one);
    }
}

static void same_render(const sb_render_settings *a, const sb_render_settings *b)
{
    sb_render_settings one, other;
    SAME_ITEMS(a, b, stills, still_count);
    SAME_ITEMS(a, b, insets, inset_count);
    memcpy(&one, a, sizeof one);
    memcpy(&other, b, sizeof other);
    one.stills = other.stills = NULL;
    one.insets = other.insets = NULL;
    one.cameras = other.cameras = NULL;
    assert_memory_equal(&one, &other, sizeof one);
    for (size_t i = 0; i < a->camera_count; i++) {
        sb_camera left, right;
        SAME_ITEMS(&a->cameras[i], &b->cameras[i], keys, key_count);
        memcpy(&left, &a->cameras[i], sizeof left);
        memcpy(&right, &b->cameras[i], sizeof right);
        left.keys = right.keys = NULL;
        assert_memory_equal(&left, &right, sizeof left);
    }
}

static void same_scene(sb_scene *a, sb_scene *b)
{
    same_text(&a->title, &b->title);
    assert_int_equal(a->dimensions, b->dimensions);
    assert_near(a->resolution, b->resolution, 0);
    assert_near(a->duration, b->duration, 0);
    assert_memory_equal(&a->fluid, &b->fluid, sizeof a->fluid);
    assert_memory_equal(&a->domain, &b->domain, sizeof a->domain);
    assert_memory_equal(&a->sea, &b->sea, sizeof a->sea);
    assert_memory_equal(&a->wave, &b->wave, sizeof a->wave);
    same_given(a, b);
    assert_memory_equal(&a->numerics, &b->numerics, sizeof a->numerics);
    SAME_ITEMS(a, b, boxes, box_count);
    same_bodies(a, b);
    same_wavemakers(a, b);
    assert_near(a->measure.interval, b->measure.interval, 0);
    SAME_ITEMS(&a->measure, &b->measure, gauges, gauge_count);
    SAME_ITEMS(&a->measure, &b->measure, probes, probe_count);
    SAME_ITEMS(&a->measure, &b->measure, planes, plane_count);
    SAME_ITEMS(&a->measure, &b->measure, runups, runup_count);
    assert_int_equal(a->measure.reflection_count, b->measure.reflection_count);
    for (size_t i = 0; i < a->measure.reflection_count; i++) {
        sb_reflection_set one, other;
        memcpy(&one, &a->measure.reflections[i], sizeof one);
        memcpy(&other, &b->measure.reflections[i], sizeof other);
        SAME_ITEMS(&one, &other, gauges, gauge_count);
        one.gauges = other.gauges = NULL;
        assert_memory_equal(&one, &other, sizeof one);
    }
    assert_memory_equal(&a->measure.map, &b->measure.map, sizeof a->measure.map);
    same_render(&a->render, &b->render);
    assert_int_equal(a->control.enabled, b->control.enabled);
    assert_int_equal(a->control.paused, b->control.paused);
    assert_int_equal(a->stream.enabled, b->stream.enabled);
    same_text(&a->stream.url, &b->stream.url);
    assert_string_equal(a->stream.prefix, b->stream.prefix);
    assert_near(a->stream.interval, b->stream.interval, 0);
    assert_int_equal(a->stream.decimation, b->stream.decimation);
    assert_near(a->output.particle_interval, b->output.particle_interval, 0);
    assert_int_equal(a->output.plots, b->output.plots);
}

static void round_trip(const char *path)
{
    char copy[256];
    sb_scene scene, again;
    sb_error error = {0};
    if (sb_scene_read(path, NULL, NULL, 0, &scene, &error) != SB_OK) fail_msg("%s", error.text);
    scene_file("", copy);
    if (sb_scene_write(&scene, copy, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_scene_read(copy, NULL, NULL, 0, &again, &error) != SB_OK) fail_msg("%s", error.text);
    remove(copy);
    same_scene(&scene, &again);
    sb_scene_free(&scene);
    sb_scene_free(&again);
}

static void test_scenes_of_the_project(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob(SB_SOURCE_DIR "/assets/scenes/*.yaml", 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= 3);
    for (size_t i = 0; i < found.gl_pathc; i++) round_trip(found.gl_pathv[i]);
    globfree(&found);
}

/* The text above with a mesh file that exists and a kernel other than the default. */
static void fill_in(const char *mesh, char *text, size_t size)
{
    const struct {
        const char *key, *value;
    } texts[] = {{"FILE", mesh}, {"KERNEL", sb_kernels[1]->name}};
    size_t used = 0;
    for (const char *at = everything; *at;) {
        size_t i = 0;
        while (i < 2 && strncmp(at, texts[i].key, strlen(texts[i].key)) != 0) i++;
        if (i < 2)
            used += (size_t)snprintf(text + used, size - used, "%s", texts[i].value);
        else
            text[used++] = *at;
        at += i < 2 ? strlen(texts[i].key) : 1;
        assert_true(used < size - 1);
    }
    text[used] = '\0';
}

static void test_everything(void **state)
{
    (void)state;
    char mesh[256], path[256], text[sizeof everything + 512];
    scene_file("0 0 0\n", mesh);
    fill_in(mesh, text, sizeof text);
    scene_file(text, path);
    round_trip(path);
    sb_scene scene;
    sb_error error = {0};
    assert_int_equal(sb_scene_read(path, NULL, NULL, 0, &scene, &error), SB_OK);
    assert_string_equal(scene.title, "Grüße \u2028 \"quoted\" \\ \t end\u2029 \U0001F30A");
    assert_true(scene.numerics.seed == UINT64_MAX);
    assert_near(scene.resolution, 0.1234567890123456789, 0);
    sb_scene_free(&scene);
    remove(path);
    remove(mesh);
}

/* Each source of given water, with the defaults that depend on other keys. */
static void test_given_water(void **state)
{
    (void)state;
    static const char *const blocks[] = {
        "source: none",
        "source: theory, wave: solitary, height: 0.1, depth: 0.5, direction: 135, theory: boussinesq",
        "source: theory, wave: regular, height: 0.05, period: 2, depth: 0.5, level: 0.4",
        "source: table, file: FILE, units: ft, datum: -3",
        "source: table, file: FILE",
        "source: record, file: FILE, plane: p, start: -20"};
    char file[256], path[256], block[600], text[1000];
    scene_file("0 0 0\n", file);
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        const char *at = strstr(blocks[i], "FILE");
        if (at)
            snprintf(block, sizeof block, "%.*s%s%s", (int)(at - blocks[i]), blocks[i], file, at + 4);
        else
            snprintf(block, sizeof block, "%s", blocks[i]);
        snprintf(text, sizeof text, SCENE_SEA "sea: {%s}\n", block);
        scene_file(text, path);
        round_trip(path);
        remove(path);
    }
    sb_scene scene;
    scene_must_read(SCENE_SEA "sea: {source: theory, wave: solitary, height: 0.1, depth: 0.5, direction: 135}\n", NULL,
                    NULL, 0, &scene);
    assert_near(scene.given.level, 0.5, 0);
    assert_true(scene.given.origin[0] == 2 && scene.given.origin[1] == 0 && scene.given.ramp == 0);
    assert_int_equal(scene.given.theory, SB_GIVEN_EXACT);
    sb_scene_free(&scene);
    remove(file);
}

/* The written scene has the length that follows from the period. */
static void test_wave_of_a_period(void **state)
{
    (void)state;
    static const char text[] =
        "dimensions: 2\nresolution: 0.05\nduration: 1\ndomain: {min: [0, 0], max: [4, 1]}\nwater: {level: 0.5, "
        "seed: [1, 0.2], wave: {kind: regular, height: 0.12, depth: 0.5, period: 1.2}}\n";
    char path[256];
    sb_scene scene;
    scene_must_read(text, NULL, NULL, 0, &scene);
    assert_near(scene.wave.wavelength, 1.2 * scene.wave.stokes.celerity, 1e-12);
    sb_scene_free(&scene);
    scene_file(text, path);
    round_trip(path);
    remove(path);
}

static void test_flat(void **state)
{
    (void)state;
    char path[256];
    scene_file(SCENE_FLAT "bodies:\n  - {name: wall, shape: box, min: [1, 0], max: [2, 1]}\n"
                          "  - {name: beach, shape: plane, center: [1, 0], normal: [1, 2], "
                          "length: 1, rotate: [0, 3, 0]}\n"
                          "measure:\n  gauges: [{name: g, x: 1}]\n"
                          "  planes: [{name: p, from: [1]}]\n"
                          "  runups: [{name: r, from: [1], to: [2]}]\n  map: {}\n",
               path);
    round_trip(path);
    remove(path);
}

static void test_refused(void **state)
{
    (void)state;
    sb_scene scene;
    sb_error error = {0};
    scene_must_read(SCENE_HEAD, NULL, NULL, 0, &scene);
    assert_int_equal(sb_scene_write(&scene, "/no/such/folder/scene.yaml", &error), SB_FAILED);
    assert_non_null(strstr(error.text, "/no/such/folder/scene.yaml: cannot write"));
    char path[256];
    scene_file("", path);
    remove(path);
    char *title = scene.title, bad[] = "a\xff";
    scene.title = bad;
    assert_int_equal(sb_scene_write(&scene, path, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "not UTF-8"));
    assert_int_equal(access(path, F_OK), -1);
    scene.title = title;
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes_of_the_project),
        cmocka_unit_test(test_everything),
        cmocka_unit_test(test_given_water),
        cmocka_unit_test(test_wave_of_a_period),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

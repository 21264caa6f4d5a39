/* The identity of a scene, by which a resumed run is checked: it contains everything that determines the state, and
   nothing else. */
#include "base/memory.h"
#include "scene_files.h"

#include <string.h>
#include <unistd.h>

#define MOTION "0 0\n1 0.1\n"

/* A scene whose terrain and paddle are files with these contents, in its own folder. */
static char *identity_of(const char *heights, const char *motion, const char *key, const char *value)
{
    char folder[256], path[3][300], text[2048];
    snprintf(folder, sizeof folder, "%s/identity-XXXXXX", SB_BINARY_DIR);
    assert_non_null(mkdtemp(folder));
    snprintf(text, sizeof text,
             SCENE_HEAD "bodies:\n"
                        "  - {name: ground, shape: grid, file: heights.asc}\n"
                        "  - {name: paddle, shape: box, min: [0, 0, 0], max: [0.3, 1, 1]}\n"
                        "wavemakers: [{name: w, body: paddle, kind: file, file: motion.txt}]\n");
    const char *const names[] = {"scene.yaml", "heights.asc", "motion.txt"};
    const char *const contents[] = {text, heights, motion};
    for (int f = 0; f < 3; f++) {
        snprintf(path[f], sizeof path[f], "%.256s/%s", folder, names[f]);
        FILE *file = fopen(path[f], "wb");
        assert_non_null(file);
        fputs(contents[f], file);
        assert_int_equal(fclose(file), 0);
    }
    sb_scene scene = {0};
    sb_error error = {0};
    sb_override one = {key, value};
    char *identity = NULL;
    if (sb_scene_read(path[0], NULL, &one, key != NULL, &scene, &error) != SB_OK ||
        sb_scene_identity(&scene, &identity, &error) != SB_OK)
        fail_msg("%s", error.text);
    unlink(path[1]);
    char *none = NULL;
    assert_int_equal(sb_scene_identity(&scene, &none, &error), SB_BAD_INPUT);
    assert_null(none);
    assert_non_null(strstr(error.text, "heights.asc: cannot read"));
    sb_scene_free(&scene);
    unlink(path[0]);
    unlink(path[2]);
    rmdir(folder);
    return identity;
}

static void test_keys_of_the_identity(void **state)
{
    (void)state;
    static const struct {
        const char *heights, *motion, *key, *value;
        bool same;
    } cases[] = {
        {"1", MOTION, NULL, NULL, true}, /* in another folder */
        {"1 ", MOTION, NULL, NULL, false},
        {"1", MOTION " ", NULL, NULL, false},
        {"1", MOTION, "duration", "7", true},
        {"1", MOTION, "stream.enabled", "true", true},
        {"1", MOTION, "stream.interval", "0.2", true},
        {"1", MOTION, "output.plots", "false", true},
        {"1", MOTION, "output.checkpoint.steps", "5", true},
        {"1", MOTION, "render.video", "false", true},
        {"1", MOTION, "render.interval", "0", true},
        {"1", MOTION, "resolution", "0.05", false},
        {"1", MOTION, "numerics.seed", "2", false},
        {"1", MOTION, "measure.interval", "0.2", false},
        {"1", MOTION, "output.particle_interval", "0.5", false},
        {"1", MOTION, "wavemakers.w.start", "0.01", false},
    };
    char *first = identity_of("1", MOTION, NULL, NULL);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char *other = identity_of(cases[c].heights, cases[c].motion, cases[c].key, cases[c].value);
        if ((strcmp(first, other) == 0) != cases[c].same)
            fail_msg("case %zu (%s) should be %s:\n%s", c, cases[c].key ? cases[c].key : "files",
                     cases[c].same ? "the same" : "another", other);
        sb_free(other);
    }
    assert_non_null(strstr(first, "resolution: 0.1"));
    assert_non_null(strstr(first, "file: \"heights.asc\" # contents "));
    assert_null(strstr(first, "duration:"));
    assert_null(strstr(first, "stream:"));
    sb_free(first);
}

/* Keys that were added later are in the identity only if they change something. */
static void test_later_keys(void **state)
{
    (void)state;
#define SETS(more)                                                                                                     \
    "{gauges: [{name: a, x: 0.3, y: 0.5}, {name: b, x: 0.4, y: 0.5}, {name: c, x: 0.6, y: 0.5}, {name: d, x: 0.9, y: " \
    "0.5}], reflections: [{name: r, gauges: [a, b, c, d], period: 1, depth: 0.5, harmonics: 2" more "}]}"
    char *without = identity_of("1", MOTION, "measure", SETS("")),
         *off = identity_of("1", MOTION, "measure", SETS(", bound: false")),
         *on = identity_of("1", MOTION, "measure", SETS(", bound: true")),
         *sponge = identity_of("1", MOTION, "sponges",
                               "[{name: s, kind: damping, side: x_max, length: 0.5, period: 1, depth: 0.5}]");
    assert_string_equal(without, off);
    assert_null(strstr(without, "bound"));
    assert_non_null(strstr(on, "bound: true"));
    assert_non_null(strstr(sponge, "profile: quadratic"));
    assert_null(strstr(sponge, "damping"));
    sb_free(without);
    sb_free(off);
    sb_free(on);
    sb_free(sponge);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_keys_of_the_identity), cmocka_unit_test(test_later_keys)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A run with foam: its files, pictures that `render` draws again, a run that is resumed, and water that does not feel
   it. */
#include "program.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A column of water that falls against a wall, with a camera of each style. */
static const char scene[] = "title: Foam\n"
                            "resolution: 0.1\n"
                            "duration: 0.7\n"
                            "domain: {min: [0, 0, 0], max: [1.6, 0.8, 1.5]}\n"
                            "water: {boxes: [{min: [0, 0, 0], max: [0.8, 0.8, 1]}]}\n"
                            "foam: {enabled: true, amount: 3}\n"
                            "numerics: {settle_steps: 20}\n"
                            "output: {particle_interval: 0.1, plots: false, checkpoint: {steps: 10}}\n"
                            "render:\n"
                            "  interval: 0.1\n"
                            "  width: 320\n"
                            "  height: 240\n"
                            "  video: false\n"
                            "  cameras:\n"
                            "    - {name: smooth, eye: [2.5, -2, 2], target: [1, 0.4, 0.4]}\n"
                            "    - {name: balls, eye: [2.5, -2, 2], target: [1, 0.4, 0.4], style: particles}\n";

enum { FILES = 8 };
#define SMOOTH "frames/smooth/%06d.png"
#define BALLS "frames/balls/%06d.png"

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    write_text("f.yaml", scene);
    RUN_AND_FORGET(0, "run", "f.yaml", "--out", "on", "--quiet");
    RUN_AND_FORGET(0, "run", "f.yaml", "--out", "off", "--quiet", "--set", "foam.enabled=false");
    return 0;
}

static bool same_file(const char *a, const char *b)
{
    size_t length[2];
    char *bytes[2];
    sb_error error = {0};
    if (sb_file_read(in_folder("%s", a), 1 << 24, &bytes[0], &length[0], &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_file_read(in_folder("%s", b), 1 << 24, &bytes[1], &length[1], &error) != SB_OK) fail_msg("%s", error.text);
    const bool same = length[0] == length[1] && memcmp(bytes[0], bytes[1], length[0]) == 0;
    sb_free(bytes[0]);
    sb_free(bytes[1]);
    return same;
}

/* Compares file number k in two folders; format: of its name. */
static bool same(const char *a, const char *b, const char *format, int k)
{
    char name[64], one[128], two[128];
    snprintf(name, sizeof name, format, k);
    snprintf(one, sizeof one, "%s/%.64s", a, name);
    snprintf(two, sizeof two, "%s/%.64s", b, name);
    return same_file(one, two);
}

/* The number behind the last occurrence of a key in a file. */
static double last_number(const char *file, const char *key)
{
    char *text = text_of(file), mark[64];
    const char *at = text, *last = NULL;
    snprintf(mark, sizeof mark, "\"%s\":", key);
    while ((at = strstr(at, mark))) last = at += strlen(mark);
    const double value = last ? strtod(last, NULL) : (double)NAN;
    sb_free(text);
    return value;
}

static char *last_hash(const char *file)
{
    char *text = text_of(file), *at = text, *last = NULL;
    while ((at = strstr(at, "\"state_hash\":\""))) last = at += 14;
    char *hash = last ? sb_strdup(last) : NULL;
    assert_non_null(hash);
    hash[16] = '\0';
    sb_free(text);
    return hash;
}

static void the_water_is_the_same(void **state)
{
    (void)state;
    char *a = last_hash("on/run.jsonl"), *b = last_hash("off/run.jsonl");
    assert_string_equal(a, b);
    assert_true(same_file("on/energy.csv", "off/energy.csv"));
    sb_free(a);
    sb_free(b);
    const double on = last_number("on/run.jsonl", "foam_spray") + last_number("on/run.jsonl", "foam_floating") +
                      last_number("on/run.jsonl", "foam_bubbles");
    printf("%g particles of foam at the end\n", on);
    assert_true(on > 100);
    char *log = text_of("off/run.jsonl");
    assert_contains(log, "foam: off, no spray, foam and bubbles");
    assert_null(strstr(log, "\"foam_spray\":"));
    sb_free(log);
}

static void files_of_foam_lie_beside_those_of_particles(void **state)
{
    (void)state;
    char *list = text_of("on/foam.pvd");
    assert_contains(list, "file=\"foam/000001.vtp\"");
    assert_contains(list, "file=\"foam/000008.vtp\"");
    sb_free(list);
    assert_true(exists("on/foam/000008.vtp") && !exists("on/foam/000009.vtp"));
    assert_true(exists("on/particles/000008.vtp") && !exists("off/foam") && !exists("off/foam.pvd"));
}

/* Foam is seen, and `render` draws it again; without it, the pictures are those of a run without foam. */
static void render_draws_the_same_pictures(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "render", "on", "--out", "again", "--quiet");
    RUN_AND_FORGET(0, "render", "on", "--out", "bare", "--quiet", "--set", "foam.enabled=false");
    for (int k = 1; k <= FILES; k++) {
        assert_true(same("on", "again", SMOOTH, k) && same("on", "again", BALLS, k));
        assert_true(same("off", "bare", SMOOTH, k) && same("off", "bare", BALLS, k));
    }
    assert_false(same("on", "off", SMOOTH, FILES));
    assert_false(same("on", "off", BALLS, FILES));
    outcome o = RUN(1, "render", "off", "--out", "none", "--set", "foam.enabled=true");
    assert_one_line(o.err, "foam/000001.vtp: does not exist, but the scene has foam; expected the files of a run");
    outcome_free(&o);
}

static void a_resumed_run_continues_it(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "f.yaml", "--out", "two", "--quiet", "--until", "0.44");
    RUN_AND_FORGET(0, "run", "f.yaml", "--out", "two", "--quiet", "--resume");
    for (int k = 1; k <= FILES; k++) assert_true(same("on", "two", "foam/%06d.vtp", k) && same("on", "two", SMOOTH, k));
    assert_true(same_file("on/foam.pvd", "two/foam.pvd"));
    /* A new run removes them. */
    RUN_AND_FORGET(0, "run", "f.yaml", "--out", "two", "--quiet", "--overwrite", "--until", "0.01", "--set",
                   "foam.enabled=false");
    assert_true(!exists("two/foam") && !exists("two/foam.pvd") && exists("two/particles/000001.vtp"));
}

static void bad_values_are_refused(void **state)
{
    (void)state;
    outcome o = RUN(1, "check", "f.yaml", "--set", "foam.most=0");
    assert_one_line(o.err, "foam.most");
    outcome_free(&o);
    o = RUN(1, "check", "f.yaml", "--set", "foam.lifetime=-1");
    assert_one_line(o.err, "foam.lifetime");
    outcome_free(&o);
    o = RUN(1, "check", "f.yaml", "--set", "foam.spray=1");
    assert_one_line(o.err, "foam.spray");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_water_is_the_same),          cmocka_unit_test(files_of_foam_lie_beside_those_of_particles),
        cmocka_unit_test(render_draws_the_same_pictures), cmocka_unit_test(a_resumed_run_continues_it),
        cmocka_unit_test(bad_values_are_refused),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}

/* Checkpoints that are damaged, of another scene or of another build are refused with a message; the previous one is
 * used.
 */
#include "pair.h"

#include "base/archive_layout.h"
#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Replaces the newest checkpoint of "hurt": the previous one is used, with a warning, and the run ends in the same
 * state. */
static void resumes_from_the_previous_one(const char *newest, const char *bytes, size_t length, const char *expected)
{
    put_bytes(newest, bytes, length);
    outcome o = RUN(0, "run", "measured.yaml", "--out", "hurt", "--quiet", "--resume", "--set", EVERY_THREE);
    assert_contains(o.err, "shorebreak: warning: hurt/checkpoints/");
    assert_contains(o.err, expected);
    assert_contains(o.err, "; trying the previous checkpoint");
    outcome_free(&o);
    assert_same_run("sound", "hurt", pair_tables);
}

static void damaged_checkpoints_are_skipped(void **state)
{
    (void)state;
    char names[16][64], newest[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "sound", "--quiet", "--set", EVERY_THREE);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "hurt", "--quiet", "--set", EVERY_THREE);
    assert_int_equal(list_checkpoints("hurt", names), 2);
    snprintf(newest, sizeof newest, "hurt/checkpoints/%s", names[1]);
    size_t length;
    char *bytes = bytes_of(newest, &length);
    resumes_from_the_previous_one(newest, bytes, 0, "has 0 bytes");
    resumes_from_the_previous_one(newest, bytes, length / 2, "truncated");
    resumes_from_the_previous_one(newest, bytes, length - 1, "truncated");
    bytes[length / 2] ^= 4;
    resumes_from_the_previous_one(newest, bytes, length, "damaged: the checksum of section");
    bytes[length / 2] ^= 4;
    bytes[8] ^= 1;
    resumes_from_the_previous_one(newest, bytes, length, "version 18 of the format, expected 19");
    sb_free(bytes);
}

/* A checkpoint that is cut off at the start of any of its sections is refused. */
static void truncated_checkpoints_are_refused(void **state)
{
    (void)state;
    char names[16][64], newest[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "ends", "--quiet", "--until", "0.05", "--set",
                   "output.checkpoint={steps: 1000, minutes: 0}");
    assert_int_equal(list_checkpoints("ends", names), 1);
    snprintf(newest, sizeof newest, "ends/checkpoints/%s", names[0]);
    size_t length, sections = 0;
    char *bytes = bytes_of(newest, &length), *before = text_of("ends/forces.csv");
    for (size_t at = 16; at < length; sections++) {
        uint64_t size;
        put_bytes(newest, bytes, at);
        outcome o = RUN(1, "run", "measured.yaml", "--out", "ends", "--quiet", "--resume");
        assert_one_line(o.err, "no checkpoint to resume from: ends/checkpoints/");
        assert_contains(o.err, "truncated");
        outcome_free(&o);
        memcpy(&size, bytes + at + 8, sizeof size);
        at += 24 + size;
    }
    assert_int_equal(sections, 5); /* scene, run, sim, measure, end */
    assert_same_file("ends", "ends", "forces.csv");
    char *after = text_of("ends/forces.csv");
    assert_string_equal(before, after);
    sb_free(before);
    sb_free(after);
    sb_free(bytes);
}

static void other_scenes_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *set, *expected;
    } cases[] = {
        {"resolution=0.04",
         "of another scene: it has \"resolution: 0.05 # m\" where this scene has \"resolution: 0.04"},
        {"measure.interval=0.05", "\"interval: 0.03"},
        {"bodies.step.max=[1.81, 0.2]", "\"max: [1.8"},
        {"numerics.seed=2", "\"seed: 1\" where this scene has \"seed: 2\""},
    };
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "other", "--quiet", "--until", "0.1");
    char *scene = text_of("other/scene.yaml"), *forces = text_of("other/forces.csv");
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        outcome o = RUN(1, "run", "measured.yaml", "--out", "other", "--quiet", "--resume", "--set", cases[c].set);
        assert_one_line(o.err, "no checkpoint to resume from: other/checkpoints/");
        assert_contains(o.err, cases[c].expected);
        outcome_free(&o);
    }
    char *scene_now = text_of("other/scene.yaml"), *forces_now = text_of("other/forces.csv");
    assert_string_equal(scene, scene_now);
    assert_string_equal(forces, forces_now);
    sb_free(scene);
    sb_free(scene_now);
    sb_free(forces);
    sb_free(forces_now);
    /* A run whose table was shortened cannot be resumed. */
    assert_int_equal(truncate(in_folder("other/gauges.csv"), 30), 0);
    outcome o = RUN(1, "run", "measured.yaml", "--out", "other", "--quiet", "--resume", "--until", "0.2");
    assert_contains(o.err, "other/gauges.csv: has 30 bytes, expected the ");
    outcome_free(&o);
}

/* A table with other line ends, as some editors write them, would end within a row if it were cut at its recorded
 * length.
 */
static void an_edited_table_is_refused(void **state)
{
    (void)state;
    char command[1200];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "edited", "--quiet", "--until", "0.1");
    char *scene = text_of("edited/scene.yaml"), *forces = text_of("edited/forces.csv");
    snprintf(command, sizeof command, "sed -i 's/$/\\r/' '%s'", in_folder("edited/forces.csv"));
    assert_int_equal(system(command), 0);
    char *torn = text_of("edited/forces.csv");
    outcome o = RUN(1, "run", "measured.yaml", "--out", "edited", "--quiet", "--resume", "--until", "0.2");
    assert_one_line(o.err, "edited/forces.csv: was changed since the run wrote it, expected its first ");
    outcome_free(&o);
    char *scene_now = text_of("edited/scene.yaml"), *forces_now = text_of("edited/forces.csv");
    assert_string_equal(scene, scene_now);
    assert_string_equal(torn, forces_now);
    write_text("edited/forces.csv", forces); /* the original */
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "edited", "--quiet", "--resume", "--until", "0.2");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "unread", "--quiet", "--until", "0.2");
    assert_same_run("unread", "edited", pair_tables);
    sb_free(scene);
    sb_free(scene_now);
    sb_free(forces);
    sb_free(forces_now);
    sb_free(torn);
}

/* Changes the first digit of the hash of the sources in a checkpoint, and corrects the checksum of the section. */
static void change_build(char *bytes, size_t length)
{
    static const char expected[] = "sources ";
    uint64_t section;
    char *at = memmem(bytes, length, expected, sizeof expected - 1);
    assert_non_null(at);
    at += sizeof expected - 1;
    *at = *at == '0' ? '1' : '0';
    unsigned char *head = (unsigned char *)bytes + SB_ARCHIVE_HEAD;
    memcpy(&section, head + SB_ARCHIVE_NAME, sizeof section);
    assert_true((size_t)(at - bytes) < SB_ARCHIVE_HEAD + SB_SECTION_HEAD + section);
    const uint64_t sum = sb_archive_sum(head, section);
    memcpy(head + SB_ARCHIVE_NAME + sizeof section, &sum, sizeof sum);
}

/* A checkpoint of another build is refused, with the names of both builds, unless --other-build is given. Here the two
   builds compute the same numbers. */
static void other_builds_are_refused(void **state)
{
    (void)state;
    char names[16][64], newest[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "whole", "--quiet", "--until", "0.2");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "built", "--quiet", "--until", "0.1");
    assert_int_equal(list_checkpoints("built", names), 1);
    snprintf(newest, sizeof newest, "built/checkpoints/%s", names[0]);
    size_t length;
    char *bytes = bytes_of(newest, &length);
    change_build(bytes, length);
    put_bytes(newest, bytes, length);
    sb_free(bytes);
    outcome o = RUN(1, "run", "measured.yaml", "--out", "built", "--quiet", "--until", "0.2", "--resume");
    assert_one_line(o.err, "written by a build with other numerics (sources ");
    assert_contains(o.err, "this build has (sources ");
    assert_contains(o.err, "--other-build");
    outcome_free(&o);
    o = RUN(0, "run", "measured.yaml", "--out", "built", "--quiet", "--until", "0.2", "--resume", "--other-build");
    assert_contains(o.err, "warning: built/checkpoints/");
    assert_contains(o.err, "no longer bit for bit");
    outcome_free(&o);
    assert_same_run("whole", "built", pair_tables);
    RUN_AND_FORGET(1, "run", "measured.yaml", "--out", "built", "--other-build");
}

/* Generates numerics.c for a source tree with this step.c and this flux.c; returns its text. */
static char *numerics_of(const char *step, const char *flux)
{
    write_text("tree/src/sim/step/step.c", step);
    write_text("tree/src/offshore/flux.c", flux);
    char command[1024];
    snprintf(command, sizeof command,
             "cmake -D ROOT=%s -D OUT=%s -D 'HOW=GNU 1.2 \"-O3\"' -P " SB_SOURCE_DIR "/cmake/numerics.cmake",
             in_folder("tree"), in_folder("numerics.c"));
    assert_int_equal(system(command), 0);
    return text_of("numerics.c");
}

static void a_changed_source_is_another_build(void **state)
{
    (void)state;
    static const char *const folders[] = {"tree/src/sim/step", "tree/src/offshore", "tree/src/base"};
    static const char *const base[] = {"vec.h", "random.h", "exact.h", "exact.c", "sets.h", "multiversion.h"};
    for (int f = 0; f < 3; f++) assert_int_equal(sb_make_directories(in_folder("%s", folders[f]), NULL), SB_OK);
    for (size_t k = 0; k < sizeof base / sizeof *base; k++) {
        char path[64];
        snprintf(path, sizeof path, "tree/src/base/%s", base[k]);
        write_text(path, "");
    }
    char *one = numerics_of("x = 1;", ""), *other = numerics_of("x = 2;", ""), *again = numerics_of("x = 1;", "");
    char *grid = numerics_of("x = 1;", "y = 1;");
    assert_contains(one, ", GNU 1.2 -O3\";");
    assert_string_not_equal(one, other);
    assert_string_not_equal(one, grid);
    assert_string_equal(one, again);
    sb_free(one);
    sb_free(other);
    sb_free(again);
    sb_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_checkpoints_are_skipped), cmocka_unit_test(truncated_checkpoints_are_refused),
        cmocka_unit_test(an_edited_table_is_refused),      cmocka_unit_test(other_scenes_are_refused),
        cmocka_unit_test(other_builds_are_refused),        cmocka_unit_test(a_changed_source_is_another_build),
    };
    return cmocka_run_group_tests(tests, pair_setup, program_teardown);
}

/* Meshes of the water from the particle files of a run. */
#include "program.h"

#include "base/memory.h"
#include "surface/mesh_format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r", "--quiet", "--set", "render.interval=0");
    return 0;
}

static void read_bytes(const char *name, char **bytes, size_t *length)
{
    FILE *file = fopen(in_folder("%s", name), "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    *bytes = sb_alloc(*length + 1, 1);
    assert_int_equal(fread(*bytes, 1, *length, file), *length);
    fclose(file);
}

static void assert_same_file(const char *one, const char *other, bool same)
{
    char *bytes[2];
    size_t lengths[2];
    read_bytes(one, &bytes[0], &lengths[0]);
    read_bytes(other, &bytes[1], &lengths[1]);
    assert_int_equal(lengths[0] == lengths[1] && memcmp(bytes[0], bytes[1], lengths[0]) == 0, same);
    sb_free(bytes[0]);
    sb_free(bytes[1]);
}

static size_t number_after(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    assert_non_null(at);
    return strtoul(at + strlen(key), NULL, 10);
}

/* The header counts what follows it: 52 bytes per vertex, 13 per triangle. */
static void ply_files(void **state)
{
    (void)state;
    outcome o = RUN(0, "surface", "r", "--threads", "1");
    assert_contains(o.out, "mesh 4 of 4");
    assert_contains(o.out, "s left");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    for (int i = 1; i <= 4; i++) {
        char *bytes, name[64];
        size_t length;
        snprintf(name, sizeof name, "r/surface/%06d.ply", i);
        read_bytes(name, &bytes, &length);
        const char *body = strstr(bytes, "end_header\n");
        assert_non_null(body);
        const size_t vertices = number_after(bytes, "element vertex "), faces = number_after(bytes, "element face ");
        assert_true(vertices > 100 && faces > 100);
        assert_int_equal(length, (size_t)(body - bytes) + strlen("end_header\n") + 52 * vertices + 13 * faces);
        sb_free(bytes);
    }
}

static void vtp_files_and_their_list(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "surface", "r", "--format", "vtp", "--out", "v", "--quiet", "--times", "0,0.15:1");
    char *list = text_of("v/surface.pvd");
    assert_contains(list, "000001.vtp");
    assert_contains(list, "000003.vtp");
    assert_null(strstr(list, "000002.vtp"));
    sb_free(list);
    char *bytes;
    size_t length;
    read_bytes("v/000003.vtp", &bytes, &length);
    assert_contains(bytes, "NumberOfPolys=");
    assert_int_equal(memcmp(bytes + length - strlen("\n</AppendedData>\n</VTKFile>\n"),
                            "\n</AppendedData>\n</VTKFile>\n", strlen("\n</AppendedData>\n</VTKFile>\n")),
                     0);
    sb_free(bytes);
}

static void any_number_of_threads(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "one", "--threads", "1");
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "two", "--threads", "2");
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "rough", "--smooth", "0");
    assert_same_file("one/000004.ply", "two/000004.ply", true);
    assert_same_file("one/000004.ply", "rough/000004.ply", false);
}

static void complete_meshes_are_kept(void **state)
{
    (void)state;
    struct stat before, after;
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "k");
    assert_int_equal(stat(in_folder("k/000001.ply"), &before), 0);
    assert_int_equal(remove(in_folder("k/000002.ply")), 0);
    outcome o = RUN(0, "surface", "r", "--out", "k");
    assert_contains(o.out, "3 complete meshes are kept");
    assert_contains(o.out, "mesh 1 of 1");
    outcome_free(&o);
    assert_int_equal(stat(in_folder("k/000001.ply"), &after), 0);
    assert_int_equal(before.st_ino, after.st_ino);
    o = RUN(1, "surface", "r", "--out", "k", "--cell", "0.7");
    assert_one_line(o.err, "k/000001.ply: was made with other options, by another version or from another run; "
                           "expected --overwrite");
    outcome_free(&o);
    o = RUN(0, "surface", "r", "--out", "k", "--cell", "0.7", "--overwrite");
    assert_contains(o.out, "mesh 4 of 4");
    outcome_free(&o);
}

/* Meshes of earlier versions, whose first lines name no method, are neither kept nor replaced without being asked. */
static void meshes_of_earlier_methods_are_not_kept(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "e");
    char *made = text_of("e/000001.ply"), *method = strstr(made, SB_MESH_METHOD ", ");
    assert_non_null(method);
    memmove(method, method + strlen(SB_MESH_METHOD ", "), strlen(method + strlen(SB_MESH_METHOD ", ")) + 1);
    write_text("e/000001.ply", made);
    sb_free(made);
    outcome o = RUN(1, "surface", "r", "--out", "e");
    assert_one_line(o.err, "e/000001.ply: was made with other options, by another version");
    outcome_free(&o);
    o = RUN(0, "surface", "r", "--out", "e", "--overwrite");
    assert_contains(o.out, "mesh 4 of 4");
    outcome_free(&o);
}

static void other_files_are_not_overwritten(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "surface", "r", "--quiet", "--out", "o", "--times", "0");
    write_text("o/000002.ply", "a model of mine\n");
    outcome o = RUN(1, "surface", "r", "--out", "o", "--overwrite");
    assert_one_line(o.err, "o/000002.ply: was not written by shorebreak surface");
    outcome_free(&o);
    char *text = text_of("o/000002.ply");
    assert_string_equal(text, "a model of mine\n");
    sb_free(text);
}

static void refuse(const char *expected, const char *const *arguments)
{
    outcome o = program_expect(1, arguments);
    assert_one_line(o.err, expected);
    outcome_free(&o);
}

static void bad_input(void **state)
{
    (void)state;
#define REFUSE(expected, ...) refuse(expected, (const char *const[]){"surface", __VA_ARGS__, NULL})
    REFUSE("--cell 2: expected 0.25 to 1", "r", "--cell", "2");
    REFUSE("--smooth -1: expected 0 to 1000", "r", "--smooth", "-1");
    REFUSE("--format obj: expected ply or vtp", "r", "--format", "obj");
    REFUSE("--times 1:x: expected seconds", "r", "--times", "1:x");
    REFUSE("--times 3:2: expected seconds", "r", "--times", "3:2");
    REFUSE("--times 50: the particle files are from 0 s", "r", "--times", "50");
    REFUSE("--times 0.01:0.02: no particle file", "r", "--times", "0.01:0.02");
    REFUSE("none/scene.yaml", "none");
    REFUSE("--camera", "r", "--camera", "side");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "flat", "--quiet", "--until", "0.02");
    REFUSE("flat: is a run in two dimensions", "flat");
    assert_false(exists("flat/surface"));
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "bare", "--quiet", "--until", "0.02", "--set",
                   "output.particle_interval=0");
    REFUSE("bare: the run has no particle files; expected one with output.particle_interval", "bare");
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "cut", "--quiet", "--until", "0.02", "--set", "render.interval=0");
    write_text("cut/particles/000001.vtp", "<?xml version=\"1.0\"?>\n");
    REFUSE("cut/particles/000001.vtp", "cut");
    assert_false(exists("cut/surface/000001.ply"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ply_files),
        cmocka_unit_test(vtp_files_and_their_list),
        cmocka_unit_test(any_number_of_threads),
        cmocka_unit_test(complete_meshes_are_kept),
        cmocka_unit_test(meshes_of_earlier_methods_are_not_kept),
        cmocka_unit_test(other_files_are_not_overwritten),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}

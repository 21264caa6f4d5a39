/* Tests the import of small files of every mesh format, of broken files, and of files with random damage. */
#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/random.h"
#include "geometry/mesh/child.h"
#include "geometry/mesh/mesh.h"
#include "mesh_samples.h"

#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static sb_error error;
static char folder[] = "/tmp/shorebreak-mesh-XXXXXX";

static const char *path_of(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static const char *save(const char *name, const sample_text *text)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text->bytes, 1, text->length, file), text->length);
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *save_text(const char *name, const char *text)
{
    sample_text whole = {.length = strlen(text)};
    assert_true(whole.length < sizeof whole.bytes);
    memcpy(whole.bytes, text, whole.length);
    return save(name, &whole);
}

/* Expects a watertight cube with the given corner and volume. */
static void check_cube(const sb_mesh *mesh, sb_vec3 min, double volume)
{
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(mesh, &report, NULL), SB_OK);
    assert_int_equal(mesh->vertex_count, 8);
    assert_int_equal(mesh->triangle_count, 12);
    assert_true(report.watertight);
    assert_true(fabs(report.volume - volume) < 1e-5);
    assert_true(sb_norm(sb_sub(report.min, min)) < 1e-5);
}

static void test_every_format(void **state)
{
    (void)state;
    for (size_t i = 0; i < SAMPLE_FORMATS; ++i) {
        sample_text text = {.length = 0};
        sample_formats[i].make(&text);
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(save(sample_formats[i].name, &text), &meshes, &count, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_int_equal(count, sample_formats[i].mesh_count);
        bool dae = strstr(sample_formats[i].name, ".dae"), gltf = strstr(sample_formats[i].name, ".gl");
        check_cube(&meshes[0], sb_vec(0, 0, dae ? 7 : 0), 8);
        if (count > 1) check_cube(&meshes[1], gltf ? sb_vec(10, 0, -6) : sb_vec(5, 0, 0), gltf ? 24 : 8);
        if (dae || gltf || strstr(sample_formats[i].name, ".obj")) assert_string_equal(meshes[0].name, "first");
        if (gltf) assert_string_equal(meshes[1].name, "second__mirrored");
        sample_free(meshes, count);
    }
}

/* The up axis of a DAE does not change its coordinates. Its unit converts them to metres. */
static void test_dae_axes_and_unit(void **state)
{
    (void)state;
    static const char *const axes[] = {"X_UP", "Y_UP", "Z_UP"};
    for (int i = 0; i < 3; ++i) {
        sample_text text = {.length = 0};
        sample_make_dae(&text);
        memcpy(strstr(text.bytes, "Z_UP"), axes[i], 4);
        char *unit = strstr(text.bytes, "meter=\"1\"");
        memcpy(unit, "meter=\"4\"", 9);
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(save("unit.dae", &text), &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
        check_cube(&meshes[0], sb_vec(0, 0, 28), 512);
        sample_free(meshes, count);
    }
}

static void expect_refusal(const char *path, const char *why)
{
    sb_mesh *meshes = NULL;
    size_t count = 99;
    const sb_mesh_limits limits = {.memory = 1u << 28, .seconds = 1};
    error.text[0] = '\0';
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &count, &error);
    if (status != SB_BAD_INPUT) fail_msg("%s: status %d, expected a refusal (%s)", path, status, error.text);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why) || strchr(error.text, '\n'))
        fail_msg("\"%s\" should be one line, begin with the path and say \"%s\"", error.text, why);
    assert_null(meshes);
    assert_int_equal(count, 99);
}

static void test_broken_files(void **state)
{
    (void)state;
    expect_refusal("/nonexistent/cube.obj", "No such file");
    assert_int_equal(mkdir(path_of("folder.obj"), 0700), 0);
    expect_refusal(path_of("folder.obj"), "is a directory");
    assert_int_equal(mkfifo(path_of("pipe.obj"), 0600), 0);
    expect_refusal(path_of("pipe.obj"), "is a FIFO");
    expect_refusal(save_text("empty.obj", ""), "is empty");
    expect_refusal(save_text("notes.txt", "hello"), "unknown format");
    expect_refusal(save_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "");
    expect_refusal(save_text("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "finite");
    expect_refusal(save_text("nan.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                        "property float y\nproperty float z\nelement face 1\n"
                                        "property list uchar int vertex_indices\nend_header\n"
                                        "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"),
                   "");
    expect_refusal(save_text("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "");
    expect_refusal(save_text("index.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                          "property float y\nproperty float z\nelement face 1\n"
                                          "property list uchar int vertex_indices\nend_header\n"
                                          "0 0 0\n1 0 0\n0 1 0\n3 0 1 77\n"),
                   "");
    expect_refusal(save_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "no triangles");
    expect_refusal(save_text("header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), "");
    expect_refusal(save_text("huge.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                         "property float x\nproperty float y\nproperty float z\n"
                                         "element face 4000000000\nproperty list uchar int "
                                         "vertex_indices\nend_header\n0 0 0\n"),
                   "");
    sample_text huge = {.length = 0};
    sample_make_stl_binary(&huge);
    memset(huge.bytes + 80, 0xff, 4);
    expect_refusal(save("huge.stl", &huge), "");
}

static void test_cut_and_garbage(void **state)
{
    (void)state;
    for (size_t i = 0; i < SAMPLE_FORMATS; ++i) {
        char name[64];
        sample_text text = {.length = 0}, garbage = {.length = 600};
        sample_formats[i].make(&text);
        /* Enough bytes are left to recognise the format, but not for one triangle. */
        text.length = text.length / 20;
        snprintf(name, sizeof name, "cut-%s", sample_formats[i].name);
        expect_refusal(save(name, &text), "");
        for (size_t j = 0; j < garbage.length; ++j) garbage.bytes[j] = (char)(256 * sb_random(i + 1, j));
        snprintf(name, sizeof name, "garbage-%s", sample_formats[i].name);
        expect_refusal(save(name, &garbage), "");
    }
}

static void test_degenerate_triangles_are_counted(void **state)
{
    (void)state;
    const char *path = save_text("slivers.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 0\n"
                                                "f 1 2 3\nf 1 2 4\nf 1 2 5\n");
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, 1);
    assert_int_equal(meshes[0].triangle_count, 1);
    assert_int_equal(meshes[0].vertex_count, 3);
    assert_int_equal(meshes[0].dropped, 2);
    assert_string_equal(meshes[0].name, "");
    sample_free(meshes, count);
}

/* Changes up to eight bytes of one format's file and imports it. */
static sample_outcome read_damaged(size_t which, uint64_t round)
{
    const sb_mesh_limits limits = {.memory = 1u << 28, .seconds = 1};
    const uint64_t seed = 1000 * which + round;
    char path[512];
    sample_text text = {.length = 0};
    sample_formats[which].make(&text);
    for (uint64_t j = 0; j < 1 + round % 8; ++j) {
        size_t at = (size_t)(sb_random(seed, 2 * j) * (double)text.length);
        text.bytes[at] = (char)(256 * sb_random(seed, 2 * j + 1));
    }
    snprintf(path, sizeof path, "%s/%d-%s", folder, (int)round, sample_formats[which].name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(text.bytes, 1, text.length, file) != text.length || fclose(file) != 0) return SAMPLE_WRONG;
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_error why = {0};
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &count, &why);
    sample_outcome result = sample_judge(path, status, meshes, count, &why);
    if (result == SAMPLE_WRONG) print_message("%s: status %d, %zu meshes, %s\n", path, status, count, why.text);
    return result;
}

/* A damaged file must give a valid mesh or a message of one line, within the limits. */
static void test_random_damage(void **state)
{
    (void)state;
    enum { ROUNDS = 44 };
    int results[3] = {0};
    double begin = sb_clock();
#pragma omp parallel for schedule(dynamic) num_threads(3)
    for (size_t i = 0; i < SAMPLE_FORMATS * ROUNDS; ++i) {
        sample_outcome result = read_damaged(i % SAMPLE_FORMATS, i / SAMPLE_FORMATS);
#pragma omp atomic
        ++results[result];
    }
    double took = sb_clock() - begin;
    print_message("%d damaged files: %d read, %d refused, %.1f s\n", SAMPLE_FORMATS * ROUNDS, results[SAMPLE_SOUND],
                  results[SAMPLE_REFUSED], took);
    assert_int_equal(results[SAMPLE_WRONG], 0);
    assert_true(results[SAMPLE_SOUND] + results[SAMPLE_REFUSED] >= 300);
    assert_true(results[SAMPLE_SOUND] > 20 && results[SAMPLE_REFUSED] > 20);
}

static void test_invalid_names_are_replaced(void **state)
{
    (void)state;
    const char *path = save_text("names.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a,b\\c\nf 1 2 3\n"
                                              "o caf\xc3\xa9\nf 1 2 3\no bad\xff\nf 1 2 3\no "
                                              "0123456789012345678901234567890123456789"
                                              "0123456789012345678901\xc3\xa9\nf 1 2 3\n");
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, 4);
    assert_string_equal(meshes[0].name, "a_b_c");
    assert_string_equal(meshes[1].name, "caf_");
    assert_string_equal(meshes[1].original, "caf\xc3\xa9");
    assert_string_equal(meshes[2].name, "bad_");
    assert_string_equal(meshes[3].name, "01234567890123456789012345678901234567890123456789012345678901");
    sample_free(meshes, count);
}

static volatile sig_atomic_t children_ended;

static void count_children(int number)
{
    (void)number;
    ++children_ended;
}

static void reap_all(int number)
{
    (void)number;
    ++children_ended;
    while (waitpid(-1, NULL, WNOHANG) > 0) continue;
}

/* The calling program may ignore ended children, collect them itself, or be interrupted by their signals. */
static void test_signals_and_threads(void **state)
{
    (void)state;
    sample_text text = {.length = 0};
    sample_make_obj(&text);
    char path[512];
    snprintf(path, sizeof path, "%s", save("signals.obj", &text));
    void (*const handlers[])(int) = {SIG_IGN, count_children, reap_all, SIG_DFL};
    for (size_t i = 0; i < 4; ++i) {
        struct sigaction action = {.sa_handler = handlers[i]};
        sigaction(SIGCHLD, &action, NULL);
        for (int repeat = 0; repeat < 3; ++repeat) {
            sb_mesh *meshes;
            size_t count;
            if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
            assert_int_equal(count, 2);
            sample_free(meshes, count);
        }
        expect_refusal(save_text("bad.obj", "nothing"), "");
    }
    assert_true(children_ended > 0);
    int good = 0;
#pragma omp parallel for num_threads(3) reduction(+ : good)
    for (int i = 0; i < 12; ++i) {
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(path, &meshes, &count, NULL) == SB_OK) {
            good += count == 2;
            sample_free(meshes, count);
        }
    }
    assert_int_equal(good, 12);
}

static size_t open_files(void)
{
    size_t count = 0;
    DIR *listing = opendir("/proc/self/fd");
    assert_non_null(listing);
    while (readdir(listing)) ++count;
    closedir(listing);
    return count;
}

static void test_nothing_is_left_behind(void **state)
{
    (void)state;
    sample_text text = {.length = 0};
    sample_make_obj(&text);
    const char *path = save("left.obj", &text);
    size_t before = open_files();
    for (int i = 0; i < 5; ++i) {
        sb_mesh *meshes;
        size_t count;
        assert_int_equal(sb_mesh_import(path, &meshes, &count, &error), SB_OK);
        sample_free(meshes, count);
    }
    expect_refusal(save_text("bad.ply", "ply\nnothing"), "");
    assert_int_equal(open_files(), before);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    /* Without memory the failure is reported and nothing leaks (the sanitizer checks that). */
    int failures = 0;
    for (long n = 1; n < 12; ++n) {
        sb_mesh *meshes = NULL;
        size_t count = 0;
        sb_memory_fail_at(n);
        sb_status status = sb_mesh_import(path_of("left.obj"), &meshes, &count, &error);
        sb_memory_fail_at(0);
        failures += status != SB_OK;
        if (status == SB_OK) sample_free(meshes, count);
    }
    assert_true(failures > 3);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    DIR *listing = opendir(folder);
    for (struct dirent *entry; listing && (entry = readdir(listing));)
        if (entry->d_name[0] != '.') remove(path_of(entry->d_name));
    if (listing) closedir(listing);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_format),
        cmocka_unit_test(test_dae_axes_and_unit),
        cmocka_unit_test(test_broken_files),
        cmocka_unit_test(test_cut_and_garbage),
        cmocka_unit_test(test_degenerate_triangles_are_counted),
        cmocka_unit_test(test_random_damage),
        cmocka_unit_test(test_invalid_names_are_replaced),
        cmocka_unit_test(test_signals_and_threads),
        cmocka_unit_test(test_nothing_is_left_behind),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}

/* Tests analytic shapes, and bodies of a scene as meshes in the scene's axes. */
#include "base/memory.h"
#include "geometry/mesh/mesh.h"
#include "geometry/model/model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static sb_error error;

static sb_mesh_report diagnose(const sb_mesh *mesh)
{
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(mesh, &report, NULL), SB_OK);
    return report;
}

static bool near(sb_vec3 a, sb_vec3 b)
{
    return sb_norm(sb_sub(a, b)) < 1e-9;
}

static void test_shapes(void **state)
{
    (void)state;
    sb_mesh mesh;
    assert_int_equal(sb_mesh_box(sb_vec(1, 2, 3), sb_vec(2, 4, 6), &mesh, &error), SB_OK);
    sb_mesh_report report = diagnose(&mesh);
    assert_true(report.watertight && fabs(report.volume - 6) < 1e-12);
    sb_mesh_free(&mesh);

    const double radius = 5, height = 3, tolerance = 0.01;
    assert_int_equal(sb_mesh_cylinder(sb_vec(1, 1, -1), radius, height, tolerance, &mesh, &error), SB_OK);
    report = diagnose(&mesh);
    assert_true(report.watertight);
    assert_true(near(report.min, sb_vec(-4, -4, -1)) && near(report.max, sb_vec(6, 6, 2)));
    double n = (double)mesh.triangle_count / 4;
    assert_true(radius * (1 - cos(M_PI / n)) <= tolerance);
    assert_true(radius * (1 - cos(M_PI / (n - 5))) > tolerance);
    assert_true(fabs(report.volume - n / 2 * radius * radius * sin(2 * M_PI / n) * height) < 1e-9);
    sb_mesh_free(&mesh);

    assert_int_equal(sb_mesh_plane(sb_vec(1, 2, 3), sb_vec(0, -2, 0), 8, 3, &mesh, &error), SB_OK);
    report = diagnose(&mesh);
    assert_true(near(report.min, sb_vec(-3, 2, 1.5)) && near(report.max, sb_vec(5, 2, 4.5)));
    assert_int_equal(report.open_edges, 4);
    const uint32_t *t = mesh.triangles[0];
    sb_vec3 normal =
        sb_cross(sb_sub(mesh.vertices[t[1]], mesh.vertices[t[0]]), sb_sub(mesh.vertices[t[2]], mesh.vertices[t[0]]));
    assert_true(near(sb_normalize(normal), sb_vec(0, -1, 0)));
    sb_mesh_free(&mesh);

    /* A basin's normals point into the tank. The volume of its walls is negative, and its lid is missing. */
    assert_int_equal(sb_mesh_basin(sb_vec(0, 0, 0), sb_vec(2, 3, 4), &mesh, &error), SB_OK);
    report = diagnose(&mesh);
    assert_int_equal(report.open_edges, 4);
    assert_int_equal(report.flipped_faces, 0);
    assert_true(fabs(report.area - 46) < 1e-12 && report.volume < 0);
    assert_true(mesh.open_surface);
    sb_mesh_free(&mesh);
}

static void test_bad_shapes(void **state)
{
    (void)state;
    sb_mesh mesh = {.vertex_count = 77};
    sb_vec3 zero = {0};
    assert_int_equal(sb_mesh_box(zero, sb_vec(1, 0, 1), &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_basin(zero, sb_vec(1, (double)NAN, 1), &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_cylinder(zero, 0, 1, 0.1, &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_cylinder(zero, 1, 1, 0, &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_plane(zero, zero, 1, 1, &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_plane(zero, sb_vec(0, 0, 1), 1, -1, &mesh, &error), SB_BAD_INPUT);
    assert_int_equal(mesh.vertex_count, 77);
}

static sb_mesh *from_body(const sb_body *body, size_t expected)
{
    sb_mesh *meshes = NULL;
    size_t count = 0;
    if (sb_mesh_from_body(body, 0.5, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, expected);
    return meshes;
}

static void free_all(sb_mesh *meshes, size_t count)
{
    for (size_t i = 0; i < count; ++i) sb_mesh_free(&meshes[i]);
    sb_free(meshes);
}

static void test_rotation_order(void **state)
{
    (void)state;
    /* x then y then z: (1, 0, 0) is unchanged, then goes to -z, and is unchanged. */
    sb_body body = {.name = "rod",
                    .shape = SB_SHAPE_BOX,
                    .min = {1, 2, 3},
                    .max = {2, 4, 6},
                    .rotate = {90, 90, 0},
                    .translate = {100, 0, 0}};
    sb_mesh *meshes = from_body(&body, 1);
    sb_mesh_report report = diagnose(meshes);
    /* (x, y, z) -> (x, -z, y) -> (y, -z, -x), exactly, because the angles are quarter turns. */
    assert_true(near(report.min, sb_vec(102, -6, -2)) && near(report.max, sb_vec(104, -3, -1)));
    assert_true(meshes[0].vertices[0].x == 102 && meshes[0].vertices[0].z == -1);
    assert_true(fabs(report.volume - 6) < 1e-12);
    assert_string_equal(meshes[0].name, "rod");
    free_all(meshes, 1);
    body.rotate = sb_vec(0, 0, 30);
    body.translate = sb_vec(0, 0, 0);
    meshes = from_body(&body, 1);
    assert_true(
        near(meshes[0].vertices[0], sb_vec(cos(M_PI / 6) - 2 * sin(M_PI / 6), sin(M_PI / 6) + 2 * cos(M_PI / 6), 3)));
    free_all(meshes, 1);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void test_mesh_file_body(void **state)
{
    (void)state;
    char path[] = "/tmp/shorebreak-body-XXXXXX.obj";
    int made = mkstemps(path, 4);
    assert_true(made >= 0);
    close(made);
    /* Two tetrahedra with the same name in a y-up file in centimetres; the second is inside out. */
    write_file(path, "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\n"
                     "o tower\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
                     "v 300 0 0\nv 400 0 0\nv 300 100 0\nv 300 0 100\n"
                     "o tower/top\nf 5 6 7\nf 5 8 6\nf 5 7 8\nf 6 8 7\n");
    sb_body body = {
        .name = "plant", .shape = SB_SHAPE_MESH, .file = path, .up = 'y', .scale = 0.01, .translate = {0, 10, 0}};
    sb_mesh *meshes = from_body(&body, 1);
    sb_mesh_report report = diagnose(meshes);
    assert_string_equal(meshes[0].name, "plant");
    assert_int_equal(meshes[0].triangle_count, 8);
    assert_true(near(report.min, sb_vec(0, 9, 0)) && near(report.max, sb_vec(4, 10, 1)));
    assert_true(report.watertight && fabs(report.volume - 2.0 / 6) < 1e-7);
    assert_int_equal(meshes[0].turned, 4);
    free_all(meshes, 1);

    body.split = true;
    meshes = from_body(&body, 2);
    assert_string_equal(meshes[0].name, "tower");
    assert_string_equal(meshes[1].name, "tower_top");
    for (int i = 0; i < 2; ++i) assert_true(fabs(diagnose(&meshes[i]).volume - 1.0 / 6) < 1e-7);
    assert_int_equal(meshes[0].turned, 0);
    assert_int_equal(meshes[1].turned, 4);
    free_all(meshes, 2);

    write_file(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\no a,b\nf 1 2 3\no a/b\nf 1 2 3\n");
    meshes = from_body(&body, 2);
    assert_string_equal(meshes[0].name, "a_b");
    assert_string_equal(meshes[1].name, "a_b-2");
    free_all(meshes, 2);
    write_file(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\no bolt-3\nf 1 2 3\no a,b\nf 1 2 3\no a/b\nf 1 2 3\no a'b\nf 1 2 3\no "
                     "bolt/3\nf 1 2 3\n");
    meshes = from_body(&body, 5);
    static const char *const names[] = {"bolt-3", "a_b", "a_b-2", "a_b-3", "bolt_3"};
    for (int i = 0; i < 5; i++) assert_string_equal(meshes[i].name, names[i]);
    free_all(meshes, 5);

    sb_mesh *none = NULL;
    size_t count = 0;
    body.scale = 0;
    assert_int_equal(sb_mesh_from_body(&body, 1, &none, &count, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "plant"));
    body.scale = 1;
    write_file(path, "nothing here\n");
    assert_int_equal(sb_mesh_from_body(&body, 1, &none, &count, &error), SB_BAD_INPUT);
    assert_true(strncmp(error.text, "body \"plant\": /tmp/", 19) == 0);
    assert_null(none);
    remove(path);
}

/* A name of the file keeps its part, even if another part's replaced name is the same and comes first. */
static void test_part_names(void **state)
{
    (void)state;
    static const struct {
        const char *original, *name;
    } cases[] = {
        {"..", "_."},
        {"=cmd|x", "_cmd_x"},
        {"`id`", "_id_"},
        {"-rf", "_rf"},
        {"\xe2\x80\xaetxt.b", "_txt.b"},
        {"a,b", "a_b-2"},
        {"", "a_b"},
        {"a;b", "a_b-3"},
        {"\x1b[31m", "__31m"},
        {"\"quoted\"", "_quoted_"},
        {"two words", "two_words"},
        {"\xe6\x97\xa5\xe6\x9c\xac", "__"},
        {"", "pump-1.A"},
    };
    enum { CASES = sizeof cases / sizeof *cases };
    char path[] = "/tmp/shorebreak-body-XXXXXX.gltf", nodes[2048] = "", roots[256] = "", text[4096];
    const int made = mkstemps(path, 5);
    assert_true(made >= 0);
    close(made);
    for (size_t i = 0; i < CASES; ++i) {
        const char *name = cases[i].original[0] ? cases[i].original : cases[i].name;
        snprintf(roots + strlen(roots), sizeof roots - strlen(roots), "%s%zu", i ? "," : "", i);
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes), "%s{\"mesh\":0,\"name\":\"", i ? "," : "");
        for (; *name; ++name) {
            const char plain[2] = {*name, '\0'};
            strcat(nodes, *name == '"' ? "\\\"" : *name == '\x1b' ? "\\u001b" : plain);
        }
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes), "\"}");
    }
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],\"nodes\":[%s],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:"
             "application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
             roots, nodes);
    write_file(path, text);
    sb_body body = {
        .name = "plant", .shape = SB_SHAPE_MESH, .role = SB_ROLE_TERRAIN, .file = path, .scale = 1, .split = true};
    sb_mesh *meshes = from_body(&body, CASES);
    for (size_t i = 0; i < CASES; ++i) {
        assert_string_equal(meshes[i].name, cases[i].name);
        assert_string_equal(meshes[i].original, cases[i].original);
    }
    free_all(meshes, CASES);

    sb_scene scene = {.dimensions = 3, .resolution = 0.1, .bodies = &body, .body_count = 1};
    scene.domain.max = sb_vec(2, 2, 2);
    for (int side = 0; side < SB_SIDES; ++side) scene.domain.side[side] = SB_SIDE_OPEN;
    sb_model model;
    if (sb_model_import_bodies(&scene, &model, &error) != SB_OK) fail_msg("%s", error.text);
    const char *names_warning = NULL;
    for (size_t i = 0; i < model.warning_count; ++i)
        if (strstr(model.warnings[i], "part names")) names_warning = model.warnings[i];
    assert_non_null(names_warning);
    assert_string_equal(names_warning,
                        "body \"plant\": 11 part names contain characters other than letters, digits, _ . and -, "
                        "which are replaced by _: \"..\" becomes \"_.\", \"=cmd|x\" becomes \"_cmd_x\", \"`id`\" "
                        "becomes \"_id_\", \"-rf\" becomes \"_rf\", ...");
    sb_model_free(&model);
    remove(path);
}

static void test_grid_body(void **state)
{
    (void)state;
    char path[] = "/tmp/shorebreak-body-XXXXXX.asc";
    int made = mkstemps(path, 4);
    assert_true(made >= 0);
    close(made);
    write_file(path, "ncols 3\nnrows 2\nxllcenter 10\nyllcenter 20\ncellsize 5\n1 2 3\n4 5 6\n");
    sb_body body = {.name = "sea bed",
                    .shape = SB_SHAPE_GRID,
                    .role = SB_ROLE_TERRAIN,
                    .file = path,
                    .up = 'z',
                    .scale = 2,
                    .datum = -7,
                    .translate = {0, 0, 0.5}};
    sb_mesh *meshes = from_body(&body, 1);
    sb_mesh_report report = diagnose(meshes);
    assert_true(near(report.min, sb_vec(20, 40, 2 - 6.5)));
    assert_true(near(report.max, sb_vec(40, 50, 12 - 6.5)));
    assert_int_equal(meshes[0].turned, 0);
    assert_string_equal(meshes[0].name, "sea bed");
    free_all(meshes, 1);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),         cmocka_unit_test(test_bad_shapes), cmocka_unit_test(test_rotation_order),
        cmocka_unit_test(test_mesh_file_body), cmocka_unit_test(test_part_names), cmocka_unit_test(test_grid_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

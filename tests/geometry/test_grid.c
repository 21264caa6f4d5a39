/* Terrain grids: both formats, holes, strict errors with their line, and a measured sea bed. */
#include "base/memory.h"
#include "geometry/mesh.h"
#include "geometry/solid.h"

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
static char folder[] = "/tmp/shorebreak-grid-XXXXXX";

static const char *save(const char *name, const char *text)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
    return path;
}

static sb_mesh read_grid(const char *name, const char *text, double datum)
{
    sb_mesh mesh;
    const char *path = save(name, text);
    sb_status status = sb_mesh_import_grid(path, datum, &mesh, &error);
    remove(path);
    if (status != SB_OK) fail_msg("%s", error.text);
    return mesh;
}

static bool has_vertex(const sb_mesh *mesh, double x, double y, double z)
{
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (sb_norm(sb_sub(mesh->vertices[i], sb_vec(x, y, z))) < 1e-9) return true;
    return false;
}

static void check_looks_up(const sb_mesh *mesh, double plan_area)
{
    double area = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *t = mesh->triangles[i];
        sb_vec3 up = sb_cross(sb_sub(mesh->vertices[t[1]], mesh->vertices[t[0]]),
                              sb_sub(mesh->vertices[t[2]], mesh->vertices[t[0]]));
        assert_true(up.z > 0);
        area += up.z / 2;
    }
    assert_true(fabs(area - plan_area) < 1e-9 * plan_area);
}

static void test_ascii(void **state)
{
    (void)state;
    sb_mesh mesh = read_grid("a.asc",
                             "NCOLS 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n"
                             "NODATA_value -9999\n1 2 3\n4 5 6\n",
                             0.5);
    assert_int_equal(mesh.vertex_count, 6);
    assert_int_equal(mesh.triangle_count, 4);
    assert_true(has_vertex(&mesh, 105, 215, 1.5)); /* the first number is the north-west */
    assert_true(has_vertex(&mesh, 125, 205, 6.5));
    check_looks_up(&mesh, 200);
    sb_mesh_free(&mesh);
    /* A hole costs the squares around it, but leaves the half of each that it does not touch. */
    mesh = read_grid("h.ASC",
                     "ncols 3\r\nnrows 3\r\nxllcenter 0\r\nyllcenter 0\r\ncellsize 2\r\n"
                     "nodata_value -1\r\n1 1 1\r\n1 -1 1\r\n1 1 -1.0\r\n",
                     0);
    assert_int_equal(mesh.vertex_count, 7);
    assert_int_equal(mesh.triangle_count, 3);
    assert_false(has_vertex(&mesh, 2, 2, -1));
    assert_true(has_vertex(&mesh, 0, 4, 1));
    check_looks_up(&mesh, 6);
    assert_int_equal(mesh.hole_count, 2);
    assert_true(mesh.holes[0].x == 4 && mesh.holes[0].y == 0 && mesh.holes[1].x == 2 && mesh.holes[1].y == 2);
    sb_mesh_free(&mesh);
    /* The line may be left out: then it is -9999. */
    mesh = read_grid("n.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 1 -9999\n1 1 1\n", 0);
    assert_int_equal(mesh.vertex_count, 5);
    assert_int_equal(mesh.hole_count, 1);
    check_looks_up(&mesh, 1.5);
    sb_mesh_free(&mesh);
    mesh =
        read_grid("n.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -1\n1 1 1 -9999\n", 0);
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.hole_count, 0);
    sb_mesh_free(&mesh);
}

static void test_points(void **state)
{
    (void)state;
    /* Steps of 1/3 and 50, rounded, in no order, one point missing. */
    sb_mesh mesh = read_grid("p.xyz",
                             "# easting northing height\n"
                             "0.667 150 6\n0 100 1\n\n1.000,100,4\n0.333 100 2\r\n0.667;100;3\n"
                             "0 150 5\n1 150 7.5",
                             -1);
    assert_int_equal(mesh.vertex_count, 7);
    assert_int_equal(mesh.triangle_count, 4);
    assert_true(has_vertex(&mesh, 0, 100, 0));
    assert_true(has_vertex(&mesh, 1, 150, 6.5));
    assert_true(has_vertex(&mesh, 1.0 / 3, 100, 1));
    check_looks_up(&mesh, 2.0 / 3 * 50);
    sb_mesh_free(&mesh);
}

static void expect_refusal(const char *name, const char *text, const char *why)
{
    sb_mesh mesh = {.vertex_count = 77};
    const char *path = save(name, text);
    error.text[0] = '\0';
    sb_status status = sb_mesh_import_grid(path, 0, &mesh, &error);
    remove(path);
    if (status != SB_BAD_INPUT || strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why))
        fail_msg("%s: status %d: \"%s\" does not say \"%s\"", text, status, error.text, why);
    assert_int_equal(mesh.vertex_count, 77);
}

/* As spreadsheets write. */
static void test_a_byte_order_mark(void **state)
{
    (void)state;
    sb_mesh mesh = read_grid("m.asc",
                             "\xef\xbb\xbf"
                             "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n",
                             0);
    assert_int_equal(mesh.vertex_count, 4);
    sb_mesh_free(&mesh);
    mesh = read_grid("m.xyz",
                     "\xef\xbb\xbf"
                     "0 0 1\n1 0 2\n0 1 3\n1 1 4\n",
                     0);
    assert_int_equal(mesh.vertex_count, 4);
    sb_mesh_free(&mesh);
}

#define HEAD "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"

static void test_bad_ascii(void **state)
{
    (void)state;
    expect_refusal("b.asc", "", ":1: the header ends without ncols");
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxllcorner 0\ncellsize 1\n1 2\n3 4\n",
                   ":5: the header ends without yllcorner");
    expect_refusal("b.asc", "ncols 2\nncols 2\n", ":2: a second ncols");
    expect_refusal("b.asc", "ncols 2\nwidth 2\n", ":2: \"width\"");
    expect_refusal("b.asc", "ncols two\n", ":1: \"two\"");
    expect_refusal("b.asc", "ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4", "ncols 2.5");
    expect_refusal("b.asc", "ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2", "ncols 1");
    expect_refusal("b.asc", "ncols 1e9\nnrows 1e9\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2", "ncols 1e+09");
    expect_refusal("b.asc", "ncols 9000\nnrows 9000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2", ":6: too short");
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2 3 4", "cellsize -1");
    expect_refusal("b.asc", "xllcenter 1\n" HEAD "1 2 3 4", "both corner and center");
    expect_refusal("b.asc", HEAD "1 2\n3 x4\n", ":7: \"x4\"");
    expect_refusal("b.asc", HEAD "1 2\n3 4m\n", ":7: \"4m\"");
    expect_refusal("b.asc", HEAD "1 2\n3 1e999\n", ":7: \"1e999\"");
    expect_refusal("b.asc", HEAD "1 2\n3 0x10\n", ":7: \"0x10\"");
    expect_refusal("b.asc", HEAD "1 2\n3 -0X10\n", ":7: \"-0X10\"");
    expect_refusal("b.asc", HEAD "1 2\n3    \n", ":8: the file ends");
    expect_refusal("b.asc", HEAD "1 2\n3 4\n5\n", ":8: more numbers");
    expect_refusal("b.asc", HEAD "nodata_value 0\n0 2\n3 0\n", "no three neighbouring heights");
    expect_refusal("b.tif", HEAD "1 2 3 4", "unknown grid format");
    assert_int_equal(sb_mesh_import_grid("/nonexistent/b.asc", 0, NULL, &error), SB_BAD_INPUT);
    assert_int_equal(sb_mesh_import_grid("/", 0, NULL, &error), SB_BAD_INPUT);
}

static void test_bad_points(void **state)
{
    (void)state;
    expect_refusal("b.xyz", "", "0 points");
    expect_refusal("b.xyz", "0 0 1\n1 0\n0 1 1\n", ":2: \"1 0\"");
    expect_refusal("b.xyz", "0 0 1\n1 0 1 5\n0 1 1\n", ":2: \"5\"");
    expect_refusal("b.xyz", "0 0 1\n1 0 nan\n", ":2:");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n0 1 1\n\n1 0 2\n", ":5: a second height at (1, 0)");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n2 0 1\n3.4 0 1\n0 1 1\n", "expected 0 plus a multiple");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n2 0 1\n", "1 values of y");
    expect_refusal("b.xyz", "0 0 1\n1 1 1\n1e6 1e6 1\n", "expected");
}

static void test_measured_sea_bed(void **state)
{
    (void)state;
    const char *path = SB_SOURCE_DIR "/../shared/data/solitary-conical-island/bathymetry.asc";
    if (access(path, R_OK) != 0) skip();
    sb_mesh mesh;
    if (sb_mesh_import_grid(path, -0.78, &mesh, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(mesh.vertex_count, 441 * 261);
    assert_int_equal(mesh.triangle_count, 2 * 440 * 260);
    check_looks_up(&mesh, 44.0 * 26.0);
    sb_solid *solid;
    assert_int_equal(sb_solid_create(&mesh, SB_ROLE_TERRAIN, &solid, &error), SB_OK);
    /* The cone stands at (17, 0) with its top 0.366 m above still water; beside it is the flat. */
    double top = 5 - sb_solid_raycast(solid, sb_vec(17, 0, 5), sb_vec(0, 0, -1), 10);
    double flat = 5 - sb_solid_raycast(solid, sb_vec(5, 0, 5), sb_vec(0, 0, -1), 10);
    assert_true(fabs(top - 0.366) < 0.01 && fabs(flat + 0.78) < 0.02);
    assert_true(sb_solid_contains(solid, sb_vec(17, 0, 0.3)));
    assert_false(sb_solid_contains(solid, sb_vec(5, 0, 0.3)));
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ascii),      cmocka_unit_test(test_points),
        cmocka_unit_test(test_bad_ascii),  cmocka_unit_test(test_a_byte_order_mark),
        cmocka_unit_test(test_bad_points), cmocka_unit_test(test_measured_sea_bed),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}

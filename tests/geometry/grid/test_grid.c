/* Tests terrain grids: both formats, holes, errors with their line, and a measured sea bed. */
#include "base/memory.h"
#include "geometry/mesh/mesh.h"
#include "geometry/solid/solid.h"

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

static sb_status import(const char *path, sb_mesh *mesh)
{
    char *copy = sb_strdup(path);
    assert_non_null(copy);
    const sb_body body = {.shape = SB_SHAPE_GRID, .file = copy, .scale = 1};
    const sb_status status = sb_mesh_import_grid(&body, mesh, &error);
    sb_free(copy);
    return status;
}

static sb_mesh read_grid(const char *name, const char *text)
{
    sb_mesh mesh;
    const char *path = save(name, text);
    sb_status status = import(path, &mesh);
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
    sb_mesh mesh = read_grid("a.asc", "NCOLS 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n"
                                      "NODATA_value -9999\n1 2 3\n4 5 6\n");
    assert_int_equal(mesh.vertex_count, 6);
    assert_int_equal(mesh.triangle_count, 4);
    assert_true(has_vertex(&mesh, 105, 215, 1)); /* the first number is the north-western node */
    assert_true(has_vertex(&mesh, 125, 205, 6));
    check_looks_up(&mesh, 200);
    sb_mesh_free(&mesh);
    /* A hole removes from each square around it the half that touches it. */
    mesh = read_grid("h.ASC", "ncols 3\r\nnrows 3\r\nxllcenter 0\r\nyllcenter 0\r\ncellsize 2\r\n"
                              "nodata_value -1\r\n1 1 1\r\n1 -1 1\r\n1 1 -1.0\r\n");
    assert_int_equal(mesh.vertex_count, 7);
    assert_int_equal(mesh.triangle_count, 3);
    assert_false(has_vertex(&mesh, 2, 2, -1));
    assert_true(has_vertex(&mesh, 0, 4, 1));
    check_looks_up(&mesh, 6);
    assert_int_equal(mesh.hole_count, 2);
    assert_true(mesh.holes[0].x == 4 && mesh.holes[0].y == 0 && mesh.holes[1].x == 2 && mesh.holes[1].y == 2);
    sb_mesh_free(&mesh);
    /* Without this line the value is -9999. */
    mesh = read_grid("n.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 1 -9999\n1 1 1\n");
    assert_int_equal(mesh.vertex_count, 5);
    assert_int_equal(mesh.hole_count, 1);
    check_looks_up(&mesh, 1.5);
    sb_mesh_free(&mesh);
    mesh = read_grid("n.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -1\n1 1 1 -9999\n");
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.hole_count, 0);
    sb_mesh_free(&mesh);
}

static void test_points(void **state)
{
    (void)state;
    /* Steps of 1/3 and 50, rounded, in no particular order, with one point missing. */
    sb_mesh mesh = read_grid("p.xyz", "# easting northing height\n"
                                      "0.667 150 6\n0 100 1\n\n1.000,100,4\n0.333 100 2\r\n0.667;100;3\n"
                                      "0 150 5\n1 150 7.5");
    assert_int_equal(mesh.vertex_count, 7);
    assert_int_equal(mesh.triangle_count, 4);
    assert_true(has_vertex(&mesh, 0, 100, 1));
    assert_true(has_vertex(&mesh, 1, 150, 7.5));
    assert_true(has_vertex(&mesh, 1.0 / 3, 100, 2));
    check_looks_up(&mesh, 2.0 / 3 * 50);
    sb_mesh_free(&mesh);
}

static void expect_refusal(const char *name, const char *text, const char *why)
{
    sb_mesh mesh = {.vertex_count = 77};
    const char *path = save(name, text);
    error.text[0] = '\0';
    sb_status status = import(path, &mesh);
    remove(path);
    if (status != SB_BAD_INPUT || strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why))
        fail_msg("%s: status %d: \"%s\" does not say \"%s\"", text, status, error.text, why);
    assert_int_equal(mesh.vertex_count, 77);
}

/* Spreadsheets write a byte-order mark. */
static void test_a_byte_order_mark(void **state)
{
    (void)state;
    sb_mesh mesh = read_grid("m.asc", "\xef\xbb\xbf"
                                      "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n");
    assert_int_equal(mesh.vertex_count, 4);
    sb_mesh_free(&mesh);
    mesh = read_grid("m.xyz", "\xef\xbb\xbf"
                              "0 0 1\n1 0 2\n0 1 3\n1 1 4\n");
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
    expect_refusal("b.asc", "ncols 9000\nnrows 9000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2",
                   ":6: the file is too short");
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
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 1\n1 2 3 4",
                   ":6: the header ends without dy");
    expect_refusal("b.asc", HEAD "dx 1\ndy 1\n1 2 3 4", "has cellsize and dx, expected one of them");
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1 0\n1 2 3 4", "dy 0, expected > 0");
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxllcorner nan\nyllcorner 0\ncellsize 1\n1 2 3 4", "xllcorner is not a");
    expect_refusal("b.asc", "ncols 2\nnrows 2\nxlower 0\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4", "both corner");
    expect_refusal("b.tt3", "2 ncols\n2 mx\n", ":2: a second ncols");
    expect_refusal("b.tt3", "2 ncols\n2 wide\n", ":2: \"wide\", expected ncols");
    expect_refusal("b.tt3", "2 2 ncols\n", ":1: two numbers before ncols");
    expect_refusal("b.tt2", "2 mx\n2 my\n0 xlower\n0 ylower\n1 cellsize\n-1 nodata_value\n1\n2\n3\n",
                   ":10: the file ends");
    expect_refusal("b.asc", HEAD "1 2\n3 -inf\n", ":7: \"-inf\"");
    expect_refusal("b.tif", HEAD "1 2 3 4", "unknown grid format");
    assert_int_equal(import("/nonexistent/b.asc", NULL), SB_BAD_INPUT);
    assert_int_equal(import("/", NULL), SB_BAD_INPUT);
}

static void test_bad_points(void **state)
{
    (void)state;
    expect_refusal("b.xyz", "", "0 points");
    expect_refusal("b.xyz", "0 0 1\n1 0\n0 1 1\n", ":2: \"1 0\"");
    expect_refusal("b.xyz", "0 0 1\n1 0 1 5\n0 1 1\n", ":2: \"5\"");
    expect_refusal("b.xyz", "0 0 1\n1 nan 1\n", ":2:");
    expect_refusal("b.xyz", "0 0 1\n1 0 inf\n", ":2:");
    expect_refusal("b.xyz", "x y z\nx y z\n0 0 1\n", ":2: \"x y z\"");
    expect_refusal("b.xyz", "x 0 1\n1 0 1\n0 1 1\n", ":1: \"x 0 1\"");
    expect_refusal("b.xyz", "lat,lon,z\n0,0,1\n1,0,1\n0,1,1\n", ":1: columns \"lat,lon,z\", expected x, y and z");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n0 1 1\n\n1 0 2\n", ":5: a second height at (1, 0)");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n2 0 1\n3.4 0 1\n0 1 1\n", "expected 0 plus a multiple");
    expect_refusal("b.xyz", "0 0 1\n1 0 1\n2 0 1\n", "1 values of y");
    expect_refusal("b.xyz", "0 0 1\n1 1 1\n1e6 1e6 1\n", "expected");
}

/* Expects six nodes, the north-western with height 1, and steps of 10 and 20. */
static void expect_six(const char *name, const char *text, double x, double y)
{
    sb_mesh mesh = read_grid(name, text);
    assert_int_equal(mesh.vertex_count + mesh.hole_count, 6);
    if (!has_vertex(&mesh, x, y + 20, 1) || !has_vertex(&mesh, x + 20, y, 6)) fail_msg("%s", text);
    sb_mesh_free(&mesh);
}

static void test_unequal_steps(void **state)
{
    (void)state;
    expect_six("s.asc", "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ndx 10\ndy 20\n1 2 3\n4 5 6\n", 105, 210);
    expect_six("s.asc", "ncols 3\nnrows 2\nxllcenter 100\nyllcenter 200\nDX 10.0\nDY 20.0\n1 2 3\n4 5 6\n", 100, 200);
    expect_six("s.asc", "ncols 3\nnrows 2\nxllcorner 1\nyllcorner 2\ncellsize 10 20\n1 2 3\n4 5 6\n", 6, 12);
    /* Equal steps are a cellsize. */
    sb_mesh mesh = read_grid("e.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 2\ndy 2\n1 2\n3 4\n");
    assert_true(has_vertex(&mesh, 1, 3, 1) && has_vertex(&mesh, 3, 1, 4));
    sb_mesh_free(&mesh);
}

static void test_missing_heights_and_comments(void **state)
{
    (void)state;
    expect_six("m.asc",
               "# of a survey\nncols 3 # columns\nnrows 2\nxllcenter 0\nyllcenter 0\ndx 10\ndy 20\n"
               "nodata_value nan\n# heights\n1 nan 3\n4 5 6 # end\n",
               0, 0);
    expect_six("m.asc", "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ndx 10\ndy 20\n1 2 -NaN\n4 5 6\n", 0, 0);
    sb_mesh mesh = read_grid("m.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnan 1 1\n1 1 NaN\n");
    assert_int_equal(mesh.hole_count, 2);
    assert_int_equal(mesh.triangle_count, 2);
    sb_mesh_free(&mesh);
    mesh = read_grid("m.xyz", "0 0 1\n1 0 nan\n2 0 1\n0 1 1\n1 1 1\n2 1 1\n");
    assert_int_equal(mesh.hole_count, 1);
    assert_true(mesh.holes[0].x == 1 && mesh.holes[0].y == 0);
    sb_mesh_free(&mesh);
}

/* Files as GeoClaw's topotools writes them and its documentation shows them. */
static void test_geoclaw(void **state)
{
    (void)state;
    expect_six("g.tt3",
               "     3                              ncols\n     2                              nrows\n"
               " 1.000000000000000e+02              xlower\n 2.000000000000000e+02              ylower\n"
               " 1.000000000000000e+01     2.000000000000000e+01          cellsize\n"
               "     -9999                          nodata_value\n"
               "  1.0000000e+00   2.0000000e+00   -9.9990000e+03 \n  4.0000000e+00   5.0000000e+00   6.0000000e+00 \n",
               100, 200);
    expect_six("g.topotype2",
               "3 mx\n2 my\n0. xllcorner\n20. yllcorner\n10. 20. cellsize\n9999. nodatavalue\n1.\n2.\n3.\n4.\n5.\n6.\n",
               5, 30);
    sb_mesh mesh = read_grid("g.asc", "2 ncols\n2 nrows\n0 xlower\n20 ylower\n10 cellsize\n9999 nodata_value\n"
                                      "-1 -2\n-3 -4\n");
    assert_true(has_vertex(&mesh, 0, 30, -1) && has_vertex(&mesh, 10, 20, -4));
    sb_mesh_free(&mesh);
    mesh = read_grid("g.tt1", "0. 30. -1000.\n10. 30. -1000.\n0. 20. -1000.\n10. 20. -1000.\n");
    assert_true(has_vertex(&mesh, 10, 20, -1000));
    sb_mesh_free(&mesh);
}

static void test_points_with_a_header(void **state)
{
    (void)state;
    static const char *const heads[] = {"x y z", "x,y,z", "\"X [m]\";\"Y [m]\";\"Z [m]\"", "lon lat depth",
                                        "# a comment\n\nEasting, Northing, Elevation\r"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; ++i) {
        char text[256];
        snprintf(text, sizeof text, "%s\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n", heads[i]);
        sb_mesh mesh = read_grid("h.xyz", text);
        assert_int_equal(mesh.vertex_count, 4);
        assert_true(has_vertex(&mesh, 0, 0, 1));
        sb_mesh_free(&mesh);
    }
}

static void test_depths_count_downwards(void **state)
{
    (void)state;
    char path[256];
    snprintf(path, sizeof path, "%s", save("d.asc", HEAD "1 2\n3 -9999\n"));
    sb_body body = {.name = "bed",
                    .shape = SB_SHAPE_GRID,
                    .role = SB_ROLE_TERRAIN,
                    .file = path,
                    .scale = 2,
                    .positive = SB_POSITIVE_DOWN,
                    .datum = 10};
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_from_body(&body, 0.1, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(meshes->hole_count, 1);
    assert_non_null(strstr(meshes->told,
                           "d.asc: no coordinate system, units of 2 m; 2 x 2 nodes, 1 x 1 units; from (0, 0) "
                           "to (4, 4) m; vertical datum: none stated\n"));
    assert_non_null(strstr(meshes->told, "ground: as in the file; 2 x 2 nodes of 2 x 2 m; from (1, 1) to (3, 3) m; "
                                         "heights 4 to 8 m, of which datum +10 m; 1 voids (25 %), kept as holes"));
    assert_true(has_vertex(meshes, 1, 3, 8) && has_vertex(meshes, 3, 3, 6) && has_vertex(meshes, 1, 1, 4));
    check_looks_up(meshes, 2);
    sb_mesh_free(meshes);
    sb_free(meshes);
    remove(path);
}

static void test_measured_sea_bed(void **state)
{
    (void)state;
    const char *path = SB_SOURCE_DIR "/../shared/data/solitary-conical-island/bathymetry.asc";
    if (access(path, R_OK) != 0) skip();
    sb_mesh mesh;
    if (import(path, &mesh) != SB_OK) fail_msg("%s", error.text);
    for (size_t i = 0; i < mesh.vertex_count; ++i) mesh.vertices[i].z -= 0.78;
    assert_int_equal(mesh.vertex_count, 441 * 261);
    assert_int_equal(mesh.triangle_count, 2 * 440 * 260);
    check_looks_up(&mesh, 44.0 * 26.0);
    sb_solid *solid;
    assert_int_equal(sb_solid_create(&mesh, SB_ROLE_TERRAIN, &solid, &error), SB_OK);
    /* The cone stands at (17, 0) with its top 0.366 m above the still-water level. Beside it the bed is flat. */
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
        cmocka_unit_test(test_ascii),
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_bad_ascii),
        cmocka_unit_test(test_a_byte_order_mark),
        cmocka_unit_test(test_unequal_steps),
        cmocka_unit_test(test_missing_heights_and_comments),
        cmocka_unit_test(test_geoclaw),
        cmocka_unit_test(test_points_with_a_header),
        cmocka_unit_test(test_depths_count_downwards),
        cmocka_unit_test(test_bad_points),
        cmocka_unit_test(test_measured_sea_bed),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}

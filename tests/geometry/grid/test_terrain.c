/* Tests terrain from GeoTIFF and NetCDF files and from stacks of grids, which the tests write themselves. */
#include "base/memory.h"
#include "check.h"
#include "geometry/mesh/mesh.h"
#include "grid_samples.h"

#include <dirent.h>
#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static sb_error error;
static char folder[] = "/tmp/shorebreak-terrain-XXXXXX";

static char *path_of(const char *name)
{
    static char paths[4][256];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static sb_body grid_of(char *file)
{
    return (sb_body){.name = "bed", .shape = SB_SHAPE_GRID, .role = SB_ROLE_TERRAIN, .file = file, .scale = 1};
}

static sb_mesh make(const sb_body *body)
{
    sb_mesh *meshes = NULL, mesh;
    size_t count = 0;
    if (sb_mesh_from_body(body, 1, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, 1);
    mesh = meshes[0];
    sb_free(meshes);
    return mesh;
}

/* Fails unless the body is refused with one line that contains all the words. */
static void expect_refusal(const sb_body *body, const char *const words[])
{
    sb_mesh *meshes = NULL;
    size_t count = 0;
    error.text[0] = '\0';
    if (sb_mesh_from_body_within(body, 1, sb_vec(0, 0, -10), sb_vec(100, 100, 10), 5, &meshes, &count, &error) !=
        SB_BAD_INPUT)
        fail_msg("no refusal with \"%s\"", words[1]);
    assert_null(strchr(error.text, '\n'));
    for (int k = 0; words[k]; ++k)
        if (!strstr(error.text, words[k])) fail_msg("\"%s\" lacks \"%s\"", error.text, words[k]);
}
#define EXPECT_REFUSAL(body, ...) expect_refusal(body, (const char *const[]){__VA_ARGS__, NULL})

/* Whole numbers at whole nodes, which all formats store exactly. */
static double slope(double x, double y)
{
    return 2 * x - y;
}

static double slope_with_a_void(double x, double y)
{
    return x == 103 && y == 202 ? (double)NAN : slope(x, y);
}

static void expect_slope(const sb_mesh *mesh, size_t count)
{
    assert_int_equal(mesh->vertex_count, count);
    for (size_t i = 0; i < count; ++i) {
        const sb_vec3 at = mesh->vertices[i];
        assert_near(at.x, round(at.x), 1e-9);
        assert_near(at.z, slope(at.x, at.y), 1e-9);
    }
}

static const grid_sample plain = {.columns = 40, .rows = 25, .x = 100, .y = 200, .dx = 1, .dy = 1, .height = slope};

static void test_geotiff(void **state)
{
    (void)state;
    for (unsigned kind = 0; kind < 16; ++kind) {
        char *path = path_of("a.tif");
        grid_sample sample = plain;
        sample.whole = kind & 1;
        sample.tile = kind & 2 ? 16 : 0;
        sample.point = kind & 4;
        sample.height = kind & 8 ? slope_with_a_void : slope;
        sample.nodata = kind & 8 ? -9999 : 0;
        grid_sample_tiff(&sample, path);
        const sb_body body = grid_of(path);
        sb_mesh mesh = make(&body);
        expect_slope(&mesh, kind & 8 ? 999 : 1000);
        assert_int_equal(mesh.hole_count, kind & 8 ? 1 : 0);
        if (kind & 8) assert_true(mesh.holes[0].x == 103 && mesh.holes[0].y == 202);
        assert_non_null(strstr(mesh.told, "no coordinate system, taken as metres"));
        assert_non_null(strstr(mesh.told, kind & 8 ? "1 voids (0.1 %), kept as holes" : "no voids"));
        sb_mesh_free(&mesh);
    }
}

static void test_netcdf(void **state)
{
    (void)state;
    for (unsigned kind = 0; kind < 16; ++kind) {
        char *path = path_of(kind & 2 ? "a.nc" : "a.grd");
        grid_sample sample = plain;
        sample.whole = kind & 1;
        sample.tile = kind & 2 ? 1 : 0;
        sample.northward = kind & 4;
        sample.height = kind & 8 ? slope_with_a_void : slope;
        sample.nodata = kind & 8 ? -32768 : 0;
        sample.standard_name = "height_above_mean_sea_level";
        sample.units[0] = sample.units[1] = sample.units[2] = kind & 1 ? "m" : NULL;
        grid_sample_netcdf(&sample, path);
        const sb_body body = grid_of(path);
        sb_mesh mesh = make(&body);
        expect_slope(&mesh, kind & 8 ? 999 : 1000);
        assert_int_equal(mesh.hole_count, kind & 8 ? 1 : 0);
        assert_non_null(strstr(mesh.told, "vertical datum: height_above_mean_sea_level"));
        sb_mesh_free(&mesh);
    }
}

static double depth(double x, double y)
{
    return -slope(x, y);
}

/* Depths are made heights where the file states them, unless the scene has a direction. */
static void test_stated_depths(void **state)
{
    (void)state;
    static const struct {
        sb_positive key;
        const char *file, *told;
        double sign;
    } cases[] = {
        {SB_POSITIVE_AUTO, "down", "; depths, as its attribute positive states; ", -1},
        {SB_POSITIVE_AUTO, "Down", "; depths, as its attribute positive states; ", -1},
        {SB_POSITIVE_AUTO, "up", NULL, 1},
        {SB_POSITIVE_AUTO, NULL, NULL, 1},
        {SB_POSITIVE_DOWN, NULL, NULL, -1},
        {SB_POSITIVE_DOWN, "down", "; its attribute positive: down is not used, because the key positive is down", -1},
        {SB_POSITIVE_UP, "down", "; its attribute positive: down is not used, because the key positive is up", 1},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char *path = path_of("depths.nc");
        grid_sample sample = plain;
        sample.height = cases[k].sign < 0 ? depth : slope;
        sample.positive = cases[k].file;
        grid_sample_netcdf(&sample, path);
        sb_body body = grid_of(path);
        body.positive = cases[k].key;
        sb_mesh mesh = make(&body);
        expect_slope(&mesh, 1000);
        if (cases[k].told)
            assert_non_null(strstr(mesh.told, cases[k].told));
        else
            assert_null(strstr(mesh.told, "positive"));
        sb_mesh_free(&mesh);
    }
}

/* ---- projection ---- */

/* Transverse Mercator on WGS 84 by the Krueger series in the third flattening, to its third order; within UTM its error
   is below 1 mm. [Karney 2011, Transverse Mercator with an accuracy of a few nanometers, eq. 7 to 11, 35] */
static void utm(double longitude, double latitude, double middle, double place[2])
{
    const double f = 1 / 298.257223563, n = f / (2 - f), k = 2 * sqrt(n) / (1 + n), degree = M_PI / 180;
    const double radius = 6378137 / (1 + n) * (1 + n * n / 4 + n * n * n * n / 64);
    const double alpha[3] = {n / 2 - 2 * n * n / 3 + 5 * n * n * n / 16, 13 * n * n / 48 - 3 * n * n * n / 5,
                             61 * n * n * n / 240};
    const double s = sin(latitude * degree), turn = (longitude - middle) * degree;
    const double t = sinh(atanh(s) - k * atanh(k * s));
    const double north = atan2(t, cos(turn)), east = atanh(sin(turn) / sqrt(1 + t * t));
    double x = east, y = north;
    for (int j = 0; j < 3; ++j) {
        x += alpha[j] * cos(2 * (j + 1) * north) * sinh(2 * (j + 1) * east);
        y += alpha[j] * sin(2 * (j + 1) * north) * cosh(2 * (j + 1) * east);
    }
    place[0] = 500000 + 0.9996 * radius * x;
    place[1] = 0.9996 * radius * y;
}

static double longitudes(double x, double y)
{
    (void)y;
    return 100 * (x + (x < 0 ? 360 : 0) - 141);
}

static double latitudes(double x, double y)
{
    (void)x;
    return 100 * (y - 38);
}

/* 0.1 x 0.06 degrees near Onagawa. UTM zone 54 has the middle 141 degrees east. */
static const grid_sample degrees = {
    .columns = 101, .rows = 61, .x = 141.4, .y = 38.4, .dx = 0.001, .dy = 0.001, .geographic = true};

static void expect_same_place(const sb_mesh *east, const sb_mesh *north)
{
    assert_int_equal(east->vertex_count, north->vertex_count);
    assert_true(east->vertex_count > 5000);
    for (size_t i = 0; i < east->vertex_count; ++i) {
        double place[2];
        utm(141 + east->vertices[i].z / 100, 38 + north->vertices[i].z / 100, 141, place);
        /* The heights are stored as float: 2e-6 m of 40 are 2e-8 degrees, 2 mm. */
        assert_near(east->vertices[i].x, place[0], 0.004);
        assert_near(east->vertices[i].y, place[1], 0.004);
    }
}

/* The heights are longitudes and latitudes, which linear interpolation keeps, and so give each node's true place. */
static void test_degrees_become_utm(void **state)
{
    (void)state;
    for (int k = 0; k < 4; ++k) {
        grid_sample sample = degrees;
        char *paths[2] = {path_of(k == 0 ? "east.tif" : "east.nc"), path_of(k == 0 ? "north.tif" : "north.nc")};
        sb_mesh meshes[2];
        sample.epsg = 4326;
        sample.northward = true;
        sample.tile = k == 2;
        if (k == 3) sample.x -= 360;
        sample.units[0] = "degrees_east";
        sample.units[1] = "degrees_north";
        for (int i = 0; i < 2; ++i) {
            sample.height = i == 0 ? longitudes : latitudes;
            (k == 0 ? grid_sample_tiff : grid_sample_netcdf)(&sample, paths[i]);
            sb_body body = grid_of(paths[i]);
            body.window = (sb_window){true, 535500, 4251000, 543000, 4256500};
            meshes[i] = make(&body);
        }
        expect_same_place(&meshes[0], &meshes[1]);
        assert_non_null(strstr(meshes[0].told, "EPSG:4326, projected; 101 x 61 nodes, 0.001 x 0.001 degrees"));
        assert_non_null(strstr(meshes[0].told, "ground: EPSG:32654, the UTM zone of the finest file"));
        sb_mesh_free(&meshes[0]);
        sb_mesh_free(&meshes[1]);
    }
}

/* A scene's domain limits what is read: origin, rotation and translation are undone, and the ground within the domain
   is as that of the whole file. */
static void test_domain_limits_the_window(void **state)
{
    (void)state;
    grid_sample sample = {.columns = 900, .rows = 700, .x = 530000, .y = 4250000, .dx = 10, .dy = 10, .epsg = 32654};
    sample.height = slope;
    sample.tile = 64;
    char *path = path_of("utm.tif");
    grid_sample_tiff(&sample, path);
    sb_body body = grid_of(path);
    body.origin[0] = 534000;
    body.origin[1] = 4253000;
    body.rotate = sb_vec(0, 0, 90);
    body.translate = sb_vec(50, 0, 0);
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_from_body_within(&body, 1, sb_vec(0, 0, -10), sb_vec(400, 200, 10), 20, &meshes, &count, &error) !=
        SB_OK)
        fail_msg("%s", error.text);
    assert_true(meshes->vertex_count > 40 * 20 && meshes->vertex_count < 55 * 35);
    sb_vec3 min = meshes->vertices[0], max = min;
    for (size_t i = 0; i < meshes->vertex_count; ++i) {
        const sb_vec3 at = meshes->vertices[i];
        min = sb_min(min, at);
        max = sb_max(max, at);
        /* x = 50 - north, y = east, from the origin. The file has floats. */
        const double east = 534000 + at.y, north = 4253000 - (at.x - 50);
        assert_near(at.z, (double)(float)slope(east, north), 1e-6);
    }
    assert_true(min.x <= -20 && min.y <= -20 && max.x >= 420 && max.y >= 220);
    sb_mesh_free(meshes);
    sb_free(meshes);
}

/* ---- stacks ---- */

static double flat(double x, double y)
{
    (void)x;
    (void)y;
    return -20;
}

static double raised(double x, double y)
{
    return fabs(x - 500) < 3 && fabs(y - 500) < 3 ? (double)NAN : -10;
}

static size_t count_open_edges(const sb_mesh *mesh)
{
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(mesh, &report, &error), SB_OK);
    return report.open_edges;
}

static void write_text(const char *path, const grid_sample *of)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols %zu\nnrows %zu\nxllcenter %.10g\nyllcenter %.10g\ncellsize %.10g\n", of->columns, of->rows,
            of->x, of->y, of->dx);
    for (size_t j = of->rows; j-- > 0;)
        for (size_t i = 0; i < of->columns; ++i) {
            const double z = of->height(of->x + (double)i * of->dx, of->y + (double)j * of->dy);
            fprintf(file, "%.10g\n", isnan(z) ? -9999 : z);
        }
    assert_int_equal(fclose(file), 0);
}

/* A fine grid on a coarse one, 10 m higher: in its middle its heights count, far from it those of the coarse one, its
   void is covered by the coarse one, and between them the ground rises within one coarse cell, without a gap. */
static void test_stack(void **state)
{
    (void)state;
    const grid_sample coarse = {
        .columns = 21, .rows = 21, .x = 0, .y = 0, .dx = 50, .dy = 50, .height = flat, .epsg = 32654};
    const grid_sample fine = {.columns = 81, .rows = 81, .x = 300, .y = 300, .dx = 5, .dy = 5, .height = raised};
    char *paths[2] = {path_of("coarse.tif"), path_of("fine.asc")};
    grid_sample_tiff(&coarse, paths[0]);
    write_text(paths[1], &fine);
    for (int order = 0; order < 2; ++order) {
        sb_grid_file files[2] = {{paths[order], NULL, 0}, {paths[1 - order], NULL, 0}};
        sb_body body = grid_of(NULL);
        body.files = files;
        body.file_count = 2;
        body.window = (sb_window){true, 0, 0, 1000, 1000};
        sb_mesh mesh = make(&body);
        assert_int_equal(mesh.vertex_count, 201 * 201);
        assert_int_equal(count_open_edges(&mesh), 4 * 200);
        for (size_t i = 0; i < mesh.vertex_count; ++i) {
            const sb_vec3 at = mesh.vertices[i];
            const double inside = 202.5 - fmax(fabs(at.x - 500), fabs(at.y - 500));
            const double from_void = hypot(at.x - 500, at.y - 500);
            assert_true(at.z >= -20 - 1e-9 && at.z <= -10 + 1e-9);
            if (inside < 0 || from_void < 1) assert_near(at.z, -20, 1e-9);
            if (inside > 60 && from_void > 80) assert_near(at.z, -10, 1e-9);
            if ((i + 1) % 201) assert_true(fabs(mesh.vertices[i + 1].z - at.z) <= 10.0 / 10 * 1.5 + 1e-6);
        }
        assert_non_null(strstr(mesh.told, "fine.asc: no coordinate system, taken as metres"));
        sb_mesh_free(&mesh);
    }
}

/* Two files of the same cells side by side: the ground goes through, and each file's own datum counts. */
static void test_neighbours_join(void **state)
{
    (void)state;
    grid_sample west = plain, east = plain;
    char *paths[2] = {path_of("west.tif"), path_of("east.tif")};
    east.x = west.x + 40;
    grid_sample_tiff(&west, paths[0]);
    grid_sample_tiff(&east, paths[1]);
    sb_grid_file files[2] = {{paths[0], NULL, 3}, {paths[1], NULL, 3}};
    sb_body body = grid_of(NULL);
    body.files = files;
    body.file_count = 2;
    body.datum = -1;
    body.window = (sb_window){true, 100, 200, 179, 224};
    sb_mesh mesh = make(&body);
    assert_int_equal(mesh.vertex_count, 80 * 25);
    assert_int_equal(mesh.hole_count, 0);
    for (size_t i = 0; i < mesh.vertex_count; ++i)
        assert_near(mesh.vertices[i].z, slope(mesh.vertices[i].x, mesh.vertices[i].y) + 2, 1e-9);
    assert_non_null(strstr(mesh.told, "+3 m added to its heights"));
    assert_non_null(strstr(mesh.told, "of which datum -1 m"));
    sb_mesh_free(&mesh);
}

static double slope_with_a_lake(double x, double y)
{
    return hypot(x - 120, y - 212) < 5 ? (double)NAN : slope(x, y);
}

/* A plane is the solution of the equation that the filling approaches. */
static void test_voids_are_filled(void **state)
{
    (void)state;
    grid_sample sample = plain;
    char *path = path_of("lake.tif");
    sample.height = slope_with_a_lake;
    sample.nodata = -32767;
    grid_sample_tiff(&sample, path);
    sb_body body = grid_of(path);
    sb_mesh mesh = make(&body);
    const size_t lake = mesh.hole_count;
    assert_true(lake > 60);
    sb_mesh_free(&mesh);
    body.voids = SB_VOIDS_FILL;
    mesh = make(&body);
    assert_int_equal(mesh.hole_count, 0);
    assert_int_equal(mesh.vertex_count, 1000);
    for (size_t i = 0; i < 1000; ++i)
        assert_near(mesh.vertices[i].z, slope(mesh.vertices[i].x, mesh.vertices[i].y), 1e-3);
    assert_non_null(strstr(mesh.told, "interpolated from the heights around them"));
    sb_mesh_free(&mesh);
}

static void test_resample_and_depths(void **state)
{
    (void)state;
    char *path = path_of("r.tif");
    grid_sample sample = plain;
    sample.vertical = 5773;
    grid_sample_tiff(&sample, path);
    sb_body body = grid_of(path);
    body.resample = 2.5;
    body.positive = SB_POSITIVE_DOWN;
    body.datum = 7;
    body.window = (sb_window){true, 105, 205, 130, 220};
    sb_mesh mesh = make(&body);
    assert_int_equal(mesh.vertex_count, 11 * 7);
    for (size_t i = 0; i < mesh.vertex_count; ++i)
        assert_near(mesh.vertices[i].z, 7 - slope(mesh.vertices[i].x, mesh.vertices[i].y), 1e-9);
    assert_non_null(strstr(mesh.told, "vertical datum: EPSG:5773"));
    sb_mesh_free(&mesh);
}

/* ---- refusals ---- */

static sb_body tiff_body(grid_sample sample)
{
    char *path = path_of("bad.tif");
    if (!sample.height) sample.height = slope;
    grid_sample_tiff(&sample, path);
    return grid_of(path);
}

static void test_refused_geotiff(void **state)
{
    (void)state;
    grid_sample sample = {.columns = 20, .rows = 20, .dx = 10, .dy = 10, .height = slope};
    sample.bands = 3;
    sb_body body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "3 bands", "expected one band");
    sample.bands = 0;
    sample.vertical_unit = 9002;
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "EPSG:9002", "expected metres");
    sample.vertical_unit = 0;
    sample.geographic = true; /* without a code */
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "expected", "degrees");
    sample.dx = sample.dy = 0.01;
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "no EPSG code", "the key crs");
    sample.geographic = false;
    sample.epsg = 2263; /* New York, in US feet */
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "EPSG:2263 is not in metres", "the key projection");
    sample.epsg = 32799;
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "EPSG:32799", "no coordinate system that PROJ knows");
    body = tiff_body(plain);
    assert_int_equal(truncate(body.file, 3000), 0);
    EXPECT_REFUSAL(&body, "bad.tif", "expected");
    assert_int_equal(truncate(body.file, 0), 0);
    EXPECT_REFUSAL(&body, "bad.tif", "is empty");
}

static void test_refused_netcdf(void **state)
{
    (void)state;
    grid_sample sample = {.columns = 20, .rows = 20, .dx = 10, .dy = 10, .height = slope};
    char *path = path_of("bad.nc");
    sb_body body = grid_of(path);
    sample.units[0] = "km";
    grid_sample_netcdf(&sample, path);
    EXPECT_REFUSAL(&body, "bad.nc", "coordinate x", "\"km\"", "expected m");
    sample.units[0] = NULL;
    sample.units[2] = "feet";
    grid_sample_netcdf(&sample, path);
    EXPECT_REFUSAL(&body, "bad.nc", "z has the units \"feet\"", "expected m");
    sample.units[2] = NULL;
    sample.names[0] = "lat";
    sample.names[1] = "lon";
    grid_sample_netcdf(&sample, path);
    EXPECT_REFUSAL(&body, "bad.nc", "(lon, lat)", "expected y or lat first");
    sample.names[0] = sample.names[1] = NULL;
    sample.tile = 1;
    grid_sample_netcdf(&sample, path);
    assert_int_equal(truncate(path, 700), 0);
    EXPECT_REFUSAL(&body, "bad.nc", "not readable as NetCDF");
    sample.tile = 0; /* the classic format, which is read as far as it goes */
    grid_sample_netcdf(&sample, path);
    assert_int_equal(truncate(path, 300), 0);
    EXPECT_REFUSAL(&body, "bad.nc", "expected a whole file");
    FILE *file = fopen(path, "w");
    fputs("no grid\n", file);
    fclose(file);
    EXPECT_REFUSAL(&body, "bad.nc", "not readable as NetCDF");
    int id, x;
    assert_int_equal(nc_create(path, NC_CLOBBER, &id), NC_NOERR);
    assert_int_equal(nc_def_dim(id, "x", 3, &x), NC_NOERR);
    assert_int_equal(nc_close(id), NC_NOERR);
    EXPECT_REFUSAL(&body, "bad.nc", "its header has no variable of heights", "expected a whole file");
}

static void test_refused_places(void **state)
{
    (void)state;
    grid_sample sample = degrees;
    sample.height = slope;
    sample.epsg = 4326;
    sb_body body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "EPSG:32654", "domain from", "the key origin");
    body.projection = (char[]){"EPSG:4326"};
    EXPECT_REFUSAL(&body, "EPSG:4326", "not in metres");
    body.projection = (char[]){"UTM 54"};
    EXPECT_REFUSAL(&body, "UTM 54", "expected EPSG:<number>");
    sample.dx = 1;
    sample.columns = 60;
    sample.dy = 0.5;
    body = tiff_body(sample);
    EXPECT_REFUSAL(&body, "bad.tif", "over 60 degrees", "the key projection");
    char *path = path_of("degrees.asc");
    sample = degrees;
    sample.height = slope;
    write_text(path, &sample);
    body = grid_of(path);
    body.window = (sb_window){true, 500000, 4250000, 501000, 4251000};
    EXPECT_REFUSAL(&body, "degrees.asc", "if the file has degrees, give crs: EPSG:4326");
    body.crs = (char[]){"EPSG:4326"};
    body.window = (sb_window){true, 536000, 4252000, 537000, 4253000};
    sb_mesh mesh = make(&body);
    assert_true(mesh.vertex_count > 100);
    sb_mesh_free(&mesh);
}

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    DIR *all = opendir(folder);
    const struct dirent *entry;
    while (all && (entry = readdir(all))) unlinkat(dirfd(all), entry->d_name, 0);
    if (all) closedir(all);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_geotiff),
        cmocka_unit_test(test_netcdf),
        cmocka_unit_test(test_stated_depths),
        cmocka_unit_test(test_degrees_become_utm),
        cmocka_unit_test(test_domain_limits_the_window),
        cmocka_unit_test(test_stack),
        cmocka_unit_test(test_neighbours_join),
        cmocka_unit_test(test_voids_are_filled),
        cmocka_unit_test(test_resample_and_depths),
        cmocka_unit_test(test_refused_geotiff),
        cmocka_unit_test(test_refused_netcdf),
        cmocka_unit_test(test_refused_places),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}

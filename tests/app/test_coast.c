/* A coast from public kinds of files, by the steps of docs/guide.md: a GeoTIFF in UTM with voids and a vertical system,
   a finer text grid with another datum, and a NetCDF file in degrees. */
#include "grid_samples.h"
#include "program.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { EAST = 547000, NORTH = 4250000 };

/* m: the beach rises by 1 in 10 towards the east and meets the sea's level at x = 60 of the scene. */
static double beach(double x, double y)
{
    if (hypot(x - EAST - 80, y - NORTH - 20) < 12) return (double)NAN; /* a void beside the beach */
    return 0.1 * (x - EAST - 60);
}

/* The same from a chart whose zero is 1.5 m below. */
static double chart(double x, double y)
{
    (void)y;
    return 0.1 * (x - EAST - 60) + 1.5;
}

static double degrees(double x, double y)
{
    (void)y;
    return -5 + 200 * (x - 141.5357);
}

static const grid_sample survey = {.columns = 60,
                                   .rows = 50,
                                   .x = EAST - 100,
                                   .y = NORTH - 100,
                                   .dx = 5,
                                   .dy = 5,
                                   .height = beach,
                                   .nodata = -9999,
                                   .epsg = 32654,
                                   .vertical = 5773,
                                   .tile = 16};

static void write_chart(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols 30\nnrows 30\nxllcenter %d\nyllcenter %d\ncellsize 1\n", EAST + 20, NORTH + 5);
    for (int j = 0; j < 30; j++)
        for (int i = 0; i < 30; i++) fprintf(file, "%.6f\n", chart(EAST + 20 + i, 0));
    assert_int_equal(fclose(file), 0);
}

static void write_coast(const char *name, const char *grid)
{
    char text[1024];
    snprintf(text, sizeof text,
             "title: Coast\nresolution: 2\nduration: 0.1\ndomain: {min: [0, 0, -7], max: [100, 40, 6]}\n"
             "water: {level: 0, seed: [10, 20, -2]}\nbodies:\n  - {name: coast, shape: grid, %s}\n"
             "output: {plots: false}\n",
             grid);
    write_text(name, text);
}

static void a_stack_with_voids_and_a_datum(void **state)
{
    (void)state;
    grid_sample_tiff(&survey, in_folder("survey.tif"));
    write_chart(in_folder("chart.asc"));
    write_coast("coast.yaml", "files: [survey.tif, {file: chart.asc, datum: -1.5}], origin: [547000, 4250000], "
                              "voids: fill");
    outcome o = program_run((const char *const[]){"check", "coast.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "terrain \"coast\"");
    assert_contains(o.out, "survey.tif: EPSG:32654; 60 x 50 nodes, 5 x 5 m; from (546897.5, 4249897.5)");
    assert_contains(o.out, "vertical datum: EPSG:5773");
    assert_contains(o.out, "chart.asc: no coordinate system, taken as metres");
    assert_contains(o.out, "-1.5 m added to its heights");
    assert_contains(o.out, "interpolated from the heights around them");
    assert_null(strstr(o.out, "warning: body \"coast\""));
    outcome_free(&o);
    o = program_run((const char *const[]){"check", "coast.yaml", "--set", "bodies[0].voids=keep", NULL});
    assert_contains(o.out, "kept as holes; `voids: fill` fills them");
    assert_contains(o.out, "has no height (nodata)");
    outcome_free(&o);
    o = program_run((const char *const[]){"run", "coast.yaml", "--out", "coast", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    outcome_free(&o);
}

/* Two gauges of GeoClaw at the sea side of the survey, in its coordinates: a wave of 0.5 m over a sea whose level is
   that of the survey's zero. By the steps of docs/open-sea.md. */
static void write_gauges(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int gauge = 0; gauge < 2; gauge++) {
        fprintf(file,
                "# gauge_id= %4d location=( %17.10E %17.10E ) num_eqn=  4\n# Columns: level time q(1 ... num_eqn)\n",
                gauge + 1, (double)EAST, (double)NORTH + 40 * gauge);
        for (int k = 0; k <= 20; k++) {
            const double t = 0.5 * k, eta = 0.25 * (1 - cos(2 * M_PI * t / 10)), depth = 6 + eta;
            const double u = eta * sqrt(9.81 / 6);
            fprintf(file, " 01 %15.7E %15.7E %15.7E %15.7E %15.7E\n", t, depth, depth * u, 0.0, eta);
        }
    }
    assert_int_equal(fclose(file), 0);
}

static void a_table_of_geoclaw_enters_a_real_coast(void **state)
{
    (void)state;
    grid_sample_tiff(&survey, in_folder("survey.tif"));
    write_gauges(in_folder("line.txt"));
    write_coast("waves.yaml", "file: survey.tif, origin: [547000, 4250000], voids: fill");
    const char *const settings[] = {"--set", "domain.sides={x_min: sea}",
                                    "--set", "sea={source: table, file: line.txt, datum: 0, zero: [547000, 4250000]}",
                                    "--set", "duration=2",
                                    "--set", "measure={interval: 0.5, gauges: [{name: sea, x: 30, y: 20}]}"};
    const char *check[2 + 8 + 1] = {"check", "waves.yaml"}, *run[2 + 8 + 3] = {"run", "waves.yaml"};
    for (int k = 0; k < 8; k++) check[2 + k] = run[2 + k] = settings[k];
    run[10] = "--out";
    run[11] = "waves";
    outcome o = program_run(check);
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "a table of 2 points, datum 0 m");
    assert_contains(o.out, "vertical datum: EPSG:5773");
    outcome_free(&o);
    o = program_run(run);
    if (o.status != 0) fail_msg("%s", o.err);
    outcome_free(&o);
    assert_true(json_number_of("waves/summary.json", "sea_J") > 0);
}

/* A survey in degrees, around (546780, 4249750) m of its UTM zone. */
static const grid_sample in_degrees = {.columns = 60,
                                       .rows = 60,
                                       .x = 141.53,
                                       .y = 38.39,
                                       .dx = 0.0002,
                                       .dy = 0.0002,
                                       .height = degrees,
                                       .geographic = true,
                                       .northward = true,
                                       .standard_name = "height_above_mean_sea_level"};

static void degrees_are_projected(void **state)
{
    (void)state;
    grid_sample_netcdf(&in_degrees, in_folder("degrees.nc"));
    write_coast("degrees.yaml", "file: degrees.nc, origin: [546780, 4249750]");
    outcome o = program_run((const char *const[]){"check", "degrees.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "degrees.nc: EPSG:4326, projected; 60 x 60 nodes, 0.0002 x 0.0002 degrees");
    assert_contains(o.out, "ground: EPSG:32654, the UTM zone of the finest file");
    assert_contains(o.out, "vertical datum: height_above_mean_sea_level");
    outcome_free(&o);
    o = program_run((const char *const[]){"check", "degrees.yaml", "--json", NULL});
    assert_contains(o.out, "\"terrain\": \"degrees.nc: EPSG:4326, projected");
    outcome_free(&o);
}

/* The same survey as the bed of a depth-averaged model, moved to the scene's places, under a grid that is named alone.
 */
static void a_survey_is_the_bed_of_a_grid(void **state)
{
    (void)state;
    write_text("sea.asc",
               "ncols 3\nnrows 3\nxllcorner -100\nyllcorner -100\ncellsize 100\n-9 -9 -9\n-9 -9 -9\n-9 -9 -9\n");
    grid_sample_tiff(&survey, in_folder("survey.tif"));
    write_text("bed.yaml",
               "title: Bed\nduration: 1\ndomain: {min: [-20, -20, -20], max: [60, 60, 10]}\n"
               "offshore: {cell: 10, level: 0, terrain: [sea.asc, {file: survey.tif, shift: [-547000, -4250000]}]}\n"
               "output: {plots: false, particle_interval: 1}\nmeasure: {gauges: [{name: g, x: 0, y: 0}]}\n");
    outcome o = program_run((const char *const[]){"check", "bed.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "8 x 8 of 10 m, 64 wet");
    assert_contains(o.out, "read at the centres of cells of 10 m, linear between the nodes of offshore.terrain");
    assert_contains(o.out,
                    "  offshore.terrain[0]\n    sea.asc: no coordinate system, taken as metres; 3 x 3 nodes, "
                    "100 x 100 m; from (-100, -100) to (200, 200) m; vertical datum: none stated\n"
                    "    ground: metres as in the file; 3 x 3 nodes of 100 x 100 m; from (-50, -50) to (150, "
                    "150) m; heights -9 to -9 m; no voids\n"
                    "  offshore.terrain[1]\n    survey.tif: EPSG:32654; 60 x 50 nodes, 5 x 5 m; from (546897.5, "
                    "4249897.5) to (547197.5, 4250147.5) m; vertical datum: EPSG:5773\n    ground: EPSG:32654; ");
    /* The 21 nodes within 12 m of the void's middle. */
    assert_contains(o.out, "; 21 voids (0.7 %), left to the grids before it; moved by (-547000, -4250000, 0) m\n");
    outcome_free(&o);
    o = program_run((const char *const[]){"check", "bed.yaml", "--set", "offshore.level=-5", NULL});
    assert_contains(o.out, "8 x 8 of 10 m, 24 wet"); /* the beach is below -5 m where x < 10 */
    outcome_free(&o);
}

/* A file in degrees is the bed in metres of its UTM zone. It rises by 200 m per degree towards the east and is 5 m deep
   at 141.5357 degrees, which are 546779.841 m of easting in the middle of the domain, at a northing of 4249770 m, where
   a degree has 87324 m (Krueger's series on WGS 84). */
static void degrees_are_the_bed_of_a_grid(void **state)
{
    (void)state;
    grid_sample sample = in_degrees;
    sample.tile = 1;
    grid_sample_netcdf(&sample, in_folder("gebco.nc"));
    write_text("degrees-bed.yaml",
               "title: Bed\nduration: 1\ndomain: {min: [0, 0, -20], max: [100, 40, 10]}\n"
               "offshore: {cell: 10, level: -5, terrain: [{file: gebco.nc, shift: [-546730, -4249750]}]}\n"
               "output: {plots: false, particle_interval: 0}\n");
    outcome o = program_run((const char *const[]){"check", "degrees-bed.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "10 x 4 of 10 m, 20 wet");
    assert_contains(o.out, "gebco.nc: EPSG:4326, projected; 60 x 60 nodes, 0.0002 x 0.0002 degrees (17.47 m)");
    assert_contains(o.out, "vertical datum: height_above_mean_sea_level");
    assert_contains(o.out, "ground: EPSG:32654, the UTM zone of the finest file");
    outcome_free(&o);
    o = program_run((const char *const[]){"run", "degrees-bed.yaml", "--out", "degrees-bed", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    outcome_free(&o);
    /* The five wet columns have the depths d, d - 10 s, ... with d at x = 5 m and the slope s. 0.2 m3 are 0.04 m of
       easting. */
    const double slope = 200 / 87324., first = slope * (49.841 - 5);
    assert_near(json_number_of("degrees-bed/summary.json", "start_m3"), 10 * 40 * 5 * (first - 20 * slope), 0.2);
    assert_true(exists("degrees-bed/maps/max_depth.asc"));
}

/* Grids of the bed may be placed like those of bodies: text in degrees, and one projection for all. */
static void grids_of_the_bed_have_coordinate_systems(void **state)
{
    (void)state;
    write_text("gebco.asc", "ncols 2\nnrows 2\nxllcenter 141.53\nyllcenter 38.39\ncellsize 0.012\n-9 -9\n-9 -9\n");
    grid_sample_netcdf(&in_degrees, in_folder("fine.nc"));
    write_text("zones.yaml", "title: Bed\nduration: 1\ndomain: {min: [0, 0, -20], max: [100, 40, 10]}\n"
                             "offshore: {cell: 10, level: 0, terrain: [{file: gebco.asc, crs: EPSG:4326, "
                             "shift: [-546730, -4249750]}]}\noutput: {plots: false}\n");
    outcome o = program_run((const char *const[]){"check", "zones.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "gebco.asc: EPSG:4326, projected; 2 x 2 nodes");
    assert_contains(o.out, "10 x 4 of 10 m, 40 wet");
    outcome_free(&o);
    o = program_run((const char *const[]){"check", "zones.yaml", "--set", "offshore.terrain=[gebco.asc]", NULL});
    assert_int_equal(o.status, 1);
    assert_one_line(o.err, "these look like longitudes and latitudes, expected metres, or the key crs");
    outcome_free(&o);
    /* In the zone beside it, the same shift would put the grid elsewhere. */
    o = program_run((const char *const[]){"check", "zones.yaml", "--set",
                                          "offshore.uplift={file: fine.nc, projection: EPSG:32653, "
                                          "shift: [-546730, -4249750]}",
                                          NULL});
    assert_int_equal(o.status, 1);
    assert_one_line(o.err, "offshore.uplift: its projection EPSG:32653 puts its first node 5.2");
    assert_contains(o.err, "from where EPSG:32654 of the grids before it does, expected the same projection for all");
    outcome_free(&o);
    /* Without the key it has the projection of the grids before it, though it is the middle of another zone. */
    grid_sample west = in_degrees;
    west.x -= 8;
    grid_sample_netcdf(&west, in_folder("west.nc"));
    o = program_run((const char *const[]){"check", "zones.yaml", "--set",
                                          "offshore.terrain=[{file: gebco.asc, crs: EPSG:4326, shift: [-546730, "
                                          "-4249750]}, {file: west.nc, shift: [-546730, -4249750]}]",
                                          NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(o.out, "west.nc: EPSG:4326, projected");
    assert_contains(o.out, "    ground: EPSG:32654; ");
    outcome_free(&o);
    /* Another name of the same system is no other place. */
    o = program_run((const char *const[]){"check", "zones.yaml", "--set",
                                          "offshore.uplift={file: fine.nc, projection: +proj=utm +zone=54 "
                                          "+datum=WGS84 +type=crs, shift: [-546730, -4249750]}",
                                          NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    outcome_free(&o);
}

/* When the bodies are the bed, their grid has the projection of the uplift. */
static void an_uplift_has_the_projection_of_the_bodies(void **state)
{
    (void)state;
    grid_sample_tiff(&survey, in_folder("survey.tif"));
    grid_sample_netcdf(&in_degrees, in_folder("fine.nc"));
    write_text("bodies.yaml", "title: Bed\nduration: 1\ndomain: {min: [0, 0, -20], max: [100, 40, 10]}\n"
                              "bodies:\n  - {name: coast, shape: grid, file: survey.tif, origin: [547000, 4250000], "
                              "voids: fill}\n"
                              "offshore: {cell: 10, level: 0, uplift: {file: fine.nc, projection: EPSG:32653, "
                              "shift: [-547000, -4250000]}}\noutput: {plots: false}\n");
    outcome o = program_run((const char *const[]){"check", "bodies.yaml", NULL});
    assert_int_equal(o.status, 1);
    assert_one_line(o.err, "offshore.uplift: its projection EPSG:32653 puts its first node 5.2");
    assert_contains(o.err, "from where EPSG:32654 of the grids before it does");
    outcome_free(&o);
    o = program_run(
        (const char *const[]){"check", "bodies.yaml", "--set", "offshore.uplift.projection=EPSG:32654", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    outcome_free(&o);
}

/* A text grid as a body, with keys that change its places and heights. */
static void a_text_grid_is_told(void **state)
{
    (void)state;
    write_text("sea.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 50\n5 5 5\n-9999 5 5\n5 5 4\n");
    write_coast("text.yaml", "file: sea.asc, positive: down, datum: -0.5, translate: [-25, -25, 0]");
    outcome o = program_run((const char *const[]){"check", "text.yaml", NULL});
    if (o.status != 0) fail_msg("%s", o.err);
    assert_contains(
        o.out, "  terrain \"coast\"\n    sea.asc: no coordinate system, taken as metres; 3 x 3 nodes, 50 x 50 m; "
               "from (0, 0) to (150, 150) m; vertical datum: none stated\n    ground: metres as in the file; 3 x 3 "
               "nodes of 50 x 50 m; from (25, 25) to (125, 125) m; heights -5.5 to -4.5 m, of which datum -0.5 m; "
               "1 voids (11.1 %), kept as holes; `voids: fill` fills them; moved by (-25, -25, 0) m\n");
    outcome_free(&o);
}

static void expect_refusal(const char *grid, const char *name, const char *expected)
{
    write_coast("bad.yaml", grid);
    outcome o = program_run((const char *const[]){"check", "bad.yaml", NULL});
    assert_int_equal(o.status, 1);
    assert_one_line(o.err, name);
    assert_contains(o.err, expected);
    outcome_free(&o);
}

static void refusals_name_the_remedy(void **state)
{
    (void)state;
    grid_sample_tiff(&survey, in_folder("survey.tif"));
    expect_refusal("file: survey.tif", "survey.tif", "the key origin is the place that becomes (0, 0)");
    expect_refusal("file: survey.tif, files: [survey.tif]", "file", "files");
    write_text("degrees.asc", "ncols 3\nnrows 2\nxllcorner 41\nyllcorner 37\ncellsize 0.001\n-6 -6 -6\n-6 -6 -6\n");
    expect_refusal("file: degrees.asc", "body \"coast\": its grid is 0.002 m x 0.001 m large", "give crs: EPSG:4326");
    expect_refusal("files: []", "bad.yaml", "files");
    expect_refusal("files: [survey.tif, none.asc]", "files[1].file", "none.asc");
    expect_refusal("file: survey.tif, window: {min: [3, 0], max: [2, 9]}", "window.max", "expected min < max");
    expect_refusal("file: survey.tif, resample: 0.0001, origin: [547000, 4250000]", "survey.tif",
                   "a smaller window, or a larger resample");
    expect_refusal("file: survey.tif, projection: EPSG:6668", "EPSG:6668", "is not in metres");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stack_with_voids_and_a_datum),
        cmocka_unit_test(a_table_of_geoclaw_enters_a_real_coast),
        cmocka_unit_test(degrees_are_projected),
        cmocka_unit_test(a_survey_is_the_bed_of_a_grid),
        cmocka_unit_test(degrees_are_the_bed_of_a_grid),
        cmocka_unit_test(a_text_grid_is_told),
        cmocka_unit_test(grids_of_the_bed_have_coordinate_systems),
        cmocka_unit_test(an_uplift_has_the_projection_of_the_bodies),
        cmocka_unit_test(refusals_name_the_remedy),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}

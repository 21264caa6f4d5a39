/* The comparison of runs: its values against those of the fixture, error bars, refusals, warnings, and its files. */
#include "compare_fixture.h"

#include "report/report.h"

#include <math.h>

#define COMPARE(error, ...)                                                                                            \
    compare_runs((const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *),      \
                 NULL, error)

static void expect(int status, const char *const *names, size_t count, const char *expected)
{
    sb_error error = {0};
    assert_int_equal(compare_runs(names, count, NULL, &error), status);
    assert_has(error.text, expected);
    assert_null(strchr(error.text, '\n'));
}
#define REFUSED(expected, ...)                                                                                         \
    expect(SB_BAD_INPUT, (const char *const[]){__VA_ARGS__},                                                           \
           sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *), expected)

/* The columns mean, least, greatest, difference and difference_percent of a row of compare.csv; NaN: empty. */
static void read_row(const char *csv, const char *start, double out[5])
{
    char line[128];
    snprintf(line, sizeof line, "\n%s,", start);
    const char *at = strstr(csv, line);
    if (!at) fail_msg("no row %s in:\n%s", start, csv);
    at += strlen(line);
    at = strchr(at, ','); /* behind the number of runs */
    for (int k = 0; k < 5; k++) {
        char *end;
        at++;
        out[k] = strtod(at, &end);
        if (end == at) out[k] = NAN;
        at = strchr(at, ',');
    }
}

static void assert_row(const char *csv, const char *start, double mean, double least, double most, double difference)
{
    double row[5];
    read_row(csv, start, row);
    const double expected[4] = {mean, least, most, difference};
    for (int k = 0; k < 4; k++) {
        if (isnan(expected[k]) != isnan(row[k]))
            fail_msg("%s: column %d is %g, expected %g", start, k, row[k], expected[k]);
        if (!isnan(row[k])) assert_near(row[k], expected[k], 1e-6 * (1 + fabs(expected[k])));
    }
}

static double impulse(double factor)
{
    double sum = 0;
    for (int row = 10; row <= 100; row++) sum += 5 * 0.1 * row * factor * 0.1;
    return sum;
}

static void two_scenes(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    sb_error error = {0};
    if (COMPARE(&error, "low", "high") != SB_OK) fail_msg("%s", error.text);
    char *csv = text_of("out/compare.csv");
    assert_row(csv, "body,house,force,N,low", 100, 100, 100, NAN);
    assert_row(csv, "body,house,force,N,high", 50, 50, 50, -50);
    assert_row(csv, "body,barn,force,N,high", 100, 100, 100, -100);
    assert_row(csv, "body,house,force_time,s,high", 10, 10, 10, 0);
    assert_row(csv, "body,house,impulse,N s,low", impulse(2), impulse(2), impulse(2), NAN);
    assert_row(csv, "body,house,moment,N m,high", 130, 130, 130, -130);
    assert_row(csv, "body,house,first_wet,s,low", 1, 1, 1, NAN);
    assert_row(csv, "body,dry,force,N,low", 0, 0, 0, NAN);
    assert_row(csv, "body,dry,first_wet,s,low", NAN, NAN, NAN, NAN);
    /* The house is in the cell (1, 1). One cell lies before each of its sides; the greatest is that in the north,
       (1, 2). Of the barn no rectangle is known. */
    assert_row(csv, "body,house,depth,m,low", 42, 42, 42, NAN);
    assert_row(csv, "body,house,depth,m,high", 21, 21, 21, -21);
    assert_row(csv, "body,barn,depth,m,high", NAN, NAN, NAN, NAN);
    assert_row(csv, "gauge,near,surface,m,high", 0.6, 0.6, 0.6, -0.6);
    assert_row(csv, "plane,crest,volume,m³,high", 7, 7, 7, -7);
    assert_row(csv, "plane,crest,volume_end,m³,low", 4, 4, 4, NAN);
    assert_row(csv, "line,up,runup,m,high", 3, 3, 3, -3);
    assert_row(csv, "map,all,flooded_area,m²,low", 8, 8, 8, NAN);
    assert_row(csv, "map,all,flooded_area,m²,high", 6, 6, 6, -2);
    assert_row(csv, "map,all,flooded_depth,m,high", 23, 23, 23, 23 - 66);
    sb_free(csv);
    /* Times of inundation are only on land. */
    FILE *f = open_text("high", "maps/inundation_time.asc");
    fputs("ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n"
          "-9999 0 0 0\n0 0 0 0\n0 0 0 3\n0 0 0 -9999\n",
          f);
    fclose(f);
    if (COMPARE(&error, "low", "high") != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(unlink(in_folder("high/maps/inundation_time.asc")), 0);
    csv = text_of("out/compare.csv");
    assert_row(csv, "map,all,flooded_area,m²,high", 1, 1, 1, -7);
    assert_has(csv, ",no\n");
    assert_has(csv, ",yes\n");
    sb_free(csv);
}

static void write_ground(const char *run, const char *rows)
{
    FILE *f = open_text(run, "maps/ground.asc");
    fprintf(f, "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n%s", rows);
    assert_int_equal(fclose(f), 0);
}

/* A wall in column 2 is no ground, and column 3 of the first row was under water at the start. */
static void crests_are_no_ground(void **state)
{
    (void)state;
    static const char rows[] = "1 1 -9999 1\n1 1 -9999 1\n1 1 -9999 1\n1 1 -9999 -9999\n";
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    write_ground("low", rows);
    sb_error error = {0};
    /* One of the runs is of an earlier version: the walls count in both. */
    if (COMPARE(&error, "low", "high") != SB_OK) fail_msg("%s", error.text);
    char *csv = text_of("out/compare.csv");
    assert_row(csv, "map,all,flooded_area,m²,low", 8, 8, 8, NAN);
    assert_row(csv, "map,all,flooded_area,m²,high", 6, 6, 6, -2);
    sb_free(csv);
    write_ground("high", rows);
    if (COMPARE(&error, "low", "high") != SB_OK) fail_msg("%s", error.text);
    csv = text_of("out/compare.csv");
    assert_row(csv, "map,all,flooded_area,m²,low", 3, 3, 3, NAN);
    assert_row(csv, "map,all,flooded_area,m²,high", 2, 2, 2, -1);
    assert_row(csv, "map,all,flooded_depth,m,high", 23, 23, 23, 23 - 66);
    sb_free(csv);
    assert_int_equal(unlink(in_folder("low/maps/ground.asc")), 0);
    assert_int_equal(unlink(in_folder("high/maps/ground.asc")), 0);
}

static void map_of_the_difference(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    assert_int_equal(COMPARE(NULL, "low", "high"), SB_OK);
    char *text = text_of("out/depth-difference-2.asc");
    assert_non_null(text);
    const char *at = strstr(text, "NODATA_value -9999\n") + strlen("NODATA_value -9999\n");
    for (int row = 3; row >= 0; row--) /* the northernmost row comes first */
        for (int c = 0; c < 4; c++) {
            char *end;
            const double low = 2 * (c + 10 * row), high = row == 3 ? 0 : c + 10 * row;
            assert_near(strtod(at, &end), high - low, 1e-6);
            at = end;
        }
    sb_free(text);
    /* Other cells: no map, and the page says why. */
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    FILE *f = open_text("high", "maps/max_depth.asc");
    fputs("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n1\n", f);
    fclose(f);
    assert_int_equal(COMPARE(NULL, "low", "high"), SB_OK);
    text = text_of("out/compare.html");
    assert_has(text, "their maps have different cells");
    sb_free(text);
}

/* Runs of one scene with three seeds are one entry: mean and range; a difference within both ranges is marked. */
static void seeds_are_error_bars(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "a1", .seed = 1, .wall = 0.5, .factor = 1});
    make_run_of((made_run){.name = "a2", .seed = 2, .wall = 0.5, .factor = 1.5});
    make_run_of((made_run){.name = "a3", .seed = 3, .wall = 0.5, .factor = 1.1});
    make_run_of((made_run){.name = "b1", .seed = 1, .wall = 0.8, .factor = 1.4});
    make_run_of((made_run){.name = "b2", .seed = 2, .wall = 0.8, .factor = 1.6});
    make_run_of((made_run){.name = "c1", .seed = 1, .wall = 0.9, .factor = 3});
    make_run_of((made_run){.name = "c2", .seed = 2, .wall = 0.9, .factor = 4});
    char *terminal = NULL;
    static const char *const names[] = {"a1", "b1", "a2", "c1", "a3", "b2", "c2"};
    sb_error error = {0};
    if (compare_runs(names, 7, &terminal, &error) != SB_OK) fail_msg("%s", error.text);
    char *csv = text_of("out/compare.csv");
    assert_row(csv, "body,house,force,N,a1", 60, 50, 75, NAN);
    assert_row(csv, "body,house,force,N,b1", 75, 70, 80, 15);
    assert_row(csv, "body,house,force,N,c1", 175, 150, 200, 115);
    assert_has(csv, "body,house,force,N,a1,3,");
    assert_has(terminal, "75 (~+25 %)");
    assert_has(terminal, "175 (+192 %)");
    assert_has(terminal, "a1 (3 runs)");
    char *page = text_of("out/compare.html");
    assert_has(page, "50 to 75");
    assert_has(page, "7 runs of 3 scenes");
    assert_null(strstr(page, "one run only"));
    sb_free(page);
    static const char *const some[] = {"a1", "a2", "b1"};
    if (compare_runs(some, 3, NULL, &error) != SB_OK) fail_msg("%s", error.text);
    page = text_of("out/compare.html");
    assert_has(page, "Of 2 scenes 1 has one run only, without error bars.");
    sb_free(page);
    sb_free(csv);
    free(terminal);
}

static void what_cannot_be_compared(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "other", .seed = 1, .wall = 0.5, .factor = 2, .status = "running"});
    mkdir(in_folder("empty"), 0777);
    REFUSED("other: the status of the run is running: expected done", "low", "other");
    REFUSED("empty: expected the folder of a run", "low", "empty");
    REFUSED("none: expected the folder of a run", "none", "low");
    REFUSED("low: is given twice", "low", "low");
    REFUSED("1 run given: expected 2", "low");
    make_run_of((made_run){.name = "other", .seed = 1, .wall = 0.5, .factor = 2, .ground = "hill.obj"});
    REFUSED("have different ground: bodies.ground.file differs", "low", "other");
    make_run_of((made_run){.name = "other", .seed = 1, .wall = 0.5, .factor = 2});
    FILE *f = open_text("other", "forces.csv");
    fputs("time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm\n1,else,1,1,1,1,1,1\n", f);
    fclose(f);
    static const char *const tables[] = {"gauges.csv", "overtopping.csv", "runup.csv"};
    for (int t = 0; t < 3; t++) {
        char name[64];
        snprintf(name, sizeof name, "other/%s", tables[t]);
        unlink(in_folder(name));
    }
    REFUSED("have no body, gauge, line, plane or probe in common", "low", "other");
    f = open_text("other", "summary.json");
    fputs("{\"status\":\"done\",\"dimensions\":2}", f);
    fclose(f);
    REFUSED("have 3 and 2 dimensions", "low", "other");
    f = open_text("other", "scene.yaml");
    fputs("title: [", f);
    fclose(f);
    REFUSED("other/scene.yaml: no key dimensions: expected the scene", "low", "other");
}

/* A folder of other files is left as it is; an earlier comparison is replaced. */
static void places(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    const char *paths[2];
    char one[SB_PATH_MAX], other[SB_PATH_MAX];
    snprintf(one, sizeof one, "%s", in_folder("low"));
    snprintf(other, sizeof other, "%s", in_folder("high"));
    paths[0] = one;
    paths[1] = other;
    sb_error error = {0};
    const sb_compare_options options = {0};
    assert_int_equal(sb_compare_write(paths, 2, in_folder("low"), &options, &error), SB_BAD_INPUT);
    assert_has(error.text, "and no comparison: expected a new or an empty folder");
    assert_int_equal(sb_compare_write(paths, 2, in_folder("new/deep"), &options, NULL), SB_OK);
    assert_int_equal(sb_compare_write(paths, 2, in_folder("new/deep"), &options, NULL), SB_OK);
    assert_int_equal(access(in_folder("new/deep/compare.html"), F_OK), 0);
}

static void warnings_of_unequal_runs(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
    make_run_of((made_run){.name = "fine", .seed = 1, .wall = 0.5, .factor = 1, .resolution = 0.05, .duration = 12});
    char *terminal = NULL;
    static const char *const names[] = {"low", "fine"};
    assert_int_equal(compare_runs(names, 2, &terminal, NULL), SB_OK);
    assert_has(terminal, "warning: resolution differs: 0.1 m in low, 0.05 m in fine.");
    assert_has(terminal, "warning: duration differs: 10 s in low, 12 s in fine.");
    free(terminal);
    make_run_of((made_run){.name = "fine", .seed = 1, .wall = 0.7, .factor = 1});
    assert_int_equal(compare_runs(names, 2, &terminal, NULL), SB_OK);
    assert_null(strstr(terminal, "warning"));
    free(terminal);
}

static void the_page(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "<img src=x>", .seed = 1, .wall = 0.5, .factor = 2, .body = "\"a\"\"<b>,c\""});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
    assert_int_equal(COMPARE(NULL, "<img src=x>", "high"), SB_OK);
    char *text = text_of("out/compare.html"), *csv = text_of("out/compare.csv");
    static const char *const parts[] = {
        SB_COMPARE_START,
        "<title>&lt;img src=x&gt;, high</title>",
        "<th scope=\"row\">bodies.wall.max</th><td>[1.2, 4, 0.5] m</td><td>[1.2, 4, 1.5] m",
        "On 1 of 3 loaded bodies the force is marked as not reliable",
        "Each scene has one run, so there are no error bars",
        "not in this run",
        "a&quot;&lt;b&gt;,c",
        "\"items\":[\"house\",\"house\",",
        "No force acted in any run on: dry.",
        "default-src 'none'",
        "Greatest depth on it"};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++) assert_has(text, parts[p]);
    assert_null(strstr(text, "<img src=x"));
    assert_null(strstr(text, " src=\"http"));
    assert_has(csv, "\"a\"\"<b>,c\"");
    sb_free(text);
    sb_free(csv);
}

/* Three runs with 20000 rows each: below the limit, and peaks of one row are kept. */
static void long_runs(void **state)
{
    (void)state;
    static const char *const names[] = {"x", "y", "z"};
    for (int r = 0; r < 3; r++)
        make_run_of((made_run){.name = names[r], .seed = 1, .wall = 0.5 + 0.1 * r, .factor = r + 1, .rows = 20000});
    assert_int_equal(compare_runs(names, 3, NULL, NULL), SB_OK);
    char *text = text_of("out/compare.html");
    assert_true(strlen(text) < SB_REPORT_BYTES_MAX);
    assert_has(text, "so that no peak is lost");
    assert_has(text, "\\n10,90,120,0,150,360,0\\n");
    sb_free(text);
}

/* Files of a run are cut or noise: one line, or a page without their part, and no crash. */
static void damaged_files(void **state)
{
    (void)state;
    static const char *const files[] = {
        "summary.json", "run.jsonl",          "scene.yaml",      "forces.csv",
        "gauges.csv",   "maps/max_depth.asc", "overtopping.csv", "maps/arrival_time.asc"};
    static const char *const noises[] = {
        "", "\x01{[ noise,\n,,\n\"\xfe", "- - -\n:\n  - a: \"\n- name: x\n   y\n",
        "{\"status\":\"done\",\"dimensions\":3,\"bodies\":[{\"name\":\"house\",\"min_m\":[1]},7]}"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++)
        for (size_t n = 0; n < sizeof noises / sizeof *noises; n++) {
            sb_error error = {0};
            make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2});
            make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1});
            FILE *file = open_text("high", files[f]);
            fputs(noises[n], file);
            fclose(file);
            const sb_status status = COMPARE(&error, "low", "high");
            assert_true(status == SB_OK || (status == SB_BAD_INPUT && *error.text && !strchr(error.text, '\n')));
        }
}

/* Each allocation in turn fails: the page is written without a part, or not at all. */
static void memory_that_runs_out(void **state)
{
    (void)state;
    make_run_of((made_run){.name = "low", .seed = 1, .wall = 0.5, .factor = 2, .rows = 20});
    make_run_of((made_run){.name = "high", .seed = 1, .wall = 1.5, .factor = 1, .rows = 20});
    long n = 0;
    for (bool pending = false; !pending;) {
        sb_error error = {0};
        unlink(in_folder("out/compare.html"));
        unlink(in_folder("out/compare.csv"));
        unlink(in_folder("out/depth-difference-2.asc"));
        sb_memory_fail_at(++n);
        const sb_status status = COMPARE(&error, "low", "high");
        pending = sb_memory_fail_pending();
        sb_memory_fail_at(0);
        if (pending) assert_int_equal(status, SB_OK);
        assert_int_equal(status == SB_OK, access(in_folder("out/compare.html"), F_OK) == 0);
        assert_int_equal(status == SB_OK, *error.text == '\0');
    }
    assert_true(n > 50);
}

static int empty_out(void **state)
{
    (void)state;
    char command[SB_PATH_MAX + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", in_folder("out"));
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(two_scenes, empty_out),
        cmocka_unit_test_setup(crests_are_no_ground, empty_out),
        cmocka_unit_test_setup(map_of_the_difference, empty_out),
        cmocka_unit_test_setup(seeds_are_error_bars, empty_out),
        cmocka_unit_test_setup(what_cannot_be_compared, empty_out),
        cmocka_unit_test_setup(places, empty_out),
        cmocka_unit_test_setup(warnings_of_unequal_runs, empty_out),
        cmocka_unit_test_setup(the_page, empty_out),
        cmocka_unit_test_setup(long_runs, empty_out),
        cmocka_unit_test_setup(damaged_files, empty_out),
        cmocka_unit_test_setup(memory_that_runs_out, empty_out),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}

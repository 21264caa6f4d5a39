/* Runs whose sea is a depth-averaged model beside the particles, as a user makes them. */
#include "base/memory.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 0.4 m of water: particles on 4 m before a wall, the grid on 10 m. */
#define HEAD                                                                                                           \
    "title: t\ndimensions: 2\nresolution: 0.04\nduration: 3\nnumerics: {settle_steps: 20}\n"                           \
    "output: {plots: false, particle_interval: 0.5}\n"                                                                 \
    "measure: {interval: 0.02, gauges: [{name: g, x: 1.2}]}\n"                                                         \
    "water: {level: 0.4, seed: [1, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8], sides: {x_min: sea}}\n"                 \
    "sea: {source: offshore}\n"
#define GRID(more)                                                                                                     \
    "offshore: {cell: 0.04, min: [-6], max: [4], manning: 0, sides: {x_min: wall}, " more                              \
    "wave: {kind: solitary, height: 0.1, depth: 0.4, position: -2, theory: serre}}\n"

/* A row of gauges.csv per instant: the highest surface over the still level from a time to another; *when: its time. */
static double highest_at(const char *run, const char *gauge, double from, double to, double *when)
{
    char path[64], cell[16];
    snprintf(path, sizeof path, "%s/gauges.csv", run);
    snprintf(cell, sizeof cell, ",%s,", gauge);
    char *table = text_of(path), *save = NULL;
    double highest = -1;
    for (char *row = strtok_r(table, "\n", &save); row; row = strtok_r(NULL, "\n", &save)) {
        const char *eta = strstr(row, cell);
        const double time = strtod(row, NULL);
        if (!eta || time < from || time >= to || !(strtod(eta + strlen(cell), NULL) > highest)) continue;
        highest = strtod(eta + strlen(cell), NULL);
        *when = time;
    }
    sb_free(table);
    return highest;
}

static double highest_between(const char *run, double from, double to)
{
    double when;
    return highest_at(run, "g", from, to, &when);
}

/* Depths of the cells of a grid file, which are the first 250 of the second array. */
static void depths_of(const char *path, float depth[250])
{
    FILE *file = fopen(in_folder("%s", path), "rb");
    static char bytes[1 << 16];
    assert_non_null(file);
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    const char *start = memmem(bytes, length, "encoding=\"raw\">\n_", 17);
    assert_non_null(start);
    start += 17 + 8 + 250 * sizeof(float) + 8;
    assert_true(start + 250 * sizeof(float) <= bytes + length);
    memcpy(depth, start, 250 * sizeof(float));
}

/* Volume of the grid's water outside of the particles' domain, and its highest surface there. */
static double volume_outside(const char *path, double *highest)
{
    float depth[250];
    double volume = 0;
    depths_of(path, depth);
    *highest = -1;
    for (int i = 0; i < 150; i++) {
        volume += 0.04 * (double)depth[i];
        if (i < 140) *highest = fmax(*highest, (double)depth[i] - 0.4);
    }
    return volume;
}

/* Volume of the particles per metre, at the start of a run or at its end. */
static double volume_of_particles(const char *run, const char *when)
{
    char path[64];
    snprintf(path, sizeof path, "%s/summary.json", run);
    char *text = text_of(path), *at = strstr(text, when);
    assert_non_null(at);
    at = strstr(at, "\"mass_kg\":");
    assert_non_null(at);
    const double volume = strtod(at + strlen("\"mass_kg\":"), NULL) / 1000;
    sb_free(text);
    return volume;
}

/* The wave of the grid passes the gauge, is reflected by the wall, and continues in the grid. Ten layers of water: the
   bounds of its height are wide. */
static void a_wave_comes_in_and_leaves(void **state)
{
    (void)state;
    double highest, first = 0;
    write_text("nested.yaml", HEAD GRID("coupling: two-way, "));
    outcome o = RUN(0, "check", "nested.yaml");
    assert_contains(o.out, "the depth-averaged model, 250 x 1 cells of 0.04 m, two-way");
    assert_contains(o.out, "  grid               250 cells");
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "two-way", "--quiet", "--set", "duration=6");
    assert_near(highest_between("two-way", 0, 2.4), 0.1, 0.008);
    first = volume_outside("two-way/grid/000001.vti", &highest);
    assert_near(highest, 0.1, 1e-3);
    const double last = volume_outside("two-way/grid/000013.vti", &highest);
    assert_near(highest, 0.1, 0.006);
    const double begins = first + volume_of_particles("two-way", "\"energy_start\"");
    assert_true(begins > first + 1.5);
    assert_near(last + volume_of_particles("two-way", "\"energy_end\""), begins, 1e-3 * begins);
    assert_true(highest_between("two-way", 5.6, 6) < 0.006);
}

static void bits_are_those_of_any_threads_and_of_a_resumed_run(void **state)
{
    (void)state;
    static const char *const files[] = {"gauges.csv",
                                        "energy.csv",
                                        "grid.pvd",
                                        "grid/000003.vti",
                                        "maps/grid_max_depth.asc",
                                        "maps/grid_arrival_time.asc",
                                        NULL};
    write_text("nested.yaml", HEAD GRID("coupling: two-way, "));
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "whole", "--quiet", "--until", "1.2", "--threads", "1");
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "threads", "--quiet", "--until", "1.2", "--threads", "2");
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "parts", "--quiet", "--until", "0.7");
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "parts", "--quiet", "--until", "1.2", "--resume");
    for (size_t f = 0; files[f]; f++) {
        assert_same_file("whole", "threads", files[f]);
        assert_same_file("whole", "parts", files[f]);
    }
}

/* Without a wave nothing comes in, in either direction, beyond the noise of particles. */
static void water_at_rest_stays(void **state)
{
    (void)state;
    double highest;
    write_text("nested.yaml", HEAD GRID("coupling: two-way, "));
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "rest", "--quiet", "--set", "offshore.wave={kind: none}");
    assert_near(volume_outside("rest/grid/000007.vti", &highest), 2.4, 2.4e-3);
    assert_true(fabs(highest) < 0.004); /* a tenth of a spacing */
    assert_true(highest_between("rest", 0, 3) < 0.004);
}

/* A quay across the side y_min, whose face is just before the centre of a cell, and a house on it: the grid
   has slopes there that stand out of the water before the face and above the quay. Still water rests as it does when
   the sea is still water without a grid. */
static void still_water_rests_beside_a_quay(void **state)
{
    (void)state;
    write_text("quay.yaml",
               "title: t\nresolution: 0.1\nduration: 1\nnumerics: {settle_steps: 100}\noutput: {plots: false}\n"
               "domain: {min: [0, 0, 0], max: [3, 2, 1], sides: {y_min: sea}}\n"
               "water: {level: 0.4, seed: [0.5, 1, 0.2]}\nsea: {source: offshore}\n"
               "offshore: {cell: 0.4, min: [-4, -4], max: [3.2, 6]}\n"
               "measure: {interval: 0.1, gauges: [{name: face, x: 1.65, y: 0.15}]}\n"
               "bodies:\n"
               "  - {name: quay, shape: box, min: [1.75, -4, 0], max: [4, 6, 0.6]}\n"
               "  - {name: house, shape: box, min: [2.5, -4, 0.5], max: [4, 6, 0.9]}\n");
    outcome o = RUN(0, "check", "quay.yaml");
    assert_null(strstr(o.out, "warning: sea"));
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "quay.yaml", "--out", "quay", "--quiet");
    RUN_AND_FORGET(0, "run", "quay.yaml", "--out", "still", "--quiet", "--set", "sea=null", "--set", "offshore=null");
    assert_same_file("quay", "still", "gauges.csv");
    assert_near(highest_at("quay", "face", 0, 2, &(double){0}), 0, 0.001);
}

/* Water runs off over a sill into a dry basin 30 m long until the side has less than a spacing of it: there is no more
   to come in, and the rest leaves. */
static void the_side_may_fall_dry(void **state)
{
    (void)state;
    write_text("sink.asc", "ncols 2\nnrows 2\nxllcenter -40\nyllcenter -20\ncellsize 39.5\nNODATA_value -9\n"
                           "-0.21 -0.21\n-0.21 -0.21\n");
    write_text(
        "dry.yaml", HEAD
        "bodies: [{name: sill, shape: box, min: [-40, -1], max: [5, 0.2]}]\n"
        "offshore: {cell: 0.04, min: [-34], max: [4], manning: 0, uplift: {file: sink.asc}, sides: {x_min: wall}}\n");
    RUN_AND_FORGET(0, "run", "dry.yaml", "--out", "dry", "--quiet", "--set", "duration=16");
    char *summary = text_of("dry/summary.json");
    assert_contains(summary, "\"lost_particles\": 0");
    sb_free(summary);
    /* Half a spacing is left; before 15 s the gauge swings with single particles. */
    assert_true(mean_of("dry/gauges.csv", "g", 1, 15) < -0.17 && highest_between("dry", 15, 16) < -0.17);
    assert_true(volume_of_particles("dry", "\"energy_end\"") < 0.2 * volume_of_particles("dry", "\"energy_start\""));
}

/* A channel between the centres of the grid's cells: the grid has none of its water. */
static void water_that_the_grid_lacks_is_named(void **state)
{
    (void)state;
    write_text("channel.yaml", "title: t\nresolution: 0.05\nduration: 1\noutput: {plots: false}\n"
                               "domain: {min: [0, 0, 0], max: [3, 2, 1], sides: {x_min: sea}}\n"
                               "water: {level: 0.4, seed: [1, 1.0, 0.2]}\nsea: {source: offshore}\n"
                               "offshore: {cell: 0.5, min: [-4, 0], max: [3, 2]}\n"
                               "bodies:\n"
                               "  - {name: south, shape: box, min: [-1, -1, 0], max: [4, 0.9, 0.6]}\n"
                               "  - {name: north, shape: box, min: [-1, 1.1, 0], max: [4, 3, 0.6]}\n");
    outcome o = RUN(0, "check", "channel.yaml");
    assert_contains(o.out, "warning: sea: the grid has no water around (0, ");
    assert_contains(o.out, "expected a smaller offshore.cell than 0.5 m");
    outcome_free(&o);
    o = RUN(0, "check", "channel.yaml", "--set", "offshore.cell=0.1");
    assert_null(strstr(o.out, "warning: sea"));
    outcome_free(&o);
}

/* A terrain with another vertical datum. */
static void another_depth_of_the_grid_is_named(void **state)
{
    (void)state;
    write_text("flat.asc", "ncols 3\nnrows 2\nxllcorner -15\nyllcorner -10\ncellsize 10\n0 0 0\n0 0 0\n");
    write_text("bed.yaml", HEAD "offshore: {cell: 0.04, min: [-6], max: [4], terrain: [{file: flat.asc, datum: 0}]}\n");
    outcome o = RUN(0, "check", "bed.yaml");
    assert_null(strstr(o.out, "warning: sea"));
    assert_contains(o.out, "  offshore.terrain[0]\n    flat.asc: no coordinate system, taken as metres; 3 x 2 nodes, ");
    outcome_free(&o);
    o = RUN(0, "check", "bed.yaml", "--json");
    assert_contains(o.out, "\"name\": \"offshore.terrain[0]\"");
    outcome_free(&o);
    o = RUN(0, "check", "bed.yaml", "--set",
            "offshore.wave={kind: solitary, height: 0.1, depth: 0.8, position: -2, theory: serre}");
    assert_contains(o.out, "warning: offshore.wave: its depth is 0.8 m, but the still water at its crest, x = -2 m, is "
                           "0.4 m deep in the mean");
    outcome_free(&o);
    o = RUN(0, "check", "bed.yaml", "--set", "offshore.terrain[0].datum=-100");
    assert_contains(o.out, "warning: sea: at x_min the water of the grid is 100.4 m deep in the mean, and that of the "
                           "particles 0.4 m");
    outcome_free(&o);
}

/* The volume that has entered the grid through x_min. */
static double entered_at_x_min(const char *path)
{
    static const char key[] = "\"x_min\": ";
    char *text = text_of(path);
    const char *object = strstr(text, "\"entered_m3\""), *at = object ? strstr(object, key) : NULL;
    assert_non_null(at);
    const double value = strtod(at + strlen(key), NULL);
    sb_free(text);
    return value;
}

/* The value in column `column` of the only row of a map. */
static double map_value(const char *path, size_t column)
{
    char *text = text_of(path), *at = text;
    for (int line = 0; line < 6; line++) at = strchr(at, '\n') + 1;
    double value = 0;
    for (size_t k = 0; k <= column; k++) value = strtod(at, &at);
    sb_free(text);
    return value;
}

/* A gauge outside of the particles reads the grid, whose solitary wave is exact: its height, and the time at which its
   crest is there. Likewise one within that says so. Times of maps are those of the run. */
static void gauges_and_maps_of_the_grid(void **state)
{
    (void)state;
    double early, late, within;
    const double celerity = sqrt(9.81 * 0.5);
    write_text("nested.yaml", HEAD GRID(""));
    outcome o = RUN(0, "run", "nested.yaml", "--out", "grid", "--quiet", "--set", "sea.start=-0.2", "--set",
                    "output.plots=true", "--set",
                    "measure.gauges=[{name: g, x: 1.2}, {name: far, x: -1.2}, {name: near, x: -0.4}, "
                    "{name: both, x: 1.2, water: grid}]");
    outcome_free(&o);
    assert_near(highest_at("grid", "far", 0, 2, &early), 0.1, 1e-3);
    assert_near(highest_at("grid", "near", 0, 2, &late), 0.1, 1e-3);
    assert_near(early, 0.8 / celerity - 0.2, 0.02); /* an interval of the rows */
    assert_near(late, 1.6 / celerity - 0.2, 0.02);
    assert_near(highest_at("grid", "both", 0, 2, &within), 0.1, 1e-3);
    assert_near(within, 3.2 / celerity - 0.2, 0.02);
    assert_near(map_value("grid/maps/grid_max_depth.asc", 140), 0.5, 1e-3);      /* x = -0.38 */
    assert_near(map_value("grid/maps/grid_inundation_time.asc", 140), 0, 1e-12); /* was wet */
    const double arrival = map_value("grid/maps/grid_arrival_time.asc", 140);
    assert_true(arrival > 0 && arrival < late); /* a rise of half of the height, before the crest */
    assert_true(exists("grid/maps/grid_max_speed.asc") && exists("grid/maps/grid_max_momentum_flux.asc"));
    assert_true(!exists("grid/maps/max_depth.asc"));
    char *scene = text_of("grid/scene.yaml"), *summary = text_of("grid/summary.json");
    assert_contains(scene, "water: grid");
    assert_contains(summary, "\"grid\": {");
    assert_contains(summary, "\"from_particles_m3\": 0");
    sb_free(scene);
    sb_free(summary);
    RUN_AND_FORGET(0, "report", "grid");
    char *page = text_of("grid/report.html");
    assert_contains(page, "Depth-averaged water beside the particles");
    sb_free(page);
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "grid", "--quiet", "--overwrite", "--until", "0.1", "--set",
                   "offshore.maps=false");
    assert_true(!exists("grid/maps/grid_max_depth.asc") && !exists("grid/maps/grid_max_depth.png"));
}

/* The grid's side makes the wave that a paddle with its face at -4.2 m would make. */
static void a_paddle_makes_the_wave(void **state)
{
    (void)state;
    double when;
    const double height = 0.1, depth = 0.4, c = sqrt(9.81 * (depth + height));
    const double kappa = sqrt(3 * height / (4 * depth * depth * (depth + height))),
                 stroke = 2 * height / (kappa * depth);
    const double half = (3.8 + height / depth) / (kappa * c); /* of the motion: then it is at the crest */
    const char *const grid = "offshore={cell: 0.04, min: [-3.2], max: [4], manning: 0, sides: {x_min: paddle}, "
                             "paddle: {kind: goring-rayleigh, height: 0.1, depth: 0.4}, paddle_at: -4.2}";
    write_text("nested.yaml", HEAD GRID(""));
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "paddle", "--quiet", "--set", grid, "--set", "duration=4.5",
                   "--set", "measure.gauges=[{name: g, x: 1.2}, {name: far, x: -1.2}]");
    assert_near(highest_at("paddle", "far", 0, 4.5, &when), height, 1e-3);
    assert_near(when, half + (3 - stroke / 2) / c, 0.025);
    assert_near(highest_between("paddle", 0, 4.5), height, 0.008);
    const double volume = entered_at_x_min("paddle/summary.json");
    assert_near(volume, 2 * height / kappa, 2e-3 * 2 * height / kappa);
    /* The grid and its paddle begin before the particles. */
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "early", "--quiet", "--set", grid, "--set", "duration=2.5",
                   "--set", "sea.start=-1.5", "--set", "measure.gauges=[{name: g, x: 1.2}, {name: far, x: -1.2}]");
    double early;
    assert_near(highest_at("early", "far", 0, 2.5, &early), height, 1e-3);
    assert_near(early, half + (3 - stroke / 2) / c - 1.5, 0.025);
    outcome o = RUN(1, "check", "nested.yaml", "--set", "offshore.sides={x_min: paddle}");
    assert_contains(o.err, "offshore.sides: x_min: paddle, but there is no block offshore.paddle, expected its law");
    outcome_free(&o);
    o = RUN(1, "check", "nested.yaml", "--set", "offshore.paddle={kind: goring, height: 0.1, depth: 0.4}");
    assert_contains(o.err, "offshore.paddle: no side is moved by it, expected sides: {x_min: paddle}");
    outcome_free(&o);
    o = RUN(1, "check", "nested.yaml", "--set", grid, "--set", "offshore.paddle={kind: gate, stroke: 1, speed: 1}");
    assert_contains(o.err, "offshore.paddle.kind: gate moves upwards, expected a law of a piston");
    outcome_free(&o);
}

static void gauges_outside_of_all_water_are_refused(void **state)
{
    (void)state;
    write_text("nested.yaml", HEAD GRID(""));
    outcome o = RUN(1, "check", "nested.yaml", "--set", "measure.gauges=[{name: g, x: -6.5}]");
    assert_contains(o.err, "measure.gauges[0].x: is outside of the domain and of the grid, expected inside");
    outcome_free(&o);
    o = RUN(1, "check", "nested.yaml", "--set", "measure.gauges=[{name: g, x: -1, water: particles}]");
    assert_contains(o.err, "measure.gauges[0].x: is outside of the domain, expected inside");
    outcome_free(&o);
    write_text("alone.yaml", "title: t\nduration: 1\ndomain: {min: [0, 0, -9], max: [90, 40, 9]}\n"
                             "offshore: {cell: 1}\nmeasure: {gauges: [{name: g, x: 5, y: 5, water: grid}]}\n");
    o = RUN(1, "check", "alone.yaml");
    assert_contains(o.err, "measure.gauges[0].water: needs particles and a grid, expected a scene with sea: {source: "
                           "offshore}");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wave_comes_in_and_leaves),
        cmocka_unit_test(bits_are_those_of_any_threads_and_of_a_resumed_run),
        cmocka_unit_test(water_at_rest_stays),
        cmocka_unit_test(still_water_rests_beside_a_quay),
        cmocka_unit_test(the_side_may_fall_dry),
        cmocka_unit_test(water_that_the_grid_lacks_is_named),
        cmocka_unit_test(another_depth_of_the_grid_is_named),
        cmocka_unit_test(gauges_and_maps_of_the_grid),
        cmocka_unit_test(a_paddle_makes_the_wave),
        cmocka_unit_test(gauges_outside_of_all_water_are_refused),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}

/* Runs with sides of kind sea, as a user makes them: every source, a resumed run, and bad input. */
#include "base/memory.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 0.4 m of water, 4 m long. */
#define HEAD                                                                                                           \
    "title: t\ndimensions: 2\nresolution: 0.05\nduration: 4\nnumerics: {settle_steps: 5}\noutput: {plots: false}\n"    \
    "measure: {interval: 0.05, gauges: [{name: g, x: 2.8}],\n"                                                         \
    "          planes: [{name: line, from: [2], record: true, record_interval: 0.05}]}\n"
#define SEA                                                                                                            \
    "water: {level: 0.4, seed: [2.5, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8], sides: {x_min: sea, x_max: sea}}\n"
#define SOLITARY "sea: {source: theory, wave: solitary, height: 0.08, depth: 0.4}\n" /* at x = 0 after 2.5 s */

/* A surface that rises by `height` in 2 s, as a long wave does that comes in, until `end`. */
static void write_table(const char *name, double height, double end)
{
    char text[8000] = "t,eta,u\n";
    size_t used = strlen(text);
    for (double t = 0; t < end + 1e-9; t += 0.05) {
        const double eta = t < 2 ? height * 0.5 * (1 - cos(M_PI * t / 2)) : height;
        const double u = 2 * (sqrt(9.81 * (0.4 + eta)) - sqrt(9.81 * 0.4));
        used += (size_t)snprintf(text + used, sizeof text - used, "%g,%.9g,%.9g\n", t, eta, u);
    }
    write_text(name, text);
}

/* The highest surface at the gauge above the still level, m. */
static double highest_of(const char *run)
{
    char path[64];
    snprintf(path, sizeof path, "%s/gauges.csv", run);
    char *table = text_of(path);
    double highest = -1;
    for (const char *row = table; (row = strstr(row, ",g,")); row += 3) highest = fmax(highest, strtod(row + 3, NULL));
    sb_free(table);
    return highest;
}

/* The mass of the water in the object `key` of the summary, kg/m. */
static double mass_in(const char *run, const char *key)
{
    char path[64];
    snprintf(path, sizeof path, "%s/summary.json", run);
    char *text = text_of(path);
    const char *object = strstr(text, key), *mass = object ? strstr(object, "\"mass_kg\": ") : NULL;
    assert_non_null(mass);
    const double value = strtod(mass + strlen("\"mass_kg\": "), NULL);
    sb_free(text);
    return value;
}

/* Checks that `check` names the source and doubts nothing but the height of waves beside the spacing, and runs. */
static void check_and_run(const char *text, const char *about, const char *run)
{
    static const char low[] = "warning: sea: a wave height of ";
    write_text("sea.yaml", text);
    outcome o = RUN(0, "check", "sea.yaml");
    assert_contains(o.out, about);
    assert_contains(o.out, "sea at x_min");
    assert_contains(o.out, "ground at 0 m");
    const char *doubt = strstr(o.out, "warning: sea");
    if (doubt && strncmp(doubt, low, strlen(low)) == 0) doubt = strstr(doubt + 1, "warning: sea");
    if (doubt) fail_msg("%s", o.out);
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "sea.yaml", "--out", run, "--quiet", "--overwrite");
}

/* Half a unit of the last of nine digits. */
static double rounding(double figure)
{
    return 0.5 * pow(10, floor(log10(fabs(figure))) - 8);
}

/* Eight layers of water: the bounds are wide. */
static void every_source_comes_in(void **state)
{
    (void)state;
    check_and_run(HEAD SEA SOLITARY, "a solitary wave of 0.08 m", "solitary");
    assert_near(highest_of("solitary"), 0.08, 0.012);
    const double sea = json_number_of("solitary/summary.json", "sea_J");
    assert_true(fabs(sea) > 1);
    /* Ledger of what crossed: energy, in figures of nine digits, and the mass by which the water has changed. */
    const double carried = json_number_of("solitary/summary.json", "carried_J"),
                 held = json_number_of("solitary/summary.json", "held_J");
    assert_near(carried + held, sea, rounding(carried) + rounding(held) + rounding(sea));
    const double in = json_number_of("solitary/summary.json", "in_kg"),
                 out = json_number_of("solitary/summary.json", "out_kg");
    assert_true(in > 0 && out > 0);
    assert_near(mass_in("solitary", "energy_start") + in - out, mass_in("solitary", "energy_end"), 1e-8 * in);

    check_and_run(HEAD "water: {level: 0.4, seed: [2.5, 0.2]}\n"
                       "domain: {min: [2, 0], max: [4, 0.8], sides: {x_min: sea, x_max: sea}}\n"
                       "sea: {source: record, file: solitary/record.csv, plane: line, sides: {x_max: still}}\n",
                  "the incoming part of the record of plane line", "replay");
    assert_near(highest_of("replay"), highest_of("solitary"), 0.008);

    check_and_run(HEAD SEA "sea: {source: theory, wave: regular, height: 0.04, period: 2, depth: 0.4, ramp: 1}\n",
                  "regular waves of 0.04 m and 2 s", "regular");
    assert_near(highest_of("regular"), 0.02, 0.01);

    write_table("table.csv", 0.05, 4);
    check_and_run(HEAD SEA "sea: {source: table, file: table.csv, sides: {x_max: still}}\n", "a table of 1 point",
                  "table");
    assert_near(highest_of("table"), 0.05, 0.01);
}

/* A wave of 22 m on 14 m of water rises within 2 s and falls over 6 s, at the foot of a slope of 1:10.6, with u = 2 (c
   - c0): at its crest u is 0.75 c. As much comes in as is given. Nothing has come back from the shore at 16 s. A strip
   that takes what it has let in for a wave that leaves brings in 3.4 % more. */
static void a_steep_wave_on_a_slope_brings_what_is_given(void **state)
{
    (void)state;
    static const double profile[][2] = {{300, -14}, {400, -14}, {472, -7.2}, {800, -2}, {1500, 30}};
    const double g = 9.81, depth = 14, step = 0.25, end = 16;
    char text[4000] = "";
    size_t used = 0;
    for (int k = 0; k < 5; k++)
        used += (size_t)snprintf(text + used, sizeof text - used, "v %g -500 %g\nv %g 500 %g\n", profile[k][0],
                                 profile[k][1], profile[k][0], profile[k][1]);
    for (int k = 1; k < 9; k += 2)
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", k, k + 2, k + 3, k + 1);
    write_text("bed.obj", text);
    double given = 0, last = 0;
    used = (size_t)snprintf(text, sizeof text, "t,eta,u\n");
    for (double t = 0; t <= end + 1; t += step) {
        const double eta = t < 4 ? 0 : t < 6 ? 11 * (t - 4) : 22 * exp((6 - t) / 6);
        const double u = 2 * (sqrt(g * (depth + eta)) - sqrt(g * depth)), flux = (depth + eta) * u;
        used += (size_t)snprintf(text + used, sizeof text - used, "%g,%.6f,%.6f\n", t, eta, u);
        if (t <= end) given += 0.5 * step * (last + flux);
        last = flux;
    }
    write_text("wave.csv", text);
    write_text("slope.yaml", "title: t\ndimensions: 2\nresolution: 2\nduration: 16\noutput: {plots: false}\n"
                             "domain: {min: [400, -50], max: [1400, 100], sides: {x_min: sea, z_max: open}}\n"
                             "water: {level: 0, seed: [430, -2]}\nsea: {source: table, file: wave.csv}\n"
                             "bodies: [{name: bed, shape: mesh, role: terrain, file: bed.obj}]\n");
    RUN_AND_FORGET(0, "run", "slope.yaml", "--out", "slope", "--quiet");
    const double in = (mass_in("slope", "energy_end") - mass_in("slope", "energy_start")) / 1000;
    printf("in %.0f m2 of %.0f given\n", in, given);
    assert_near(in, given, 0.015 * given);
}

static void a_sea_without_a_source_is_still(void **state)
{
    (void)state;
    write_text("still.yaml", HEAD SEA);
    RUN_AND_FORGET(0, "run", "still.yaml", "--out", "still", "--quiet", "--until", "0.5");
    assert_true(highest_of("still") < 0.01);
}

static void a_run_resumes_with_the_same_table_only(void **state)
{
    (void)state;
    static const char *const files[] = {"gauges.csv", "record.csv", "energy.csv", NULL};
    write_text("sea.yaml", HEAD SEA "sea: {source: table, file: table.csv, sides: {x_max: still}}\n");
    write_table("table.csv", 0.05, 4);
    RUN_AND_FORGET(0, "run", "sea.yaml", "--out", "whole", "--quiet", "--until", "2");
    RUN_AND_FORGET(0, "run", "sea.yaml", "--out", "parts", "--quiet", "--until", "1.2");
    write_table("table.csv", 0.06, 4);
    outcome o = RUN(1, "run", "sea.yaml", "--out", "parts", "--quiet", "--until", "2", "--resume");
    assert_one_line(o.err, "of another scene");
    assert_contains(o.err, "table.csv");
    outcome_free(&o);
    write_table("table.csv", 0.05, 4);
    RUN_AND_FORGET(0, "run", "sea.yaml", "--out", "parts", "--quiet", "--until", "2", "--resume");
    for (size_t f = 0; files[f]; f++) assert_same_file("whole", "parts", files[f]);
}

static void bad_input_gives_one_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {HEAD SEA "sea: {source: table, file: missing.csv}\n", "missing.csv"},
        {HEAD SEA "sea: {source: table, file: short.csv}\n", "ends at 3 s, expected 4 s or later"},
        {HEAD SEA "sea: {source: record, file: short.csv, plane: line}\n", "header of a record"},
        {HEAD SEA "sea: {source: theory, wave: solitary, height: 0.3, depth: 0.4, theory: third-order, level: 0.6}\n",
         "above the domain"},
        {HEAD "water: {level: 0.4, seed: [2.5, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8]}\n" SOLITARY,
         "expected domain.sides with a side of kind sea"},
        {HEAD "water: {level: 0.4, seed: [2.5, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8], sides: {x_min: sea}}\n"
              "sea: {source: table, file: short.csv, sides: {x_min: still}}\n",
         "that is not still"},
        {HEAD "water: {level: 0.4, seed: [2.5, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8], sides: {x_min: sea}}\n"
              "sea: {source: table, file: short.csv, sides: {x_max: still}}\n",
         "sides.x_max: still, but domain.sides.x_max is not sea"},
        {"duration: 4\ndomain: {min: [0, 0, -1], max: [8, 8, 1], sides: {x_min: sea}}\noffshore: {cell: 1, level: 0}\n",
         "a side of kind sea needs particles"},
    };
    write_table("short.csv", 0.05, 3);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        write_text("bad.yaml", cases[k].text);
        outcome o = RUN(1, "check", "bad.yaml");
        assert_one_line(o.err, cases[k].expected);
        outcome_free(&o);
        o = RUN(1, "run", "bad.yaml", "--out", "bad", "--quiet");
        assert_one_line(o.err, cases[k].expected);
        outcome_free(&o);
        assert_false(exists("bad/summary.json"));
    }
}

/* What can run but is probably not meant. */
static void doubtful_input_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *sea, *expected;
    } cases[] = {
        {"sea: {source: theory, wave: solitary, height: 0.08, depth: 0.4, start: -2.5}\n", "a bore enters at once"},
        {"sea: {source: theory, wave: solitary, height: 0.08, depth: 0.4, level: 0.5}\n", "sea.start or sea.level"},
        {"sea: {source: table, file: table.csv, datum: 0.48, sides: {x_max: still}}\n", "sea.start or sea.datum"},
        {"sea: {source: table, file: table.csv, datum: 0.32, sides: {x_max: still}}\n",
         "the given water begins 0.08 m below the still water of water.level"},
        {"sea: {source: offshore}\noffshore: {cell: 0.05, min: [-1], max: [5], level: 0.5}\n",
         "sea.start or offshore.level"},
        {"sea: {source: theory, wave: solitary, height: 0.08, depth: 0.8}\n", "expected the depth at the side"},
        {"sea: {source: theory, wave: solitary, height: 0.08, depth: 0.4, direction: 180, sides: {x_max: still}}\n",
         "sea.direction: no wave runs into the domain"},
        {"sea: {source: table, file: table.csv}\n", "such as {x_max: still}"},
        {"sea: {source: offshore, start: -1.6}\noffshore: {cell: 0.05, min: [-4], max: [5], wave: {kind: solitary, "
         "height: 0.1, depth: 0.4, position: -2}}\n",
         "this part of the wave is lost"},
    };
    char text[2000];
    write_table("table.csv", 0.05, 4);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        snprintf(text, sizeof text, HEAD SEA "%s", cases[k].sea);
        write_text("doubtful.yaml", text);
        outcome o = RUN(0, "check", "doubtful.yaml");
        assert_contains(o.out, cases[k].expected);
        outcome_free(&o);
        o = RUN(0, "run", "doubtful.yaml", "--out", "doubtful", "--quiet", "--overwrite", "--until", "0.01");
        assert_contains(o.err, cases[k].expected);
        outcome_free(&o);
    }
}

/* The run ends there, which is known before; a run that ends earlier is not warned. */
static void a_source_that_will_dry_the_strip_is_named(void **state)
{
    (void)state;
    write_text("dry.csv", "t,eta,u\n0,0,0\n1,0,0\n2,-0.37,0\n4,-0.37,0\n");
    write_text("dry.yaml", HEAD SEA "sea: {source: table, file: dry.csv, sides: {x_max: still}}\n");
    outcome o = RUN(0, "check", "dry.yaml");
    assert_contains(o.out, "warning: sea: at 1.859 s the given water at x_min falls to 0.04994 m at (0, 0)");
    outcome_free(&o);
    o = RUN(0, "check", "dry.yaml", "--set", "duration=1.8");
    assert_null(strstr(o.out, "warning: sea"));
    outcome_free(&o);
}

/* A current crosses a box between four seas, whose corners it enters, leaves and passes. Five layers of water: the
   level stays within 1 % of the depth, also in the corners. Velocities of single places have the noise of some
   particles; their mean is within 3 % of the speed. */
static void a_current_crosses_four_corners(void **state)
{
    (void)state;
    enum { PLACES = 5 };
    static const char *const places[PLACES] = {"middle", "in", "out", "left", "right"};
    write_text("current.csv", "t,eta,u,v\n0,0,0,0\n1,0,0.1,0.0667\n2,0,0.25,0.1667\n3,0,0.3,0.2\n4,0,0.3,0.2\n"
                              "9,0,0.3,0.2\n"); /* in the middle it is steady from 5 s on */
    write_text(
        "corners.yaml",
        "title: t\nresolution: 0.1\nduration: 7\nnumerics: {settle_steps: 60}\n"
        "output: {plots: false, checkpoint: {minutes: 0}}\n"
        "measure:\n  interval: 0.1\n"
        "  gauges: [{name: middle, x: 1.3, y: 1.3}, {name: in, x: 0.35, y: 0.35}, {name: out, x: 2.25, y: 2.25},\n"
        "           {name: left, x: 0.35, y: 2.25}, {name: right, x: 2.25, y: 0.35}]\n"
        "  probes: [{name: middle, at: [1.3, 1.3, 0.25]}, {name: in, at: [0.35, 0.35, 0.25]}, "
        "{name: out, at: [2.25, 2.25, 0.25]},\n"
        "           {name: left, at: [0.35, 2.25, 0.25]}, {name: right, at: [2.25, 0.35, 0.25]}]\n"
        "water: {level: 0.5, seed: [1.3, 1.3, 0.2]}\n"
        "domain: {min: [0, 0, 0], max: [2.6, 2.6, 0.9], sides: {x_min: sea, x_max: sea, y_min: sea, y_max: sea}}\n"
        "sea: {source: table, file: current.csv}\n");
    RUN_AND_FORGET(0, "run", "corners.yaml", "--out", "corners", "--quiet");
    double u = 0, v = 0;
    for (int k = 0; k < PLACES; k++) {
        assert_near(mean_of("corners/gauges.csv", places[k], 1, 5), 0, 0.01 * 0.5);
        const double here_u = mean_of("corners/probes.csv", places[k], 1, 5);
        const double here_v = mean_of("corners/probes.csv", places[k], 2, 5);
        assert_near(here_u, 0.3, 0.07 * 0.36);
        assert_near(here_v, 0.2, 0.07 * 0.36);
        u += here_u / PLACES;
        v += here_v / PLACES;
    }
    assert_near(u, 0.3, 0.03 * 0.36);
    assert_near(v, 0.2, 0.03 * 0.36);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_source_comes_in),
        cmocka_unit_test(a_steep_wave_on_a_slope_brings_what_is_given),
        cmocka_unit_test(a_sea_without_a_source_is_still),
        cmocka_unit_test(a_run_resumes_with_the_same_table_only),
        cmocka_unit_test(bad_input_gives_one_line),
        cmocka_unit_test(doubtful_input_is_named),
        cmocka_unit_test(a_source_that_will_dry_the_strip_is_named),
        cmocka_unit_test(a_current_crosses_four_corners),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}

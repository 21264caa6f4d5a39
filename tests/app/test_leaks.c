/* Water that passes walls of the domain: scenes that once leaked no longer do, and a run that loses water reports it in
   its last line. */
#include "program.h"

#include "base/memory.h"

#include <stdio.h>
#include <string.h>

/* length: of the tank along x, m. Walls of boundary particles: those that reflect the water have no gap at an open mesh
   through which it leaves the domain. */
static void write_scene(const char *name, double length, const char *body, const char *walls)
{
    char text[700];
    snprintf(text, sizeof text,
             "title: leaks\nresolution: 0.1\nduration: 0.05\ndomain: {min: [0, 0, -0.4], max: [%g, 2, 1.2]}\n"
             "water: {level: 0.5, seed: [0.3, 0.3, 0.45]}\nbodies: [{name: b, %s}]\noutput: {plots: false}\n"
             "numerics: {walls: %s}\n",
             length, body, walls);
    write_text(name, text);
}

/* A node without a height removes the ground around it, down to the domain's floor. */
static void ground_with_a_hole_holds_the_sea(void **state)
{
    (void)state;
    char grid[600] = "ncols 5\nnrows 4\nxllcenter -0.5\nyllcenter -0.5\ncellsize 1\n";
    for (int i = 0; i < 20; i++) strcat(grid, i == 7 ? "-9999\n" : "0.1\n");
    write_text("hole.asc", grid);
    write_scene("hole.yaml", 3, "shape: grid, file: hole.asc", "images");
    outcome o = RUN(0, "check", "hole.yaml");
    assert_contains(o.out, "warning: body \"b\": the ground ends within the domain, at 4 open edges, the first at (");
    assert_contains(o.out, "nodata) at 1 node, the first at (1.5, 1.5)");
    outcome_free(&o);
    o = RUN(0, "run", "hole.yaml", "--out", "hole", "--quiet");
    assert_contains(o.err, "the ground ends within the domain");
    assert_null(strstr(o.err, "lost"));
    outcome_free(&o);
    assert_near(json_number_of("hole/summary.json", "lost_particles"), 0, 0);
    assert_near(json_number_of("hole/summary.json", "through_walls"), 0, 0);
    write_scene("short.yaml", 3, "shape: grid, file: hole.asc, translate: [-1, 0, 0]", "images");
    RUN_AND_FORGET(0, "run", "short.yaml", "--out", "short", "--quiet");
    assert_near(json_number_of("short/summary.json", "lost_particles"), 0, 0);
}

static const char *last_line(char *text)
{
    const size_t length = strlen(text);
    assert_true(length > 0 && text[length - 1] == '\n');
    text[length - 1] = '\0';
    const char *before = strrchr(text, '\n');
    return before ? before + 1 : text;
}

/* A block on the floor with one open side: there are no boundary particles under the water within it. */
static void much_lost_water_fails_the_run(void **state)
{
    (void)state;
    write_text("open.obj", "v 1 0.5 -0.4\nv 2 0.5 -0.4\nv 2 1.5 -0.4\nv 1 1.5 -0.4\nv 1 0.5 0.8\nv 2 0.5 0.8\n"
                           "v 2 1.5 0.8\nv 1 1.5 0.8\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n");
    write_scene("open.yaml", 3, "shape: mesh, file: open.obj", "particles, density: summed, stress_correction: 0");
    outcome o = RUN(2, "run", "open.yaml", "--out", "open", "--quiet");
    assert_contains(o.err, "were lost through walls of the domain during settling\n");
    const char *last = last_line(o.err);
    unsigned long long lost = 0, all = 0;
    assert_int_equal(sscanf(last, "shorebreak: %llu of %llu particles were lost", &lost, &all), 2);
    assert_contains(last, "through walls of the domain, more than 1 %: its forces and depths are wrong");
    assert_near(json_number_of("open/summary.json", "lost_particles"), (double)lost, 0);
    assert_near(json_number_of("open/summary.json", "fluid_particles"), (double)all, 0);
    outcome_free(&o);
    char *summary = text_of("open/summary.json"), *log = text_of("open/run.jsonl");
    assert_contains(summary, "\"status\": \"failed\"");
    assert_contains(summary, "were lost through walls of the domain, more than 1 %");
    assert_contains(log, "were lost through walls of the domain, more than 1 %");
    sb_free(summary);
    sb_free(log);
}

/* The same with a smaller block in a long tank, whose water loses about 0.4 % in 80 steps of settling. */
static void little_lost_water_is_reported_last(void **state)
{
    (void)state;
    write_scene("little.yaml", 6, "shape: mesh, file: open.obj, scale: 0.8, translate: [1, 0.7, -0.08]",
                "particles, density: summed, stress_correction: 0");
    outcome o = RUN(0, "run", "little.yaml", "--out", "little", "--quiet", "--set", "numerics.settle_steps=80");
    const double lost = json_number_of("little/summary.json", "lost_particles");
    assert_true(lost > 0);
    char expected[120];
    snprintf(expected, sizeof expected,
             "shorebreak: warning: %.0f of %.0f particles were lost through walls of the domain", lost,
             json_number_of("little/summary.json", "fluid_particles"));
    assert_string_equal(last_line(o.err), expected);
    outcome_free(&o);
    char *log = text_of("little/run.jsonl");
    assert_contains(log, expected + strlen("shorebreak: warning: "));
    sb_free(log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ground_with_a_hole_holds_the_sea),
        cmocka_unit_test(much_lost_water_fails_the_run),
        cmocka_unit_test(little_lost_water_is_reported_last),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}

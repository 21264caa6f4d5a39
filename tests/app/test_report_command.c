/* shorebreak report on real runs: in 3D with pictures and a map, in 2D, one that was stopped; and refusals. */
#include "program.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "report/loads.h"
#include "report/report.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r3", "--quiet", "--set",
                   "measure.map={min: [0, 0], max: [2.6, 0.8], cell: 0.1}", "--set",
                   "measure.runups=[{name: up, from: [0.8, 0.4], to: [2.6, 0.4]}]");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "r2", "--quiet");
    return 0;
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text += strlen(part)) count++;
    return count;
}

static void page_of_a_run_in_3d(void **state)
{
    (void)state;
    const double start = sb_clock();
    outcome o = RUN(0, "report", "r3");
    if (sb_clock() - start > 10) fail_msg("took %g s", sb_clock() - start);
    assert_contains(o.out, "r3/report.html: ");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    char *text = text_of("r3/report.html");
    assert_true(strlen(text) < SB_REPORT_BYTES_MAX);
    /* One picture at the greatest load and three of each of two cameras; four maps. */
    assert_int_equal(count_of(text, "<img width="), 7);
    assert_int_equal(count_of(text, "<image width="), 4);
    static const char *const parts[] = {"row\">post",      "row\">sill",
                                        "row\">wet",       "row\">up",
                                        "gauge wet",       "shorebreak run tank3.yaml --out r3 --quiet --set ",
                                        "resolution: 0.1", "Run complete, 0.3"};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++) assert_contains(text, parts[p]);
    assert_null(strstr(text, "Missing or damaged"));
    sb_free(text);
    RUN_AND_FORGET(0, "report", "r3", "--quiet"); /* an earlier report is replaced */
}

static double number_of(const sb_report_run *run, const char *name, const char *key)
{
    size_t i;
    json_t *body;
    json_array_foreach(json_object_get(run->summary, "bodies"), i,
                       body) if (strcmp(json_string_value(json_object_get(body, "name")), name) ==
                                 0) return json_number_value(json_object_get(body, key));
    fail_msg("no body %s", name);
    return 0;
}

/* The report's loads come from the table; the run has summed them up itself. */
static void loads_are_those_of_the_summary(void **state)
{
    (void)state;
    static const char *const runs[] = {"r3", "r2"};
    for (size_t r = 0; r < 2; r++) {
        sb_report_run run;
        sb_loads loads;
        sb_error error = {0};
        assert_int_equal(sb_report_run_read(in_folder("%s", runs[r]), &run, &error), SB_OK);
        assert_int_equal(run.notes.count, 0);
        assert_int_equal(run.flat, r == 1);
        assert_int_equal(sb_loads_make(&run, &loads, &error), SB_OK);
        assert_int_equal(loads.count, r == 0 ? 2 : 1);
        for (size_t i = 0; i < loads.count; i++) {
            const sb_load *load = &loads.loads[i];
            const double peak = number_of(&run, load->name, "peak_N"),
                         impulse = number_of(&run, load->name, "impulse_Ns");
            assert_true(peak > 0 && load->judged);
            assert_near(load->total, peak, 1e-6 * peak); /* tables have nine digits */
            assert_near(load->total_time, number_of(&run, load->name, "peak_time_s"), 1e-6);
            assert_near(load->impulse, impulse, 1e-6 * impulse);
        }
        sb_loads_free(&loads);
        sb_report_run_free(&run);
    }
}

static void page_of_a_run_in_2d(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "report", "r2", "--out", "flat.html", "--title", "A <flat> tank", "--quiet");
    char *text = text_of("flat.html");
    assert_contains(text, "<title>A &lt;flat&gt; tank</title>");
    assert_contains(text, "per metre of width");
    assert_contains(text, "The run has no pictures.");
    assert_contains(text, "The run has no maps.");
    sb_free(text);
    assert_false(exists("r2/report.html"));
}

static void damaged_pictures_are_said(void **state)
{
    (void)state;
    write_text("r3/frames/side/000001.png", "no picture");
    write_text("r3/summary.json", "{\"status\": ");
    outcome o = RUN(0, "report", "r3", "--quiet");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    char *text = text_of("r3/report.html");
    assert_contains(text, "side/000001.png: ");
    assert_contains(text, "summary.json: line 1: ");
    assert_contains(text, "State of the run unknown");
    sb_free(text);
}

static void refused(const char *expected, const char *run, const char *out)
{
    outcome o = program_run((const char *const[]){"report", run, "--out", out, NULL});
    assert_true(o.status == 1 || o.status == 2);
    assert_one_line(o.err, expected);
    assert_string_equal(o.out, "");
    outcome_free(&o);
}

static void refusals(void **state)
{
    (void)state;
    write_text("mine.html", "<html>my own page</html>");
    refused("no-such-run: expected the folder of a run", "no-such-run", "x.html");
    refused("tank2.yaml: expected the folder of a run", "tank2.yaml", "x.html");
    refused("mine.html: is no report of shorebreak", "r2", "mine.html");
    refused("none/x.html", "r2", "none/x.html");
    assert_int_equal(mkdir(in_folder("empty"), 0777), 0);
    refused("empty: expected the folder of a run", "empty", "x.html");
    assert_int_equal(mkfifo(in_folder("r2/runup.csv"), 0666), 0);
    refused("runup.csv", "r2", "x.html");
    assert_int_equal(unlink(in_folder("r2/runup.csv")), 0);
    assert_false(exists("x.html"));
    outcome o = RUN(1, "report", "r2", "--titel", "x");
    assert_one_line(o.err, "did you mean --title?");
    outcome_free(&o);
}

/* A new run in the folder removes the report of the earlier one. */
static void overwrite_removes_the_report(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "report", "r2", "--quiet");
    assert_true(exists("r2/report.html"));
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "r2", "--quiet", "--overwrite", "--until", "0.05");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    assert_false(exists("r2/report.html"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_of_a_run_in_3d),       cmocka_unit_test(loads_are_those_of_the_summary),
        cmocka_unit_test(page_of_a_run_in_2d),       cmocka_unit_test(refusals),
        cmocka_unit_test(damaged_pictures_are_said), cmocka_unit_test(overwrite_removes_the_report),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}

/* Tests of kept figures: an earlier report replaces a missing run if request and defaults are the same. */
#include "check.h"
#include "tools/tool.h"

#include "kept.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define RUN "100,20,6.50,3.5,abc,0123456789abcdef,00000000000000a7,2,\"Abacus, 2 cores\",b1d,"
#define FINER "800,40,7.00,30.0,abc,ffffffffffffffff,00000000000000a7,2,\"Abacus, 2 cores\",b1d,"
static const char table[] =
    "case,resolution_m,preset,seed,judged,quantity,unit,reference,value,error,error_unit,target,verdict,particles,"
    "steps,"
    "sweeps_per_step,run_time_s,commit,request,defaults,threads,machine,build,reference_low,reference_high,note\n"
    "a,0.1,default,1,yes,height,m,2,2.1,5,%,10,pass," RUN "1.5,2.5,\"counted by hand, \"\"twice\"\"\"\n"
    "a,0.1,default,1,yes,\"noise, all\",%,,3,3,%,1,FAIL," RUN ",,\n"
    "a,0.1,default,1,yes,pressure,Pa,,7,,%,,reported," RUN ",,\n"
    "b,0.1,default,1,yes,height,m,2,1,-50,%,10,FAIL," RUN ",,\n"
    "a,0.05,default,1,no,height,m,2,2.2,10,%,10,pass," FINER ",,\n"
    "a,,default,1,yes,order,,,1.5,1.5,,2,pass,,,,,,,,,,,,,of two\n";

static const sb_case of = {.name = "a"};
static const sb_plan plan = {.resolution = 0.1, .judged = true};

static sb_result requested(const char *hash)
{
    sb_result r = {.request = {.of = &of, .plan = &plan, .seed = 1}, .defaults_hash = 0xa7};
    snprintf(r.request_hash, sizeof r.request_hash, "%s", hash);
    return r;
}

static void open_table(sb_sheet *sheet)
{
    const char *folder = tool_path("report");
    char path[512];
    mkdir(folder, 0777);
    snprintf(path, sizeof path, "%s/validation", folder);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/validation/results.csv", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(table, out);
    fclose(out);
    assert_int_equal(sb_kept_open(tool_path("report"), sheet, NULL), SB_OK);
    assert_int_equal(sheet->rows, 6);
}

static void test_same_request_is_found(void **state)
{
    (void)state;
    sb_sheet sheet;
    open_table(&sheet);
    sb_result r = requested("0123456789abcdef");
    sb_kept_read(&sheet, &r);
    assert_true(r.state == SB_RESULT_DONE && r.kept);
    assert_int_equal(r.figures.count, 3); /* not case b's */
    const sb_figure *height = sb_figures_find(&r.figures, "height"), *noise = sb_figures_find(&r.figures, "noise, all");
    assert_true(height && noise && height->pass && !noise->pass && noise->one_sided && !height->one_sided);
    assert_near(height->value, 2.1, 0);
    assert_near(height->limit, 10, 0);
    assert_string_equal(height->note, "counted by hand, \"twice\"");
    assert_true(height->low == 1.5 && height->high == 2.5 && noise->low == noise->high && !noise->note[0]);
    assert_true(isnan(noise->reference) && isnan(sb_figures_find(&r.figures, "pressure")->limit));
    assert_string_equal(r.run.commit, "abc");
    assert_int_equal(r.run.view.particles, 100);
    assert_int_equal(r.run.view.steps, 20);
    assert_near(r.run.view.wall, 3.5, 0);
    assert_int_equal(r.run.threads, 2);
    assert_string_equal(r.run.machine, "Abacus, 2 cores");
    assert_string_equal(r.run.build, "b1d");
    sb_case_results results = {.of = &of, .count = 1, .runs = &r};
    size_t limited, passed;
    sb_results_count(&results, &limited, &passed);
    assert_int_equal(limited, 2);
    assert_int_equal(passed, 1);
    sb_kept_across(&sheet, "a", &results.across);
    assert_int_equal(results.across.count, 1);
    assert_near(results.across.rows[0].value, 1.5, 0);
    assert_string_equal(results.across.rows[0].note, "of two");
    sb_figures_free(&r.figures);
    sb_figures_free(&results.across);
    sb_sheet_free(&sheet);
}

static void test_other_requests_and_own_runs_are_ignored(void **state)
{
    (void)state;
    sb_sheet sheet;
    open_table(&sheet);
    sb_result other = requested("0000000000000000"), unknown = requested(""), own = requested("0123456789abcdef");
    sb_result defaults = requested("0123456789abcdef");
    own.state = SB_RESULT_FAILED;
    defaults.defaults_hash = 0xa8; /* the same request, but another default */
    sb_result *each[] = {&other, &unknown, &own, &defaults};
    for (size_t i = 0; i < 4; i++) {
        const sb_result_state before = each[i]->state;
        sb_kept_read(&sheet, each[i]);
        assert_true(each[i]->state == before && !each[i]->kept && each[i]->figures.count == 0);
    }
    sb_sheet_free(&sheet);
}

/* A report of kept figures alone writes a table with the same figures. */
static void test_report_of_kept_figures_keeps_table(void **state)
{
    (void)state;
    char *written = NULL;
    size_t length = 0;
    sb_sheet sheet;
    open_table(&sheet);
    sb_result r = requested("0123456789abcdef");
    sb_case_results results = {.of = &of, .count = 1, .runs = &r};
    sb_kept_read(&sheet, &r);
    sb_kept_across(&sheet, "a", &results.across);
    FILE *out = open_memstream(&written, &length);
    assert_non_null(out);
    sb_report_csv(out, &(sb_report){.cases = &results, .count = 1});
    fclose(out);
    for (const char *line = table, *end; *line; line = end + 1) {
        char text[400];
        end = strchr(line, '\n');
        snprintf(text, sizeof text, "%.*s", (int)(end - line + 1), line);
        const bool same = !strstr(line, "ffffffffffffffff") || end < strstr(line, "ffffffffffffffff");
        assert_int_equal(strstr(written, text) != NULL, line[0] != 'b' && same);
    }
    free(written);
    sb_figures_free(&r.figures);
    sb_figures_free(&results.across);
    sb_sheet_free(&sheet);
}

static void compare_nothing(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures)
{
    (void)runs, (void)of_each, (void)count, (void)figures;
}

/* A judged run without the run that it is compared with is not within its targets: there is no figure. */
static void test_a_missing_partner_is_reported(void **state)
{
    (void)state;
    char *written = NULL;
    size_t length = 0;
    const sb_case paired = {.name = "a", .title = "A", .headline = "force", .compare = compare_nothing};
    const sb_plan alone = {.resolution = 0.1}, judged = {.resolution = 0.1, .judged = true};
    sb_result runs[] = {{.request = {.of = &paired, .plan = &alone, .seed = 1}},
                        {.request = {.of = &paired, .plan = &judged, .seed = 1}, .state = SB_RESULT_DONE}};
    sb_case_results results = {.of = &paired, .count = 2, .runs = runs};
    assert_true(sb_results_incomplete(&results));
    FILE *out = open_memstream(&written, &length);
    assert_non_null(out);
    sb_report_summary_row(out, &results);
    fclose(out);
    assert_non_null(strstr(written, "0 of 0 | **incomplete**"));
    free(written);
    runs[1].state = SB_RESULT_NOT_RUN;
    assert_false(sb_results_incomplete(&results));
    runs[1].state = SB_RESULT_DONE;
    sb_figure_report(&results.across, "force per height", "N/m", 1, 1, "%s", "");
    assert_false(sb_results_incomplete(&results));
    sb_figures_free(&results.across);
}

static void test_missing_table_is_empty(void **state)
{
    (void)state;
    sb_sheet sheet;
    sb_result r = requested("0123456789abcdef");
    assert_int_equal(sb_kept_open(tool_path("nowhere"), &sheet, NULL), SB_OK);
    sb_kept_read(&sheet, &r);
    assert_true(r.state == SB_RESULT_NOT_RUN);
    sb_sheet_free(&sheet);
}

static int set_up(void **state)
{
    (void)state;
    return tool_begin();
}

static int tear_down(void **state)
{
    (void)state;
    return tool_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_request_is_found),
        cmocka_unit_test(test_other_requests_and_own_runs_are_ignored),
        cmocka_unit_test(test_report_of_kept_figures_keeps_table),
        cmocka_unit_test(test_a_missing_partner_is_reported),
        cmocka_unit_test(test_missing_table_is_empty),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}

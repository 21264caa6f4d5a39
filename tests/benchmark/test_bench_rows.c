/* Tables of the benchmark: statistics, look-up, CSV there and back, the report's judgement, the command line. */
#include "machine.h"
#include "options.h"
#include "report.h"

#include "base/file.h"
#include "base/memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/sb-bench-XXXXXX";

static int setup(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 && sb_make_directories("out/bench", NULL) == SB_OK ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return chdir("/") == 0 ? system(command) : -1;
}

static sb_bench_samples samples_of(const double *values, int count)
{
    sb_bench_samples samples = {.count = 0};
    for (int i = 0; i < count; i++) sb_bench_sample(&samples, values[i]);
    return samples;
}

static void statistics_are_of_the_sorted_samples(void **state)
{
    (void)state;
    const double odd[] = {9, 2, 4}, even[] = {8, 2, 4, 3};
    const sb_bench_samples three = samples_of(odd, 3), four = samples_of(even, 4);
    sb_bench_rows rows = {0};
    assert_int_equal(sb_bench_add(&rows, "a", 10, 1, "q", "ns", &three, 10, NULL), SB_OK);
    assert_int_equal(sb_bench_add(&rows, "a", 10, 2, "q", "ns", &four, 1, NULL), SB_OK);
    assert_true(rows.rows[0].least == 20 && rows.rows[0].median == 40 && rows.rows[0].most == 90);
    assert_true(rows.rows[1].least == 2 && rows.rows[1].median == 3.5 && rows.rows[1].most == 8);
    assert_int_equal(rows.rows[1].repeats, 4);
    assert_ptr_equal(sb_bench_find(&rows, "a", 10, 2, "q"), &rows.rows[1]);
    assert_ptr_equal(sb_bench_find(&rows, "a", 0, 0, "q"), &rows.rows[0]);
    assert_null(sb_bench_find(&rows, "a", 11, 0, "q"));
    sb_bench_rows_free(&rows);
}

static void tables_come_back_as_they_were_written(void **state)
{
    (void)state;
    sb_bench_rows rows = {0}, back;
    char origin[256];
    bool found;
    for (int i = 0; i < 20; i++)
        assert_int_equal(sb_bench_add_value(&rows, "plant at 4 m; paper", 100 + (size_t)i, 2, "time, \"per\" pair",
                                            "ns", 0.5 * i, NULL),
                         SB_OK);
    assert_int_equal(sb_bench_write(&rows, "machine: x\ncommit: y\n", "t.csv", NULL), SB_OK);
    assert_int_equal(sb_bench_read(&back, origin, sizeof origin, &found, "t.csv", NULL), SB_OK);
    assert_true(found);
    assert_string_equal(origin, "machine: x\ncommit: y\n");
    assert_int_equal(back.count, 20);
    assert_string_equal(back.rows[19].subject, "plant at 4 m; paper");
    assert_string_equal(back.rows[19].quantity, "time, \"per\" pair");
    assert_int_equal(back.rows[19].particles, 119);
    assert_true(back.rows[19].median == 9.5);
    sb_bench_rows_free(&rows);
    sb_bench_rows_free(&back);
    assert_int_equal(sb_bench_read(&back, origin, sizeof origin, &found, "none.csv", NULL), SB_OK);
    assert_false(found);
}

static void foreign_tables_are_refused(void **state)
{
    (void)state;
    sb_bench_rows rows;
    sb_error error = {0};
    char origin[64];
    bool found;
    FILE *file = fopen("foreign.csv", "w");
    assert_non_null(file);
    fputs("a,b\n1,2\n", file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(sb_bench_read(&rows, origin, sizeof origin, &found, "foreign.csv", &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "foreign.csv: 2 columns, expected 9"));
}

/* 50 k particles cost 100 ns on one thread, 60 on two; a million 120 and 66: growth 1.1, efficiency 0.909. */
static void write_scaling(const char *origin)
{
    static const struct {
        size_t particles;
        int threads;
        double ns;
    } costs[] = {{50000, 1, 100}, {50000, 2, 60}, {1000000, 1, 120}, {1000000, 2, 66}};
    sb_bench_rows rows = {0};
    for (size_t i = 0; i < sizeof costs / sizeof costs[0]; i++)
        assert_int_equal(sb_bench_add_value(&rows, SB_BENCH_STEP, costs[i].particles, costs[i].threads,
                                            SB_BENCH_PER_PARTICLE, "ns", costs[i].ns, NULL),
                         SB_OK);
    assert_true(sb_bench_growth(&rows) > 1.099 && sb_bench_growth(&rows) < 1.101);
    assert_int_equal(sb_bench_write(&rows, origin, "out/bench/scaling.csv", NULL), SB_OK);
    sb_bench_rows_free(&rows);
}

static char *report_text(void)
{
    char *text = NULL;
    size_t length;
    assert_int_equal(sb_bench_report("out", NULL), SB_OK);
    assert_int_equal(sb_file_read("out/benchmarks.md", 1 << 20, &text, &length, NULL), SB_OK);
    return text;
}

static void figures_are_judged(void **state)
{
    (void)state;
    write_scaling("machine: abacus, 2 cores\ncommit: abc\nmeasured: 2 threads\n");
    char *text = report_text();
    assert_non_null(
        strstr(text, "| cost per particle, 50 k to 4 M | × | ≤ 1.3 | 1.2 | 1.1 | stretch | abacus, abc |\n"));
    assert_non_null(strstr(text, "1 M particles |  | ≥ 0.9 | 0.95 | 0.909 | within | abacus, abc |\n"));
    assert_non_null(strstr(text, "| conical island, 12 s | minutes | ≤ 90 | 45 | not measured | | |\n"));
    assert_non_null(strstr(text, "| 1000000 | 2 | 66 | 0.909 |\n"));
    sb_free(text);
}

static void quick_forms_are_not_judged(void **state)
{
    (void)state;
    write_scaling("measured: 2 threads, 2 repeats, quick; load\n");
    char *text = report_text();
    assert_non_null(strstr(text, "| cost per particle, 50 k to 4 M | × | ≤ 1.3 | 1.2 | not measured | | |\n"));
    assert_non_null(strstr(text, "| 1000000 | 2 | 66 | 0.909 |\n"));
    sb_free(text);
}

static sb_status parse(const char *text, sb_bench_options *o, sb_error *error)
{
    static char copy[256];
    char *arguments[16] = {copy};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " ")) arguments[count++] = word;
    return sb_bench_parse(count, arguments, o, error);
}

static void options_choose_sections(void **state)
{
    (void)state;
    sb_bench_options o;
    sb_error error = {0};
    assert_int_equal(parse("", &o, &error), SB_OK);
    assert_int_equal(o.count, 4);
    assert_int_equal(parse("scaling kernels scaling --repeats 3 --quick --out x", &o, &error), SB_OK);
    assert_int_equal(o.count, 2);
    assert_string_equal(o.sections[0]->name, "scaling");
    assert_true(o.repeats == 3 && o.quick);
    assert_string_equal(o.out, "x");
    static const char *const wrong[][2] = {{"pressure", "pressure: no such section"},
                                           {"--fast", "--fast: no such option"},
                                           {"--repeats 0", "--repeats: 0 is no number from 1 to 100"},
                                           {"--repeats 101", "101 is no number"},
                                           {"--threads two", "--threads: two is no number"},
                                           {"--out", "--out: a value is missing"}};
    for (size_t w = 0; w < sizeof wrong / sizeof wrong[0]; w++) {
        assert_int_equal(parse(wrong[w][0], &o, &error), SB_BAD_INPUT);
        if (!strstr(error.text, wrong[w][1])) fail_msg("%s: %s", wrong[w][0], error.text);
    }
}

static void busy_others_are_seen(void **state)
{
    (void)state;
    const sb_bench_clock from = {.wall = 10, .busy = 100, .own = 5}, to = {.wall = 12, .busy = 103, .own = 7};
    assert_true(sb_bench_others(from, to) == 0.5);
    const sb_bench_clock alone = {.wall = 12, .busy = 102, .own = 7};
    assert_true(sb_bench_others(from, alone) == 0);
    assert_true(sb_bench_others((sb_bench_clock){.busy = -1}, to) < 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statistics_are_of_the_sorted_samples),
        cmocka_unit_test(tables_come_back_as_they_were_written),
        cmocka_unit_test(foreign_tables_are_refused),
        cmocka_unit_test(figures_are_judged),
        cmocka_unit_test(quick_forms_are_not_judged),
        cmocka_unit_test(options_choose_sections),
        cmocka_unit_test(busy_others_are_seen),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}

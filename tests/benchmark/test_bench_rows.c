/* Tests of tools/bench: statistics, look-up, CSV files, report of several machines, command line. */
#include "limits.h"
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
    return mkdtemp(folder) && chdir(folder) == 0 && sb_make_directories("out/bench/abacus", NULL) == SB_OK &&
                   sb_make_directories("out/bench/slide-rule", NULL) == SB_OK
               ? 0
               : -1;
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

static void test_statistics_of_samples(void **state)
{
    (void)state;
    const double odd[] = {9, 2, 4}, even[] = {8, 2, 4, 3};
    const sb_bench_samples three = samples_of(odd, 3), four = samples_of(even, 4);
    sb_bench_rows rows = {0};
    sb_bench_add(&rows, "a", 10, 1, "q", "ns", &three, 10);
    sb_bench_add(&rows, "a", 10, 2, "q", "ns", &four, 1);
    assert_true(rows.rows[0].least == 20 && rows.rows[0].median == 40 && rows.rows[0].most == 90);
    assert_true(rows.rows[1].least == 2 && rows.rows[1].median == 3.5 && rows.rows[1].most == 8);
    assert_int_equal(rows.rows[1].repeats, 4);
    assert_ptr_equal(sb_bench_find(&rows, "a", 10, 2, "q"), &rows.rows[1]);
    assert_ptr_equal(sb_bench_find(&rows, "a", 0, 0, "q"), &rows.rows[0]);
    assert_null(sb_bench_find(&rows, "a", 11, 0, "q"));
    sb_bench_rows_free(&rows);
}

static void test_tables_are_read_as_written(void **state)
{
    (void)state;
    sb_bench_rows rows = {0}, back = {0};
    char origin[256];
    bool found;
    for (int i = 0; i < 20; i++)
        sb_bench_add_value(&rows, "plant at 4 m; paper", 100 + (size_t)i, 2, "time, \"per\" pair", "ns", 0.5 * i);
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

static void test_foreign_tables_are_refused(void **state)
{
    (void)state;
    sb_bench_rows rows = {0};
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
        sb_bench_add_value(&rows, SB_BENCH_STEP, costs[i].particles, costs[i].threads, SB_BENCH_PER_PARTICLE, "ns",
                           costs[i].ns);
    assert_true(sb_bench_growth(&rows) > 1.099 && sb_bench_growth(&rows) < 1.101);
    assert_int_equal(sb_bench_write(&rows, origin, "out/bench/abacus/scaling.csv", NULL), SB_OK);
    sb_bench_rows_free(&rows);
}

static char *text_of(const char *path)
{
    static char *text;
    size_t length;
    assert_int_equal(sb_file_read(path, 1 << 20, &text, &length, NULL), SB_OK);
    return text;
}

static char *report_text(void)
{
    assert_int_equal(sb_bench_report("out", NULL), SB_OK);
    return text_of("out/benchmarks.md");
}

/* A pressure iteration of 40 ns, and the copy bandwidth of that machine. */
static void write_kernels(const char *path, const char *origin, double copy)
{
    sb_bench_rows rows = {0};
    sb_bench_add_value(&rows, SB_BENCH_MACHINE, 0, 2, SB_BENCH_COPY, "GB/s", copy);
    sb_bench_add_value(&rows, SB_BENCH_ITERATION, 1000000, 2, SB_BENCH_PER_PARTICLE, "ns", 40);
    assert_int_equal(sb_bench_write(&rows, origin, path, NULL), SB_OK);
    sb_bench_rows_free(&rows);
}

/* Expects a text; returns a pointer behind it. */
static const char *expect_in(const char *text, const char *expected)
{
    const char *at = strstr(text, expected);
    if (!at) fail_msg("no \"%s\" in\n%s", expected, text);
    return at + strlen(expected);
}

static void test_figures_are_judged(void **state)
{
    (void)state;
    write_scaling("machine: abacus, 2 cores\ncommit: abc\nmeasured: 2 threads\n");
    char *text = report_text();
    expect_in(text, "| cost per particle, 50 k to 4 M particles |  | 1.1 | × | ≤ 1.3 | 1.2 | within stretch target | "
                    "abc |\n");
    expect_in(text, "1 M particles |  | 0.909 |  | ≥ 0.9 | 0.95 | within | abc |\n");
    expect_in(text, "| 1000000 | 2 | 66 | 0.909 |\n");
    assert_null(strstr(text, "conical island")); /* a figure that was not measured has no row */
    sb_free(text);
}

/* 40 ns are 800 bytes for a machine that copies 20 GB/s, 2000 bytes for one that copies 50 GB/s. */
static void test_each_machine_has_its_own_tables(void **state)
{
    (void)state;
    write_kernels("out/bench/abacus/kernels.csv", "machine: abacus, 2 cores\ncommit: abc\n", 20);
    write_kernels("out/bench/slide-rule/kernels.csv", "machine: slide rule, 2 cores\ncommit: def\n", 50);
    char *text = report_text();
    const char *at = expect_in(text, "\n## abacus, 2 cores; copy bandwidth 20 GB/s on 2 threads\n");
    at = expect_in(at, "| 40 ns | 0.8 | kB per particle | ≤ 0.95 | 0.84 | within stretch target | abc |");
    at = expect_in(at, "### scaling");
    at = expect_in(at, "\n## slide rule, 2 cores; copy bandwidth 50 GB/s on 2 threads\n");
    at = expect_in(at, "| 40 ns | 2 | kB per particle | ≤ 0.95 | 0.84 | **missed** | def |");
    assert_null(strstr(at, "### scaling")); /* only the abacus has this table */
    sb_free(text);
    assert_int_equal(remove("out/bench/abacus/kernels.csv"), 0);
    assert_int_equal(remove("out/bench/slide-rule/kernels.csv"), 0);
}

/* 9 s for 1000 particles: 1800 kB per particle for a machine that copies 0.2 GB/s. */
static void test_times_are_judged_only_with_bandwidth(void **state)
{
    (void)state;
    sb_bench_rows rows = {0};
    sb_bench_add_value(&rows, "conical island", 1000, 2, "run time per simulated second", "s", 9);
    assert_int_equal(sb_bench_write(&rows, "commit: abc\n", "out/bench/slide-rule/island.csv", NULL), SB_OK);
    sb_bench_rows_free(&rows);
    char *text = report_text();
    expect_in(text, "| 9 s | bandwidth not measured | kB per particle | ≤ 2910 | 1450 |  | abc |\n");
    expect_in(text, "\n## slide-rule; copy bandwidth not measured\n");
    sb_free(text);
    write_kernels("out/bench/slide-rule/kernels.csv", "commit: abc\n", 0.2);
    text = report_text();
    expect_in(text, "| 9 s | 1800 | kB per particle | ≤ 2910 | 1450 | within | abc |\n");
    sb_free(text);
    assert_int_equal(remove("out/bench/slide-rule/kernels.csv"), 0);
    assert_int_equal(remove("out/bench/slide-rule/island.csv"), 0);
}

static void test_tables_of_other_machine_are_not_replaced(void **state)
{
    (void)state;
    sb_error error = {0};
    const sb_bench_request near = {.threads = 2, .copy = 24e9}, far = {.threads = 2, .copy = 30e9},
                           one_thread = {.threads = 1, .copy = 30e9};
    write_kernels("out/bench/abacus/kernels.csv", "commit: abc\n", 20);
    assert_int_equal(sb_bench_same_machine("out/bench/abacus", &near, &error), SB_OK);
    assert_int_equal(sb_bench_same_machine("out/bench/abacus", &one_thread, &error), SB_OK);
    assert_int_equal(sb_bench_same_machine("out/bench/slide-rule", &far, &error), SB_OK); /* no tables yet */
    assert_int_equal(sb_bench_same_machine("out/bench/abacus", &far, &error), SB_BAD_INPUT);
    expect_in(error.text,
              "out/bench/abacus: its tables are of a machine that copies 20 GB/s, this machine copies 30 GB/s");
    expect_in(error.text, "--machine NAME");
    assert_int_equal(remove("out/bench/abacus/kernels.csv"), 0);
}

static void test_folder_name_from_processor(void **state)
{
    (void)state;
    char name[128];
    sb_bench_folder("Intel(R) Xeon(R) Gold 6230 @ 2.1GHz, 2 cores", name);
    assert_string_equal(name, "intel-xeon-gold-6230-2-1ghz-2-cores");
}

static void test_delivered_report_matches_delivered_tables(void **state)
{
    (void)state;
    assert_int_equal(system("mkdir kept && cp -r " SB_SOURCE_DIR "/docs/results/bench kept/"), 0);
    assert_int_equal(sb_bench_report("kept", NULL), SB_OK);
    char *made = text_of("kept/benchmarks.md"), *delivered = text_of(SB_SOURCE_DIR "/docs/results/benchmarks.md");
    if (!strstr(made, "No plot")) assert_string_equal(made, delivered); /* if gnuplot is installed */
    sb_free(made);
    sb_free(delivered);
}

static void test_quick_forms_are_not_judged(void **state)
{
    (void)state;
    write_scaling("measured: 2 threads, 2 repeats, quick; load\n");
    char *text = report_text();
    assert_null(strstr(text, "| cost per particle, 50 k to 4 M"));
    expect_in(text, "| 1000000 | 2 | 66 | 0.909 |\n");
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

static void test_options_select_sections(void **state)
{
    (void)state;
    sb_bench_options o;
    sb_error error = {0};
    assert_int_equal(parse("", &o, &error), SB_OK);
    assert_int_equal(o.count, 5);
    assert_int_equal(parse("scaling kernels scaling --repeats 3 --quick --out x", &o, &error), SB_OK);
    assert_int_equal(o.count, 2);
    assert_string_equal(o.sections[0]->name, "scaling");
    assert_true(o.repeats == 3 && o.common.quick);
    assert_string_equal(o.common.out, "x");
    static const char *const wrong[][2] = {
        {"pressure", "pressure: no such section"},
        {"--fast", "--fast: no such option"},
        {"--repeats 0", "--repeats: 0 is not a number from 1 to 100"},
        {"--repeats 101", "101 is not a number"},
        {"--threads two", "--threads: two is not a number"},
        {"--machine ../x", "--machine: \"../x\": expected lower-case letters, digits and -"},
        {"--out", "--out: expected a value"}};
    for (size_t w = 0; w < sizeof wrong / sizeof wrong[0]; w++) {
        assert_int_equal(parse(wrong[w][0], &o, &error), SB_BAD_INPUT);
        if (!strstr(error.text, wrong[w][1])) fail_msg("%s: %s", wrong[w][0], error.text);
    }
}

static void test_use_by_other_programs(void **state)
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
        cmocka_unit_test(test_statistics_of_samples),
        cmocka_unit_test(test_tables_are_read_as_written),
        cmocka_unit_test(test_foreign_tables_are_refused),
        cmocka_unit_test(test_figures_are_judged),
        cmocka_unit_test(test_each_machine_has_its_own_tables),
        cmocka_unit_test(test_times_are_judged_only_with_bandwidth),
        cmocka_unit_test(test_tables_of_other_machine_are_not_replaced),
        cmocka_unit_test(test_folder_name_from_processor),
        cmocka_unit_test(test_delivered_report_matches_delivered_tables),
        cmocka_unit_test(test_quick_forms_are_not_judged),
        cmocka_unit_test(test_options_select_sections),
        cmocka_unit_test(test_use_by_other_programs),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}

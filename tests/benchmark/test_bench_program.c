/* Tests of the sections of tools/bench at quick sizes: tables have the rows of the report, and repeats do the same
 * work, failures are reported. */
#include "child.h"
#include "limits.h"
#include "report.h"
#include "subject.h"

#include "base/memory.h"

#include <math.h>
#include <omp.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static sb_bench_request request = {.assets = SB_SOURCE_DIR "/assets", .repeats = 2, .threads = 2, .quick = true};

static sb_bench_rows rows_of(const char *section)
{
    sb_bench_rows rows = {0};
    sb_error error = {0};
    if (sb_bench_limits(&request, &rows, &error) != SB_OK ||
        sb_bench_section_find(section)->run(&request, &rows, &error) != SB_OK)
        fail_msg("%s: %s", section, error.text);
    for (size_t i = 0; i < rows.count; i++)
        if (!(rows.rows[i].least <= rows.rows[i].median && rows.rows[i].median <= rows.rows[i].most))
            fail_msg("%s: %s: no number", rows.rows[i].subject, rows.rows[i].quantity);
    return rows;
}

static double median_of(const sb_bench_rows *rows, const char *subject, const char *quantity)
{
    const sb_bench_row *row = sb_bench_find(rows, subject, 0, 0, quantity);
    if (!row) fail_msg("no row %s, %s", subject, quantity);
    return row->median;
}

static void test_kernels_have_limits_of_machine(void **state)
{
    (void)state;
    static const char *const names[] = {
        "sort", "neighbours", "forces", "source", "pressure acceleration", "pressure divergence"};
    sb_bench_rows rows = rows_of("kernels");
    assert_true(median_of(&rows, SB_BENCH_MACHINE, SB_BENCH_COPY) > 0.1);
    assert_true(median_of(&rows, SB_BENCH_MACHINE, SB_BENCH_ARITHMETIC) > 0.1);
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        assert_true(median_of(&rows, names[k], SB_BENCH_PER_PARTICLE) > 0);
        assert_true(median_of(&rows, names[k], "share of bandwidth") > 0);
    }
    const double step = median_of(&rows, SB_BENCH_STEP, SB_BENCH_PER_PARTICLE);
    assert_true(10 * median_of(&rows, SB_BENCH_ITERATION, SB_BENCH_PER_PARTICLE) < step);
    assert_true(median_of(&rows, "sort and search", SB_BENCH_PER_PARTICLE) < step);
    sb_bench_rows_free(&rows);
}

static void test_scaling_has_both_thread_counts(void **state)
{
    (void)state;
    sb_bench_rows rows = rows_of("scaling");
    assert_int_equal(rows.count, 3 + 4); /* limits, two sizes by two teams */
    assert_true(sb_bench_growth(&rows) > 0);
    assert_true(sb_bench_efficiency(&rows, rows.rows[3].particles, 2) > 0);
    sb_bench_rows_free(&rows);
}

static void test_pictures_of_three_kinds(void **state)
{
    (void)state;
    static const char *const names[] = {"picture but smaller", "picture without shadows and occlusion but smaller",
                                        "picture of 2 M particles but smaller"};
    sb_bench_rows rows = rows_of("pictures");
    assert_int_equal(rows.count, 3 + 9); /* limits, three times of each picture */
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        const double next = median_of(&rows, names[k], SB_BENCH_NEXT_PICTURE);
        assert_true(next > 0 && median_of(&rows, names[k], "first picture") > 0);
        assert_true(median_of(&rows, names[k], "processor time") > 0);
        const double expected = k < 2 ? 2000 : 20000;
        assert_true(fabs((double)sb_bench_find(&rows, names[k], 0, 0, SB_BENCH_NEXT_PICTURE)->particles - expected) <
                    0.05 * expected);
    }
    sb_bench_rows_free(&rows);
}

/* The arrays of the simulation are all of its memory. */
static double sum_of_arrays(const sb_bench_rows *rows)
{
    static const char *const arrays[] = {
        "pair lists in use", "pair lists in reserve", "groups",          "wall pair lists",     "images of walls",
        "pairs at edges",    "facets of walls",       "sums over cells", "fields of particles", "cells",
        "boundary particles"};
    double sum = 0;
    for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
        sum += median_of(rows, "plant but coarser", arrays[k]);
    return sum;
}

/* The bytes of a field are exact on any machine. */
static void test_memory_of_arrays(void **state)
{
    (void)state;
    sb_bench_rows rows = rows_of("memory");
    const double pairs = median_of(&rows, "plant but coarser", "pairs per particle");
    assert_true(pairs > 20 && pairs < 120);
    assert_true(fabs(median_of(&rows, "plant but coarser", "pair lists in use") - 4 * pairs) < 0.01 * pairs);
    assert_true(median_of(&rows, "plant but coarser by the program", "peak memory") > 4 * pairs);
    const double all = median_of(&rows, "plant but coarser", "memory of the simulation");
    print_message("arrays %.1f of %.1f B per particle\n", sum_of_arrays(&rows), all);
    assert_true(median_of(&rows, "plant but coarser", "images of walls") > 0);
    assert_true(fabs(sum_of_arrays(&rows) - all) < 0.005 * all);
    const double land = median_of(&rows, "shore", "boundary particles");
    assert_true(median_of(&rows, "shore with ten times the land", "boundary particles") > 2 * land);
    sb_bench_rows_free(&rows);
}

static sb_status fail_here(const sb_bench_request *of, sb_bench_rows *rows, sb_error *error)
{
    (void)rows;
    return sb_fail(error, SB_BAD_INPUT, "%zu particles: no basin", of->particles);
}

static sb_status crash_here(const sb_bench_request *of, sb_bench_rows *rows, sb_error *error)
{
    (void)of;
    (void)rows;
    (void)error;
    kill(getpid(), SIGKILL);
    return SB_OK;
}

static void test_failure_in_process_is_reported(void **state)
{
    (void)state;
    static const size_t sizes[] = {7, 9, 0};
    sb_bench_rows rows = {0};
    sb_error error = {0};
    assert_int_equal(sb_bench_sizes(fail_here, &request, sizes, &rows, &error), SB_BAD_INPUT);
    assert_string_equal(error.text, "7 particles: no basin");
    assert_int_equal(sb_bench_in_child(crash_here, &request, &rows, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "ended by signal 9"));
}

/* Runs in its own process: the sections fork, and OpenMP must not have been used before. */
static int repeat_twice(void)
{
    sb_bench_subject subject;
    char resolution[32];
    double seconds;
    sb_bench_basin(1000, resolution);
    const sb_override overrides[] = {{"resolution", resolution}, {"numerics.settle_steps", "3"}};
    omp_set_num_threads(1);
    if (sb_bench_subject_make(request.assets, "benchmark/basin.yaml", overrides, 2, 1, &subject, NULL) != SB_OK)
        return 1;
    int wrong = sb_bench_repeat(&subject, 2, &seconds, NULL, NULL) != SB_OK;
    omp_set_num_threads(3);
    wrong |= sb_bench_repeat(&subject, 2, &seconds, NULL, NULL) != SB_OK;
    wrong |= sb_bench_repeat(&subject, 1, &seconds, NULL, NULL) != SB_FAILED; /* other work, another hash */
    subject.state.bytes[subject.state.used / 2] ^= 1;
    wrong |= sb_bench_restore(&subject, NULL) == SB_OK;
    sb_bench_subject_free(&subject);
    return wrong;
}

static void test_repeats_must_do_same_work(void **state)
{
    (void)state;
    int ended;
    const pid_t process = fork();
    if (process == 0) _exit(repeat_twice());
    assert_true(process > 0);
    assert_int_equal(waitpid(process, &ended, 0), process);
    assert_true(WIFEXITED(ended));
    assert_int_equal(WEXITSTATUS(ended), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kernels_have_limits_of_machine), cmocka_unit_test(test_scaling_has_both_thread_counts),
        cmocka_unit_test(test_pictures_of_three_kinds),        cmocka_unit_test(test_memory_of_arrays),
        cmocka_unit_test(test_failure_in_process_is_reported), cmocka_unit_test(test_repeats_must_do_same_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Tests of the limits of growth that tools/soak applies. */
#include "../check.h"

#include "base/memory.h"
#include "lives.h"

#include <string.h>
#include <unistd.h>

enum { SAMPLES = 200 };

/* A life of 10 minutes. Its first streamed step comes after 100 s, at 200 MB and 10 descriptors, which grow by the
   given rates afterwards. */
static sb_soak_life growing_life(double bytes_per_second, double descriptors_per_second)
{
    sb_soak_life life = {.seconds = 600, .end = SB_SOAK_STOPPED, .frames = 7};
    for (int i = 0; i < SAMPLES; i++) {
        const double t = 3.0 * i, since = fmax(t - 100, 0);
        const sb_soak_sample sample = {.seconds = t,
                                       .resident = (uint64_t)(t < 100 ? 5e7 : 2e8 + bytes_per_second * since),
                                       .descriptors = (unsigned)(10 + descriptors_per_second * since),
                                       .step = t < 100 ? 0 : (uint64_t)t};
        assert_int_equal(sb_soak_add(&life, &sample, NULL), SB_OK);
    }
    return life;
}

static void assert_problem(sb_soak_life life, const char *expected)
{
    char why[400];
    assert_int_equal(sb_soak_passed(&life, why), *expected == '\0');
    if (!strstr(why, expected)) fail_msg("\"%s\" is not in \"%s\"", expected, why);
    sb_free(life.samples);
}

static void test_start_is_not_growth(void **state)
{
    (void)state;
    assert_problem(growing_life(0, 0), "");
}

/* The medians of the early and the late part are 250 s apart; 10 MB of growth are allowed. */
static void test_memory_growth_is_limited(void **state)
{
    (void)state;
    assert_problem(growing_life(35e3, 0), "");
    assert_problem(growing_life(45e3, 0), "memory grew by 11.");
}

static void test_descriptors_may_not_grow(void **state)
{
    (void)state;
    assert_problem(growing_life(0, 0.01), "descriptors grew from 1");
}

static void test_failed_process_is_explained(void **state)
{
    (void)state;
    sb_soak_life life = growing_life(0, 0);
    life.end = SB_SOAK_FAILED;
    strcpy(life.message, "ended with signal 11: no output");
    assert_problem(life, "signal 11");
}

static void test_frames_must_arrive(void **state)
{
    (void)state;
    sb_soak_life life = growing_life(0, 0);
    life.frames = 0;
    assert_problem(life, "no frame");
}

static void test_short_life_is_not_judged(void **state)
{
    (void)state;
    sb_soak_life life = growing_life(1e6, 0);
    life.seconds = 150;
    assert_false(sb_soak_growth_of(&life).judged);
    assert_problem(life, "");
}

static void test_process_is_measured(void **state)
{
    (void)state;
    sb_soak_sample before = {0}, after = {0};
    assert_int_equal(sb_soak_measure(getpid(), &before, NULL), SB_OK);
    const int more = dup(STDOUT_FILENO);
    enum { BYTES = 1 << 25 };
    char *block = sb_alloc(BYTES, 1);
    assert_non_null(block);
    memset(block, 1, BYTES);
    assert_int_equal(sb_soak_measure(getpid(), &after, NULL), SB_OK);
    close(more);
    assert_int_equal(block[BYTES / 2], 1);
    sb_free(block);
    assert_int_equal(after.descriptors, before.descriptors + 1);
    assert_true(after.resident > before.resident + BYTES / 2);
    assert_int_equal(sb_soak_measure(-1, &after, NULL), SB_FAILED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_start_is_not_growth),      cmocka_unit_test(test_memory_growth_is_limited),
        cmocka_unit_test(test_descriptors_may_not_grow), cmocka_unit_test(test_failed_process_is_explained),
        cmocka_unit_test(test_frames_must_arrive),       cmocka_unit_test(test_short_life_is_not_judged),
        cmocka_unit_test(test_process_is_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

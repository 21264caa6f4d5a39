/* The stage table of `run --profile`. */
#include "output/log/profile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static char *printed(const sb_profile *profile)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    sb_profile_print(out, profile);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_contains(const char *text, const char *expected)
{
    if (!strstr(text, expected)) fail_msg("\"%s\" is not in\n%s", expected, text);
}

static const sb_stage_time stages[] = {{"sort", 0.25, 20}, {"source", 0.5, 20}, {"pressure", 1.25, 20}};
static const sb_skipped none[] = {{"stress correction: off", 3, 0}, {"turbulence: none", 1, 2500000}, {.what = NULL}},
                        off[] = {{.what = "stream: off"}, {.what = NULL}};

static const sb_profile profile = {
    .stages = stages,
    .stage_count = 3,
    .steps = 15,
    .iterations = 60,
    .particle_steps = 15e3,
    .settling_particles = 1000, /* in five steps: 20 000 particle-steps in total */
    .setup = 0.5,
    .settling = 0.75,
    .wall = 3,
    .simulated = 1.5,
    .bytes = 2500000,
    .threads = 2,
    .skipped = {none, NULL, off},
};

static void fractions_and_costs_include_settling(void **state)
{
    (void)state;
    char *text = printed(&profile);
    assert_contains(text, "sort                      20      0.250   12.5%               12500.00\n");
    assert_contains(text, "pressure                  20      1.250   62.5%               62500.00\n");
    assert_contains(text, "all stages                        2.000  100.0%              100000.00\n");
    assert_contains(text, "15 steps after 5 settling steps, 4.0 iterations per step, "
                          "1e+04 particle-steps per second, 2 threads\n");
    assert_contains(text,
                    "3.000 s in total: 0.500 s set-up, 0.750 s settling, 0.500 s outside stages; 1.5 s simulated\n");
    assert_contains(text, "simulation 2.5 MB, peak of the process ");
    free(text);
}

static void skipped_terms_are_listed_with_their_savings(void **state)
{
    (void)state;
    char *text = printed(&profile);
    assert_contains(text, "  stress correction: off; 3 passes over particle pairs per step\n"
                          "  turbulence: none; 1 pass over particle pairs per step; 2.5 MB\n  stream: off\n");
    assert_contains(
        text,
        "saved: 4 passes over particle pairs per step, about 2 s so far; 2.5 MB\n"); /* 4 times the stage source */
    free(text);
}

static void a_run_without_steps_does_not_divide_by_zero(void **state)
{
    (void)state;
    const sb_profile empty = {.threads = 1};
    char *text = printed(&empty);
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf"));
    assert_contains(text, "0 steps after 0 settling steps");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fractions_and_costs_include_settling),
        cmocka_unit_test(skipped_terms_are_listed_with_their_savings),
        cmocka_unit_test(a_run_without_steps_does_not_divide_by_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What the soak holds against the samples of a life. */
#include "../check.h"

#include "base/memory.h"
#include "lives.h"

#include <string.h>
#include <unistd.h>

enum { SAMPLES = 200 };

/* A life of 10 minutes whose first streamed step comes after 100 s, at 200 MB and 10 descriptors, that grows by so much
   in each second after that. */
static sb_soak_life life_that_grows(double bytes_per_second, double descriptors_per_second)
{
    sb_soak_life life = {.seconds = 600, .end = SB_SOAK_STOPPED, .frames = 7};
    for (int i = 0; i < SAMPLES; i++) {
        const double t = 3.0 * i, since = fmax(t - 100, 0);
        const sb_soak_sample sample = {.seconds = t,
                                       .resident = (uint64_t)(t < 100 ? 5e7 : 2e8 + bytes_per_second * since),
                                       .descriptors = (unsigned)(10 + descriptors_per_second * since),
                                       .step = t < 100 ? 0 : (uint64_t)t};
        assert_int_equal(sb_soak_keep(&life, &sample, NULL), SB_OK);
    }
    return life;
}

static void says(sb_soak_life life, const char *words)
{
    char why[400];
    assert_int_equal(sb_soak_well(&life, why), *words == '\0');
    if (!strstr(why, words)) fail_msg("\"%s\" is not in \"%s\"", words, why);
    sb_free(life.samples);
}

static void the_start_is_no_growth(void **state)
{
    (void)state;
    says(life_that_grows(0, 0), "");
}

/* From the middle of the early part to that of the late one are 250 of the 500 s: 10 MB are allowed. */
static void memory_may_grow_so_far_and_no_further(void **state)
{
    (void)state;
    says(life_that_grows(35e3, 0), "");
    says(life_that_grows(45e3, 0), "memory grew by 11.");
}

static void no_descriptor_may_stay_open(void **state)
{
    (void)state;
    says(life_that_grows(0, 0.01), "descriptors grew from 1");
}

static void a_broken_life_tells_how(void **state)
{
    (void)state;
    sb_soak_life life = life_that_grows(0, 0);
    life.end = SB_SOAK_BROKEN;
    strcpy(life.words, "ended with signal 11: it said nothing");
    says(life, "signal 11");
}

static void frames_have_to_arrive(void **state)
{
    (void)state;
    sb_soak_life life = life_that_grows(0, 0);
    life.frames = 0;
    says(life, "no frame");
}

static void a_short_life_is_not_judged(void **state)
{
    (void)state;
    sb_soak_life life = life_that_grows(1e6, 0);
    life.seconds = 150;
    assert_false(sb_soak_grown(&life).judged);
    says(life, "");
}

static void a_process_is_seen(void **state)
{
    (void)state;
    sb_soak_sample before = {0}, after = {0};
    assert_int_equal(sb_soak_look(getpid(), &before, NULL), SB_OK);
    const int more = dup(STDOUT_FILENO);
    enum { BYTES = 1 << 25 };
    char *block = sb_alloc(BYTES, 1);
    assert_non_null(block);
    memset(block, 1, BYTES);
    assert_int_equal(sb_soak_look(getpid(), &after, NULL), SB_OK);
    close(more);
    assert_int_equal(block[BYTES / 2], 1);
    sb_free(block);
    assert_int_equal(after.descriptors, before.descriptors + 1);
    assert_true(after.resident > before.resident + BYTES / 2);
    assert_int_equal(sb_soak_look(-1, &after, NULL), SB_FAILED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_start_is_no_growth),      cmocka_unit_test(memory_may_grow_so_far_and_no_further),
        cmocka_unit_test(no_descriptor_may_stay_open), cmocka_unit_test(a_broken_life_tells_how),
        cmocka_unit_test(frames_have_to_arrive),       cmocka_unit_test(a_short_life_is_not_judged),
        cmocka_unit_test(a_process_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The oscillating drop of test_drops.c in three dimensions. */
#include "sim/terms/oscillate.h"

static void a_ball_of_ten_spacings(void **state)
{
    (void)state;
    oscillate(&(case_of_drop){{3, 0.1, 1.05, false, 0}, 1.3, 4, 0.03, 0.02});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_of_ten_spacings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

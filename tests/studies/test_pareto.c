/* Tests of the Pareto front. */
#include "check.h"

#include "pareto.h"

#include "base/random.h"

enum { MANY = 60 };

static void test_front_of_given_points(void **state)
{
    (void)state;
    static const double time[] = {1, 2, 3, 2, 4, 0.5}, error[] = {9, 5, 5, 4, 1, 20};
    static const bool expected[] = {true, false, false, true, true, true};
    bool front[6];
    sb_pareto_front(time, error, 6, front);
    for (int i = 0; i < 6; i++) assert_int_equal(front[i], expected[i]);
}

static void test_equal_points_and_nan(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double time[] = {1, 1, nan, 0.1}, error[] = {2, 2, 0, nan};
    bool front[4];
    sb_pareto_front(time, error, 4, front);
    assert_true(front[0] && front[1]);
    assert_false(front[2] || front[3]);
}

/* Along the front, errors fall with time; every other point is dominated by a point of the front. */
static void test_front_of_random_points(void **state)
{
    (void)state;
    double time[MANY], error[MANY];
    bool front[MANY];
    for (uint64_t i = 0; i < MANY; i++) {
        time[i] = sb_random(7, 2 * i);
        error[i] = sb_random(7, 2 * i + 1);
    }
    sb_pareto_front(time, error, MANY, front);
    for (int i = 0; i < MANY; i++) {
        bool dominated = false;
        for (int k = 0; k < MANY; k++) {
            if (front[i] && front[k] && time[k] < time[i]) assert_true(error[k] > error[i]);
            dominated = dominated || (front[k] && time[k] < time[i] && error[k] < error[i]);
        }
        assert_true(front[i] != dominated);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_front_of_given_points),
        cmocka_unit_test(test_equal_points_and_nan),
        cmocka_unit_test(test_front_of_random_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

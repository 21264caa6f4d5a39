/* The front: what nothing beats, and only that. */
#include "check.h"

#include "pareto.h"

#include "base/random.h"

enum { MANY = 60 };

static void test_a_hand_made_front(void **state)
{
    (void)state;
    static const double time[] = {1, 2, 3, 2, 4, 0.5}, error[] = {9, 5, 5, 4, 1, 20};
    static const bool expected[] = {true, false, false, true, true, true};
    bool front[6];
    sb_pareto_front(time, error, 6, front);
    for (int i = 0; i < 6; i++) assert_int_equal(front[i], expected[i]);
}

static void test_equal_points_share_the_front_and_nan_is_on_none(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double time[] = {1, 1, nan, 0.1}, error[] = {2, 2, 0, nan};
    bool front[4];
    sb_pareto_front(time, error, 4, front);
    assert_true(front[0] && front[1]);
    assert_false(front[2] || front[3]);
}

/* Sorted by time, the front's errors fall, and every other point has one of it below. */
static void test_the_front_of_chance_points(void **state)
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
        bool beaten = false;
        for (int k = 0; k < MANY; k++) {
            if (front[i] && front[k] && time[k] < time[i]) assert_true(error[k] > error[i]);
            beaten = beaten || (front[k] && time[k] < time[i] && error[k] < error[i]);
        }
        assert_true(front[i] != beaten);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_hand_made_front),
        cmocka_unit_test(test_equal_points_share_the_front_and_nan_is_on_none),
        cmocka_unit_test(test_the_front_of_chance_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

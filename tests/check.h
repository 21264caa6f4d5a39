/* cmocka with what it needs before it, and the comparison of doubles it lacks. */
#ifndef SB_TESTS_CHECK_H
#define SB_TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Fails, with both values, unless |actual - expected| <= tolerance (so NaN fails). */
#define assert_near(actual, expected, tolerance)                                                                       \
    do {                                                                                                               \
        double near_actual = (actual), near_expected = (expected), near_by = (tolerance);                              \
        if (!(fabs(near_actual - near_expected) <= near_by))                                                           \
            fail_msg("%s is %.17g, expected %.17g within %g", #actual, near_actual, near_expected, near_by);           \
    } while (0)

#endif

/* Sums that do not depend on the order of their terms. */
#include "../check.h"

#include "base/exact.h"
#include "base/hash.h"

#include <stdlib.h>

enum { TERMS = 3000 };

/* Terms of both signs over fifty orders of magnitude. */
static void make_terms(double *term, uint64_t seed)
{
    for (size_t k = 0; k < TERMS; k++) {
        const double mantissa = 2 * (double)(sb_hash_mix(seed + 3 * k) >> 11) * 0x1p-53 - 1;
        term[k] = ldexp(mantissa, (int)(sb_hash_mix(seed + 3 * k + 1) % 160) - 80);
    }
}

static void any_order_and_division_gives_the_same_bits(void **state)
{
    (void)state;
    static double term[TERMS];
    for (uint64_t seed = 0; seed < 20; seed++) {
        make_terms(term, seed * 100000);
        sb_exact forward = {0}, backward = {0}, part[3] = {{{0}, false}, {{0}, false}, {{0}, false}};
        for (size_t k = 0; k < TERMS; k++) sb_exact_add(&forward, term[k]);
        for (size_t k = TERMS; k-- > 0;) sb_exact_add(&backward, term[k]);
        for (size_t k = 0; k < TERMS; k++) sb_exact_add(&part[sb_hash_mix(k) % 3], term[k]);
        sb_exact_merge(&part[2], &part[0]);
        sb_exact_merge(&part[2], &part[1]);
        const double sum = sb_exact_value(&forward);
        assert_true(sum == sb_exact_value(&backward));
        assert_true(sum == sb_exact_value(&part[2]));
        long double reference = 0, size = 0;
        for (size_t k = 0; k < TERMS; k++) reference += (long double)term[k], size += fabsl((long double)term[k]);
        assert_near(sum, (double)reference, 1e-15 * (double)size);
    }
}

static void what_cancels_leaves_the_rest(void **state)
{
    (void)state;
    sb_exact sum = {0};
    sb_exact_add(&sum, 1e30);
    sb_exact_add(&sum, 1);
    sb_exact_add(&sum, -1e30);
    assert_near(sb_exact_value(&sum), 1, 0);
    sb_exact_add(&sum, -3);
    assert_near(sb_exact_value(&sum), -2, 0);
    sb_exact_add(&sum, 2);
    assert_near(sb_exact_value(&sum), 0, 0);
}

static void single_terms_come_back(void **state)
{
    (void)state;
    static const double term[] = {0, 1, -1, 0.1, -1e-20, 1e-30, 3.14159e40, -7.25e15, 0x1.fffffffffffffp100};
    for (size_t k = 0; k < sizeof term / sizeof *term; k++) {
        sb_exact sum = {0};
        sb_exact_add(&sum, term[k]);
        assert_near(sb_exact_value(&sum), term[k], 0x1p-160);
    }
}

static void what_is_no_number_makes_the_sum_none(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e60};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        sb_exact sum = {0}, other = {0};
        sb_exact_add(&sum, bad[k]);
        assert_true(isnan(sb_exact_value(&sum)));
        sb_exact_add(&other, 1);
        sb_exact_merge(&other, &sum);
        assert_true(isnan(sb_exact_value(&other)));
    }
    sb_exact tiny = {0};
    sb_exact_add(&tiny, 1e-300);
    sb_exact_add(&tiny, 5e-324);
    assert_near(sb_exact_value(&tiny), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_order_and_division_gives_the_same_bits),
        cmocka_unit_test(what_cancels_leaves_the_rest),
        cmocka_unit_test(single_terms_come_back),
        cmocka_unit_test(what_is_no_number_makes_the_sum_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

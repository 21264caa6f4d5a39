/* Every kernel of the table: shape, normalisation, slope, and its sum over a lattice. */
#include "../check.h"
#include "physics/kernels/kernel.h"

static const double h = 1.7; /* m: no power of it is 1 */

static void names_are_unique_and_found(void **state)
{
    (void)state;
    size_t count = 0;
    for (const sb_kernel *const *row = sb_kernels; *row; row++, count++) {
        assert_true((*row)->name[0] && (*row)->summary[0] && (*row)->reference[0]);
        assert_ptr_equal(sb_kernel_find((*row)->name), *row);
        assert_true((*row)->support >= 2);
    }
    assert_int_equal(count, 3);
    assert_null(sb_kernel_find("cubi"));
    assert_null(sb_kernel_find(""));
}

/* Simpson's rule over r in [0, h], split at h/2 where the cubic's third derivative jumps. */
static double integral(const sb_kernel *kernel, int dimension)
{
    const double shell[] = {0, 2, 2 * M_PI, 4 * M_PI};
    enum { INTERVALS = 2000 };
    double step = h / INTERVALS, sum = 0;
    for (int i = 0; i <= INTERVALS; i++) {
        double r = i * step, weight = i == 0 || i == INTERVALS ? 1 : i % 2 ? 4 : 2;
        sum += weight * sb_kernel_value(kernel, dimension, h, r) * pow(r, dimension - 1);
    }
    return shell[dimension] * sum * step / 3;
}

static void integrates_to_one(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 1; dimension <= 3; dimension++) assert_near(integral(*row, dimension), 1, 1e-10);
}

static void slope_is_the_derivative(void **state)
{
    (void)state;
    const double step = 1e-5;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 1; dimension <= 3; dimension++)
            for (double r = 0.013; r < h - step; r += 0.0171) {
                double difference =
                    (sb_kernel_value(*row, dimension, h, r + step) - sb_kernel_value(*row, dimension, h, r - step)) /
                    (2 * step);
                assert_near(sb_kernel_slope(*row, dimension, h, r), difference, 1e-8);
            }
}

static void decreases_to_zero_at_the_support_radius(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 1; dimension <= 3; dimension++) {
            double last = sb_kernel_value(*row, dimension, h, 0);
            assert_true(sb_kernel_slope(*row, dimension, h, 0) == 0);
            for (double r = 0.01; r < h; r += 0.01) {
                double value = sb_kernel_value(*row, dimension, h, r);
                assert_true(value > 0 && value < last);
                assert_true(sb_kernel_slope(*row, dimension, h, r) < 0);
                last = value;
            }
            assert_true(sb_kernel_value(*row, dimension, h, h * (1 - 1e-6)) < 1e-11);
            assert_true(sb_kernel_value(*row, dimension, h, h) == 0);
            assert_true(sb_kernel_slope(*row, dimension, h, h) == 0);
            assert_true(sb_kernel_value(*row, dimension, h, 2 * h) == 0);
        }
}

/* Sum of V W over a unit lattice. */
static double lattice_sum(const sb_kernel *kernel, int dimension, double support)
{
    double sum = 0;
    for (int i = -4; i <= 4; i++)
        for (int j = -4; j <= 4; j++)
            for (int k = dimension == 3 ? -4 : 0; k <= (dimension == 3 ? 4 : 0); k++)
                sum += sb_kernel_value(kernel, dimension, support, sqrt(i * i + j * j + k * k));
    return sum;
}

static void lattice_sums_equal_known_values(void **state)
{
    (void)state;
    const sb_kernel *cubic = sb_kernel_find("cubic"), *c2 = sb_kernel_find("wendland-c2");
    assert_near(lattice_sum(cubic, 3, 2), 0.99997, 5e-6);
    assert_near(lattice_sum(cubic, 2, 2), 1.00086, 5e-6);
    assert_near(lattice_sum(c2, 3, 2), 1.034, 5e-4);
}

static void lattice_has_unit_density_at_the_recommended_support(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 2; dimension <= 3; dimension++)
            assert_near(lattice_sum(*row, dimension, (*row)->support), 1, 6e-3);
}

/* A single particle without neighbours has 8/pi / 2^3 = 0.318 of the rest density. */
static void single_particle_has_its_known_density(void **state)
{
    (void)state;
    assert_near(sb_kernel_value(sb_kernel_find("cubic"), 3, 2, 0), 0.318310, 5e-7);
}

/* The simulation stores (dw/dq)/q as a fraction of its value at q = 0. */
static void slope_over_q_is_bounded(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++) {
        const double most = -(*row)->slope(1e-4) / 1e-4;
        assert_true(most > 1 && most < 1000);
        for (double q = 0.001; q < 1; q += 0.001) {
            const double here = -(*row)->slope(q) / q;
            assert_true(here >= 0 && here <= most);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_unique_and_found),
        cmocka_unit_test(integrates_to_one),
        cmocka_unit_test(slope_is_the_derivative),
        cmocka_unit_test(decreases_to_zero_at_the_support_radius),
        cmocka_unit_test(slope_over_q_is_bounded),
        cmocka_unit_test(lattice_sums_equal_known_values),
        cmocka_unit_test(lattice_has_unit_density_at_the_recommended_support),
        cmocka_unit_test(single_particle_has_its_known_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Water at rest stays at rest; volume is conserved; bits do not depend on the number of threads. */
#include "grid_case.h"

#include <omp.h>
#include <string.h>

/* A pseudo-random value in 0..1 of a cell, so that the bed is rough from cell to cell. */
static double rough(double x, double y)
{
    const double value = sin(12.9898 * floor(x) + 78.233 * floor(y)) * 43758.5453;
    return value - floor(value);
}

/* Depth 100 m with two islands and a step, rough by 3 m. */
static double islands(double x, double y)
{
    const double a = hypot(x - 30, y - 20), b = hypot(x - 70, y - 60);
    return -100 + 150 * exp(-a * a / 80) + 120 * exp(-b * b / 200) + (x > 50 ? 20 : 0) + 3 * rough(x, y);
}

static grid_water at_rest(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = fmax(0, -islands(x, y))};
}

static sb_offshore_options sea(sb_offshore_side side)
{
    return (sb_offshore_options){
        .columns = 100, .rows = 80, .cell = 1, .gravity = 9.81, .side = {side, side, side, side}};
}

/* 1e-12 m/s: rounding of depths of 100 m is 1e-14 m, which waves of sqrt(g/h) turn into a hundredth of this. */
static void lake_at_rest(void **state)
{
    (void)state;
    for (int side = SB_OFFSHORE_WALL; side <= SB_OFFSHORE_PERIODIC; side++)
        for (int dispersion = 0; dispersion < 2; dispersion++) {
            sb_offshore_options options = sea((sb_offshore_side)side);
            options.dispersion = dispersion;
            sb_offshore *offshore = grid_create(&options, islands, at_rest);
            sb_error error = {0};
            for (int k = 0; k < 100; k++) assert_int_equal(sb_offshore_step(offshore, 1, NULL, &error), SB_OK);
            assert_near(grid_fastest(offshore), 0, 1e-12);
            assert_near(grid_error(offshore, at_rest), 0, 1e-12);
            sb_offshore_destroy(offshore);
        }
}

/* A hill of water that floods both islands. */
static grid_water hill(double x, double y, double time)
{
    (void)time;
    const double a = hypot(x - 50, y - 35);
    return (grid_water){.h = fmax(0, 40 * exp(-a * a / 100) - islands(x, y))};
}

static void volume_is_conserved(void **state)
{
    (void)state;
    for (int side = SB_OFFSHORE_WALL; side <= SB_OFFSHORE_PERIODIC; side++) {
        sb_offshore_options options = sea((sb_offshore_side)side);
        options.manning = 0.03;
        sb_offshore *offshore = grid_create(&options, islands, hill);
        grid_run(offshore, 8);
        assert_near(grid_imbalance(offshore), 0, 1e-13);
        const sb_offshore_balance b = sb_offshore_find_balance(offshore);
        assert_near(b.repaired / b.first, 0, 1e-13);
        if (side == SB_OFFSHORE_OPEN)
            assert_true(b.entered[SB_OFFSHORE_X_MIN] < -1);
        else
            for (int s = 0; s < SB_OFFSHORE_SIDES && side == SB_OFFSHORE_WALL; s++)
                assert_near(b.entered[s] / b.first, 0, 1e-15);
        sb_offshore_destroy(offshore);
    }
}

static void run_threads(int threads, bool dispersion, double *out, size_t size)
{
    omp_set_num_threads(threads);
    sb_offshore_options options = sea(SB_OFFSHORE_OPEN);
    options.columns = 170;
    options.rows = 150;
    options.manning = 0.02;
    options.dispersion = dispersion;
    sb_offshore *offshore = grid_create(&options, islands, hill);
    sb_error error = {0};
    for (int k = 0; k < 12; k++) assert_int_equal(sb_offshore_step(offshore, 1, NULL, &error), SB_OK);
    const sb_offshore_view v = sb_offshore_read(offshore);
    assert_true(3 * v.rows * v.columns <= size);
    for (size_t j = 0; j < v.rows; j++) {
        memcpy(out + (3 * j) * v.columns, v.h + j * v.stride, v.columns * sizeof *out);
        memcpy(out + (3 * j + 1) * v.columns, v.hu + j * v.stride, v.columns * sizeof *out);
        memcpy(out + (3 * j + 2) * v.columns, v.hv + j * v.stride, v.columns * sizeof *out);
    }
    sb_offshore_destroy(offshore);
}

static void same_bits_for_any_threads(void **state)
{
    (void)state;
    enum { SIZE = 3 * 170 * 150 };
    static double one[SIZE], other[SIZE];
    for (int dispersion = 0; dispersion < 2; dispersion++) {
        run_threads(1, dispersion, one, SIZE);
        for (int threads = 2; threads <= 3; threads++) {
            run_threads(threads, dispersion, other, SIZE);
            assert_memory_equal(one, other, sizeof one);
        }
    }
}

static void refuses_bad_input(void **state)
{
    (void)state;
    const double bed[4] = {0}, depth[4] = {1, 1, -1, 1};
    sb_offshore *offshore = NULL;
    sb_error error = {0};
    sb_offshore_options options = {.columns = 2, .rows = 2, .cell = 1, .gravity = 9.81};
    assert_int_equal(sb_offshore_create(&options, bed, depth, NULL, NULL, &offshore, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "column 0, row 1"));
    options.side[0] = SB_OFFSHORE_PERIODIC;
    assert_int_equal(sb_offshore_create(&options, bed, bed, NULL, NULL, &offshore, &error), SB_BAD_INPUT);
    options.side[0] = SB_OFFSHORE_GIVEN;
    assert_int_equal(sb_offshore_create(&options, bed, bed, NULL, NULL, &offshore, &error), SB_BAD_INPUT);
    assert_null(offshore);
    sb_offshore_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lake_at_rest),
        cmocka_unit_test(volume_is_conserved),
        cmocka_unit_test(same_bits_for_any_threads),
        cmocka_unit_test(refuses_bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

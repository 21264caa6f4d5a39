/* Surface gauges find a known level within 0.1 spacing, at any position. */
#include "fake_sim.h"

#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

static double read_at(fake_world *world, double x, double y)
{
    sb_measure_view view = fake_view(world);
    sb_error error = {0};
    double eta, water;
    assert_int_equal(sb_gauge_read(&view, x, y, &(sb_floors){0}, &eta, &water, &error), SB_OK);
    return eta;
}

/* Worst and mean error in spacings over many gauge positions in still water of the given depth. */
static void still_water(int dimensions, double spacing, double depth, double jitter, double *worst, double *mean)
{
    enum { TRIALS = 200 };
    double level = 3.37, size = 12 * spacing;
    *worst = *mean = 0;
    for (int t = 0; t < TRIALS; t++) {
        fake_world world;
        fake_world_make(&world, dimensions, spacing, sb_vec(0, 0, level - 20 * spacing),
                        sb_vec(size, size, level + 20 * spacing));
        fake_fill(&world, sb_vec(0, 0, level - depth * spacing), sb_vec(size, size, level),
                  sb_random(1, (uint64_t)t) - 0.5, sb_random(2, (uint64_t)t) - 0.5, jitter, (uint64_t)(100 + 3 * t));
        double x = size * (0.4 + 0.2 * sb_random(3, (uint64_t)t));
        double y = size * (0.4 + 0.2 * sb_random(4, (uint64_t)t));
        double error = (read_at(&world, x, dimensions == 2 ? 0 : y) - level) / spacing;
        assert_true(isfinite(error));
        *worst = fmax(*worst, fabs(error));
        *mean += error / TRIALS;
        fake_world_free(&world);
    }
}

static void still_level_is_exact_on_a_lattice(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        double worst, mean;
        still_water(dimensions, 0.31, 9, 0, &worst, &mean);
        print_message("%dD lattice: worst %.5f, mean %+.5f spacings\n", dimensions, worst, mean);
        assert_true(worst < 1e-6);
    }
}

static void still_level_is_unbiased_with_jitter(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (double jitter = 0.1; jitter < 0.25; jitter += 0.1) {
            double worst, mean;
            still_water(dimensions, 0.31, 9, jitter, &worst, &mean);
            print_message("%dD jitter %.1f: worst %.3f, mean %+.4f spacings\n", dimensions, jitter, worst, mean);
            /* A single gauge follows the rough surface; the mean over gauges must be correct. */
            assert_true(fabs(mean) < 0.02);
            assert_true(worst < (dimensions == 3 ? 0.1 : 0.15));
        }
}

static void thin_layers_keep_their_level(void **state)
{
    (void)state;
    for (int layers = 1; layers <= 4; layers++) {
        double worst, mean;
        still_water(3, 1.0, layers, 0, &worst, &mean);
        print_message("%d layers: worst %.3f spacings\n", layers, worst);
        assert_true(worst < 0.1);
    }
}

static void walls_do_not_change_the_level(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, -2), sb_vec(20, 20, 40));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(20, 20, 9), 0, 0, 0, 1);
    for (double d = 0; d < 2.1; d += 0.35) {
        print_message("%.2f from a wall: %+.3f, in the corner %+.3f\n", d, read_at(&world, d, 10) - 9,
                      read_at(&world, d, d) - 9);
        assert_true(fabs(read_at(&world, d, 10) - 9) < 0.1);
        assert_true(fabs(read_at(&world, d, d) - 9) < 0.1);
    }
    assert_true(isnan(read_at(&world, -1.6, 10))); /* behind the wall */
    fake_world_free(&world);
}

static void slope_is_followed(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(40, 12, 40));
    for (double x = 0.5; x < 40; x++)
        for (double y = 0.5; y < 12; y++)
            for (double z = 10 + 0.2 * x - 0.5; z > 0; z--) fake_add(&world.sim, sb_vec(x, y, z), sb_vec(0, 0, 0), 0);
    for (double x = 10; x < 30; x += 2.3) assert_true(fabs(read_at(&world, x, 6) - (10 + 0.2 * x)) < 0.05);
    fake_world_free(&world);
}

static void spray_does_not_count(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, -2), sb_vec(12, 12, 60));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(12, 12, 9), 0.2, 0.3, 0, 1);
    double before = read_at(&world, 6, 6);
    for (int i = 0; i < 6; i++)
        fake_add(&world.sim, sb_vec(6 + 0.4 * (i % 2), 6, 12 + 3 * (i / 2)), sb_vec(0, 0, 0), 0);
    assert_true(read_at(&world, 6, 6) == before);
    fake_world_free(&world);
}

/* Under the crest of a steep wave columns of water are narrower, their rows farther apart. The level is half a row
   above the top row, whatever the stretch. */
static void stretched_water_is_one_body(void **state)
{
    (void)state;
    for (double stretch = 1; stretch < 1.95; stretch += 0.1) {
        double worst = 0;
        fake_world world;
        fake_world_make(&world, 2, 0.1, sb_vec(0, 0, -1), sb_vec(4, 0, 4));
        for (int row = 0; row < 8; row++)
            for (double x = 0.5 * 0.1 / stretch; x < 4; x += 0.1 / stretch)
                fake_add(&world.sim, sb_vec(x, 0, 0.1 * stretch * (row + 0.5)), sb_vec(0, 0, 0), 0);
        for (double x = 1; x < 3; x += 0.037) worst = fmax(worst, fabs(read_at(&world, x, 0) - 0.8 * stretch) / 0.1);
        print_message("rows %.1f spacings apart: worst %.3f spacings\n", stretch, worst);
        assert_true(worst < 0.15);
        fake_world_free(&world);
    }
}

static void dry_is_nan(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, -2), sb_vec(40, 12, 60));
    assert_true(isnan(read_at(&world, 6, 6)));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(12, 12, 9), 0, 0, 0, 1);
    assert_true(isnan(read_at(&world, 20, 6)));
    for (int i = 0; i < 3; i++) /* drops on dry ground */
        fake_add(&world.sim, sb_vec(20 + 0.8 * i, 6, 0.5), sb_vec(0, 0, 0), 0);
    assert_true(isnan(read_at(&world, 20, 6)));
    fake_world_free(&world);
}

/* A layer that keeps only every third particle has no surface, but a third of a spacing of water. */
static void water_too_thin_for_a_surface_is_measured(void **state)
{
    (void)state;
    fake_world world;
    sb_error error = {0};
    double eta = 0, water = 0;
    fake_world_make(&world, 2, 0.5, sb_vec(0, 0, 0), sb_vec(40, 0, 20));
    for (int k = 0; k < 24; k++) fake_add(&world.sim, sb_vec(0.25 + 1.5 * k, 0, 0.25), sb_vec(0, 0, 0), 0);
    sb_measure_view view = fake_view(&world);
    for (double x = 8; x < 24; x += 0.37) {
        assert_int_equal(sb_gauge_read(&view, x, 0, &(sb_floors){0}, &eta, &water, &error), SB_OK);
        assert_true(isnan(eta));
        assert_true(fabs(water - 0.5 / 3) < 0.02);
    }
    fake_world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_level_is_exact_on_a_lattice),
        cmocka_unit_test(still_level_is_unbiased_with_jitter),
        cmocka_unit_test(thin_layers_keep_their_level),
        cmocka_unit_test(water_too_thin_for_a_surface_is_measured),
        cmocka_unit_test(walls_do_not_change_the_level),
        cmocka_unit_test(slope_is_followed),
        cmocka_unit_test(spray_does_not_count),
        cmocka_unit_test(stretched_water_is_one_body),
        cmocka_unit_test(dry_is_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

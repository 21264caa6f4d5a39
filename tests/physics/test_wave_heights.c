/* Heights and periods by zero crossings, of series whose waves are known. */
#include "../check.h"
#include "physics/records/wave_heights.h"

#include <math.h>
#include <stdio.h>

enum { MOST = 40000 };
static double t[MOST], z[MOST];

static sb_wave_heights heights_of(size_t n)
{
    sb_wave_heights heights;
    sb_error error = {0};
    if (sb_wave_heights_of(t, z, n, &heights, &error) != SB_OK) fail_msg("%s", error.text);
    return heights;
}

static void regular_waves_have_their_height_and_period(void **state)
{
    (void)state;
    const double step = 0.01, period = 2.3;
    for (size_t i = 0; i < 5000; i++) {
        t[i] = 7 + step * (double)i;
        z[i] = 1.5 + 0.1 * cos(2 * M_PI * t[i] / period) + 0.02 * cos(4 * M_PI * t[i] / period);
    }
    const sb_wave_heights h = heights_of(5000);
    assert_true(h.count == 20 || h.count == 21); /* 50 s */
    assert_near(h.mean, 0.2, 2e-4);
    assert_near(h.significant, 0.2, 2e-4);
    assert_near(h.highest, 0.2, 2e-4);
    assert_near(h.period, period, 1e-4);
    assert_near(h.level, 1.5, 4e-3);
    assert_near(h.spectral, 4 * sqrt(0.005 + 0.0002), 2e-3);
}

/* Scatter of a gauge that is read far more often than the waves need it: no wave ends at a crossing of the scatter. */
static void scatter_makes_no_waves(void **state)
{
    (void)state;
    uint32_t seed = 1;
    for (size_t i = 0; i < 8000; i++) {
        double scatter = -6;
        for (int k = 0; k < 12; k++) {
            seed = 1664525u * seed + 1013904223u;
            scatter += seed / 4294967296.0;
        }
        t[i] = 0.005 * (double)i;
        z[i] = 0.03 * cos(2 * M_PI * t[i] / 2) + 0.0006 * scatter;
    }
    const sb_wave_heights h = heights_of(8000);
    printf("%zu waves, mean height %.4f m, period %.4f s\n", h.count, h.mean, h.period);
    assert_int_equal(h.count, 19);
    assert_near(h.mean, 0.06, 0.004);
    assert_near(h.period, 2, 0.003);
}

/* Waves of heights 1, 2, ..., 9, one after the other: the mean is 5, that of the highest three is 8. */
static void the_highest_third_is_significant(void **state)
{
    (void)state;
    size_t n = 0;
    for (int wave = 0; wave < 11; wave++)
        for (int i = 0; i < 100; i++, n++) {
            const double height = wave == 0 || wave == 10 ? 0.5 : wave;
            t[n] = 0.01 * (double)n;
            z[n] = 0.5 * height * sin(2 * M_PI * (i + 0.5) / 100);
        }
    const sb_wave_heights h = heights_of(n);
    assert_true(h.count == 9 || h.count == 10);
    assert_near(h.highest, 9, 0.01);
    const double third = h.count == 9 ? 8 : 7.5;
    assert_near(h.significant, third, 0.01);
    assert_near(h.period, 1, 1e-3);
}

/* Many linear waves of a narrow band: the significant height is four standard deviations within some per cent. */
static void narrow_bands_follow_rayleigh(void **state)
{
    (void)state;
    for (size_t i = 0; i < MOST; i++) {
        t[i] = 0.05 * (double)i;
        z[i] = 0;
        for (int k = 0; k < 40; k++)
            z[i] += 0.01 * cos(2 * M_PI * (0.9 + 0.005 * k + 0.0013 * ((k * 7) % 3)) * t[i] / 1.5 + 2.3 * k * k);
    }
    const sb_wave_heights h = heights_of(MOST);
    assert_near(h.significant, h.spectral, 0.06 * h.spectral);
    assert_true(h.mean < 0.68 * h.significant && h.mean > 0.58 * h.significant);
}

/* Still water before the waves moves by a thousandth of their height, and crosses its level all the time: it has no
   waves. Of four waves one is the highest third, of five two. */
static void noise_has_no_waves(void **state)
{
    (void)state;
    for (int waves = 4; waves <= 5; waves++) {
        size_t n = 0;
        for (int i = 0; i < 1000; i++, n++) {
            t[n] = 0.01 * (double)n;
            z[n] = 1e-3 * sin(2 * M_PI * (i + 0.5) / 40);
        }
        for (int wave = 0; wave <= waves; wave++)
            for (int i = 0; i < 200; i++, n++) {
                const double height = wave == waves ? 1 : wave + 1; /* the last one has no end */
                t[n] = 0.01 * (double)n;
                z[n] = 0.5 * height * sin(2 * M_PI * (i + 0.5) / 200);
            }
        const sb_wave_heights h = heights_of(n);
        assert_int_equal(h.count, waves);
        assert_near(h.period, 2, 0.02);
        assert_near(h.highest, waves, 0.02);
        assert_near(h.significant, waves == 4 ? 4 : 4.5, 0.02);
    }
}

static void short_series_have_no_waves(void **state)
{
    (void)state;
    t[0] = 0;
    z[0] = 2;
    assert_int_equal(heights_of(0).count, 0);
    assert_true(isnan(heights_of(0).level));
    assert_int_equal(heights_of(1).count, 0);
    assert_true(heights_of(1).level == 2 && isnan(heights_of(1).mean));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regular_waves_have_their_height_and_period),
        cmocka_unit_test(the_highest_third_is_significant),
        cmocka_unit_test(scatter_makes_no_waves),
        cmocka_unit_test(narrow_bands_follow_rayleigh),
        cmocka_unit_test(noise_has_no_waves),
        cmocka_unit_test(short_series_have_no_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* waves.csv: the harmonics that the rows of a gauge distinguish, and no others; gauges that fall dry. */
#include "../check.h"
#include "base/memory.h"
#include "output/tables/wave_table.h"

#include <stdio.h>

static const double INTERVAL = 0.1;

/* Waves of `period` s with a third harmonic at one gauge; another is dry for two thirds of the time. */
static void write_gauges(double period)
{
    FILE *file = fopen(SB_BINARY_DIR "/gauges.csv", "w");
    assert_non_null(file);
    fputs("time_s,gauge,eta_m,z_m\n", file);
    for (int i = 0; i < 90; i++) {
        const double t = i * INTERVAL, w = 2 * M_PI / period;
        const double z = 0.1 * cos(w * t - 0.3) + 0.02 * cos(3 * w * t - 1);
        fprintf(file, "%.9g,sea,%.9g,%.9g\n", t, z, 1 + z);
        if (i % 3)
            fprintf(file, "%.9g,shore,,\n", t);
        else
            fprintf(file, "%.9g,shore,%.9g,%.9g\n", t, z, 1 + z);
    }
    assert_int_equal(fclose(file), 0);
}

static void harmonics_are_those_of_the_rows(void **state)
{
    (void)state;
    /* Period over the interval; harmonics that have more than two rows, and of these those that are distinguished. */
    static const struct {
        double rows;
        int most, found;
    } cases[] = {{23, 5, 5}, {11, 5, 5}, {10.000001, 5, 4}, {10, 4, 4}, {9.99, 4, 4}, {8, 3, 3}, {2, 0, 0}};
    sb_gauge gauges[] = {{.name = "sea"}, {.name = "shore"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double period = cases[k].rows * INTERVAL;
        sb_scene scene = {.measure = {.interval = INTERVAL, .gauges = gauges, .gauge_count = 2}};
        scene.measure.waves = (sb_wave_settings){.present = true, .start = 1, .period = period};
        sb_gauge_waves *waves = NULL;
        sb_error error = {0};
        write_gauges(period);
        assert_int_equal(sb_wave_table_harmonics(&scene), cases[k].most);
        if (sb_wave_table_write(SB_BINARY_DIR, &scene, &waves, &error) != SB_OK) fail_msg("%s", error.text);
        for (int h = 0; h < SB_WAVE_HARMONICS; h++) {
            const double value = waves[0].harmonic[h], right = h == 0 ? 0.1 : h == 2 ? 0.02 : 0;
            if (h < cases[k].found)
                assert_near(value, right, 1e-6);
            else if (!isnan(value))
                fail_msg("%g rows per period: harmonic %d has %g m", cases[k].rows, h + 1, value);
        }
        assert_true(waves[0].rows == 80 && waves[0].dry == 0);
        assert_true(waves[1].rows == 26 && waves[1].dry == 54);
        sb_free(waves);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(harmonics_are_those_of_the_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

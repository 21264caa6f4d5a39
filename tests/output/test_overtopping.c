/* Mean rates of overtopping from the table of a run: per metre of the plane, from a time on, beside the formula. */
#include "../check.h"
#include "base/memory.h"
#include "output/tables/overtopping_rate.h"
#include "physics/records/eurotop.h"

#include <stdio.h>

static void rates_are_means_per_metre(void **state)
{
    (void)state;
    FILE *file = fopen(SB_BINARY_DIR "/overtopping.csv", "w");
    assert_non_null(file);
    fputs("time_s,plane,volume_m3,flux_m3_s\n0,crest,0,0\n0,sea,0,0\n1,crest,0.5,0.5\n1,sea,7,7\n2,crest,1.5,1\n2,sea,"
          "8,1\n"
          "4,crest,6.5,2.5\n4,sea,9,0.5\n",
          file);
    assert_int_equal(fclose(file), 0);
    sb_flow_plane planes[] = {
        {.name = "sea", .bx = 1},
        {.name = "crest", .bx = 3, .by = 4, .eurotop = {.height = 0.4, .crest = 1.3, .start = 1}},
        {.name = "late", .bx = 1, .eurotop = {.height = 0.4, .crest = 1.3, .slope = 0.5, .period = 2, .start = 9}},
    };
    sb_scene scene = {.fluid.gravity = 9.81, .sea = {.present = true, .level = 1}};
    scene.measure.plane_count = 1;
    scene.measure.planes = planes;
    assert_false(sb_overtopping_wanted(&scene));
    scene.measure.plane_count = 3;
    assert_true(sb_overtopping_wanted(&scene));
    sb_overtopping_rate *rates;
    sb_error error = {0};
    if (sb_overtopping_write(SB_BINARY_DIR, &scene, &rates, &error) != SB_OK) fail_msg("%s", error.text);
    assert_true(isnan(rates[0].rate) && isnan(rates[0].formula));
    /* From 1 to 4 s, 6 m^3 over 5 m. */
    assert_near(rates[1].from, 1, 1e-12);
    assert_near(rates[1].to, 4, 1e-12);
    assert_near(rates[1].rate, 6.0 / 3 / 5, 1e-12);
    assert_near(rates[1].freeboard, 0.3, 1e-12);
    assert_near(rates[1].formula, sb_eurotop_vertical(0.4, 0.3, 9.81), 1e-15);
    assert_true(isnan(rates[2].rate));
    assert_near(rates[2].formula, sb_eurotop_slope(0.4, 0.3, 0.5, 2, 9.81), 1e-15);
    sb_free(rates);
    char line[200], expected[200];
    file = fopen(SB_BINARY_DIR "/eurotop.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "plane,from_s,to_s,rate_m2_s,eurotop_m2_s,freeboard_m,height_m\n");
    assert_non_null(fgets(line, sizeof line, file));
    snprintf(expected, sizeof expected, "crest,1,4,0.4,%.9g,0.3,0.4\n", sb_eurotop_vertical(0.4, 0.3, 9.81));
    assert_string_equal(line, expected);
    assert_non_null(fgets(line, sizeof line, file));
    snprintf(expected, sizeof expected, "late,,,,%.9g,0.3,0.4\n", sb_eurotop_slope(0.4, 0.3, 0.5, 2, 9.81));
    assert_string_equal(line, expected);
    assert_null(fgets(line, sizeof line, file));
    assert_int_equal(fclose(file), 0);
    assert_int_equal(remove(SB_BINARY_DIR "/overtopping.csv"), 0);
    assert_int_not_equal(sb_overtopping_write(SB_BINARY_DIR, &scene, &rates, &error), SB_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rates_are_means_per_metre)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

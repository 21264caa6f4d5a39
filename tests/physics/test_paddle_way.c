/* How far paddles move and how fast, against fine samples of the whole motion. */
#include "../check.h"
#include "physics/wavemakers/paddle_way.h"

#include <stdio.h>

#define FILE_NAME SB_BINARY_DIR "/paddle-way.txt"

static sb_wavemaker_parameters parameters_of(const char *kind)
{
    return (sb_wavemaker_parameters){.kind = sb_wavemaker_find(kind),
                                     .height = 0.06,
                                     .depth = 1,
                                     .stroke = 0.5,
                                     .speed = 0.3,
                                     .gravity = 9.81,
                                     .file = FILE_NAME,
                                     .period = 1.2,
                                     .ramp = -1,
                                     .lasts = (double)INFINITY,
                                     .gamma = 3.3,
                                     .components = 60,
                                     .seed = 4,
                                     .distance = 6,
                                     .focus = 20};
}

static void write_text(const char *text)
{
    FILE *file = fopen(FILE_NAME, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* A twentieth of a period of the shortest waves at steps that no period divides. */
static sb_paddle_way sampled(const sb_paddle *paddle, double end)
{
    const double step = 0.00773;
    sb_paddle_way way = {0};
    double before = 0;
    for (double t = paddle->start + step; t < end + step; t += step) {
        const double x = sb_paddle_displacement(paddle, fmin(t, end));
        way.least = fmin(way.least, x);
        way.most = fmax(way.most, x);
        way.fastest = fmax(way.fastest, fabs(x - before) / step);
        before = x;
    }
    return way;
}

static void expect_way(const sb_wavemaker_parameters *law, double end, double tolerance)
{
    sb_error error = {0};
    sb_paddle paddle;
    if (sb_paddle_create(law, &paddle, &error) != SB_OK) fail_msg("%s", error.text);
    const sb_paddle_way way = sb_paddle_way_until(&paddle, end), expected = sampled(&paddle, end);
    const double share = tolerance * (expected.most - expected.least);
    assert_near(way.least, expected.least, share);
    assert_near(way.most, expected.most, share);
    assert_near(way.fastest, expected.fastest, 0.05 * expected.fastest);
    sb_paddle_destroy(&paddle);
}

/* A thousand periods, which a coarse sample meets at the same phase each time; cnoidal and flap as well. */
static void regular_waves_move_by_their_stroke(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("regular");
    expect_way(&p, 1200, 0.01);
    p.motion = SB_PADDLE_FLAP;
    expect_way(&p, 1200, 0.01);
    p.motion = SB_PADDLE_PISTON;
    p.depth = 0.25;
    p.period = 2;
    expect_way(&p, 600, 0.01);
}

/* Two waves that are opposite at the start meet after eleven periods. */
static void two_waves_beat(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("components");
    write_text("0.05 2 0\n0.05 2.2 180\n");
    expect_way(&p, 60, 0.02);
}

static void irregular_waves_come_near_their_extremes(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("irregular");
    expect_way(&p, 700, 0.05);
}

/* Without a ramp the motion is to one side. */
static void motion_without_a_ramp_is_one_sided(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("components");
    write_text("0.05 2 90\n");
    p.ramp = 0;
    expect_way(&p, 60, 0.01);
    sb_paddle paddle;
    assert_int_equal(sb_paddle_create(&p, &paddle, NULL), SB_OK);
    const sb_paddle_way way = sb_paddle_way_until(&paddle, 60);
    assert_true(way.most < 0.01 * -way.least);
    sb_paddle_destroy(&paddle);
}

/* A group that comes late in the run counts, and in a short run what comes within a hundred periods. */
static void late_waves_count(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("focused");
    sb_paddle paddle;
    p.focus = 200;
    expect_way(&p, 250, 0.05);
    assert_int_equal(sb_paddle_create(&p, &paddle, NULL), SB_OK);
    const sb_paddle_way early = sb_paddle_way_of(&paddle, 1), all = sb_paddle_way_of(&paddle, 250);
    const sb_paddle_way own = sb_paddle_way_until(&paddle, 120);
    assert_near(early.most, own.most, 1e-12);
    assert_true(all.most > 1.2 * early.most);
    sb_paddle_destroy(&paddle);
}

/* A stroke, and its return; a run that ends before. */
static void strokes_have_their_length(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("stroke");
    p.start = 3;
    p.after = SB_AFTER_RETURN;
    p.return_time = 4;
    expect_way(&p, 40, 0.01);
    expect_way(&p, 3.5, 0.01);
    sb_paddle paddle;
    assert_int_equal(sb_paddle_create(&p, &paddle, NULL), SB_OK);
    const sb_paddle_way none = sb_paddle_way_until(&paddle, 2), all = sb_paddle_way_of(&paddle, 40);
    assert_true(none.least == 0 && none.most == 0 && none.fastest == 0);
    assert_near(all.most, 0.5, 1e-3);
    sb_paddle_destroy(&paddle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regular_waves_move_by_their_stroke),
        cmocka_unit_test(two_waves_beat),
        cmocka_unit_test(irregular_waves_come_near_their_extremes),
        cmocka_unit_test(motion_without_a_ramp_is_one_sided),
        cmocka_unit_test(late_waves_count),
        cmocka_unit_test(strokes_have_their_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

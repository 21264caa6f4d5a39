/* The upper end of the colours of speed: that of the scene's waves where nothing else moves. */
#include "../../check.h"
#include "small_model.h"

#include <math.h>

static double scale(void)
{
    return sb_model_speed_scale(&scene, &model);
}

static void waves_set_the_scale(void **state)
{
    (void)state;
    build();
    const double fastest = 2 * sqrt(9.81 * 3);
    assert_near(scale(), fastest, 1e-12);
    /* Three times the amplitude times g k / omega. */
    scene.wave = (sb_initial_wave){.kind = SB_INITIAL_REGULAR, .height = 0.2, .depth = 3, .wavelength = 20};
    const double k = 2 * M_PI / 20, omega = sqrt(9.81 * k * tanh(3 * k));
    assert_near(scale(), 3 * 0.1 * 9.81 * k / omega, 1e-12);
    scene.wave.height = 4;
    assert_near(scale(), fastest, 1e-12);
    scene.wave.height = 0.2;
    scene.render.speed_max = 7;
    assert_near(scale(), 7, 0);
    scene.render.speed_max = 0;
    scene.box_count = 1; /* a dam may break */
    assert_near(scale(), fastest, 1e-12);
    scene.box_count = 0;
    scene.wavemaker_count = 1; /* and a stroke may make a bore */
    assert_near(scale(), fastest, 1e-12);
    scene.wavemaker_count = 0;
    scene.given.source = SB_GIVEN_TABLE;
    assert_near(scale(), fastest, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(waves_set_the_scale, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

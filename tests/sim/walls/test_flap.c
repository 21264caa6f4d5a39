/* Flaps: the rows of a flap move in proportion to their height above the hinge, its waves have the height of linear
   theory, and force and moment of still water on it are those of hydrostatics. */
#include "../../check.h"
#include "sim/tank.h"
#include "sim/walls/absorber.h"

#include <complex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Waves of kd = 1, 10 particles per depth, and a sponge one wavelength long. */
static const char text[] = "dimensions: 2\nresolution: 0.1\nduration: 60\n"
                           "domain: {min: [-1, 0], max: [12.4, 1.8]}\n"
                           "water: {level: %s, seed: [2, 0.5]}\n"
                           "bodies:\n  - {name: paddle, shape: box, min: [-0.6, 0], max: [0, 1.6]}\n"
                           "wavemakers:\n"
                           "  - {name: waves, body: paddle, kind: regular, theory: linear, height: 0.12, depth: 1,"
                           " period: 2.2985, ramp: 2.3%s}\n"
                           "sponges:\n  - {name: beach, side: x_max, length: 6.3, period: 2.2985, depth: 1}\n";

enum { SEEDS = 3 };

typedef struct flume {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
} flume;

/* A wave of `height` m, `spacing` m between particles. */
typedef struct fineness {
    const char *spacing, *height;
} fineness;

static const fineness COARSE = {"0.1", "0.12"}, FINE = {"0.05", "0.06"};

static sb_status read_scene(const char *more, const fineness *of, sb_scene *scene, sb_error *error)
{
    const sb_override set[] = {{"resolution", of->spacing}, {"wavemakers[0].height", of->height}};
    const char *path = SB_BINARY_DIR "/flap.yaml";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, text, "1.0", more);
    assert_int_equal(fclose(file), 0);
    return sb_scene_read(path, NULL, set, 2, scene, error);
}

static void make(flume *f, const char *more, const fineness *of, unsigned seed)
{
    sb_error error = {0};
    *f = (flume){0};
    if (read_scene(more, of, &f->scene, &error) != SB_OK) fail_msg("%s", error.text);
    f->scene.numerics.seed = seed;
    if (sb_model_build(&f->scene, &f->model, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_create(&f->scene, &f->model, NULL, &f->sim, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_settle(f->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

static void free_flume(flume *f)
{
    sb_sim_destroy(f->sim);
    sb_model_free(&f->model);
    sb_scene_free(&f->scene);
}

/* Depth at x, from the volume of the particles there. */
static double depth_at(const sb_sim *sim, double x)
{
    double sum = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        sum += sb_column_weight((sb_space_position(&sim->space, sim->state.position[i]).x - x) / 0.15);
    return sum / 0.15 * (double)sim->constant.mass / (double)sim->constant.rest_density;
}

/* Height of the first harmonic 2.5 m ahead, over two periods. The column of 0.6 m takes 0.2 % off it. */
static double height_of_waves(flume *f, double *imbalance)
{
    const double period = 2.2985, from = 4 * period, omega = 2 * M_PI / period;
    double complex sum = 0;
    double weight = 0, last = 0;
    while (sb_sim_report(f->sim)->time < from + 2 * period) {
        assert_int_equal(tank_steps(f->sim, 1), 0);
        const double time = sb_sim_report(f->sim)->time;
        *imbalance = fmax(*imbalance, sb_sim_report(f->sim)->momentum_imbalance);
        if (time > from) {
            sum += (time - last) * (depth_at(f->sim, 2.5) - 1) * cexp(CMPLX(0, omega * time));
            weight += time - last;
        }
        last = time;
    }
    return 4 * cabs(sum) / weight;
}

/* Over that of linear theory. */
static double relative_height(bool flap, const fineness *of, unsigned seed)
{
    flume f;
    double imbalance = 0;
    make(&f, flap ? ", motion: flap" : "", of, seed);
    const double height = height_of_waves(&f, &imbalance) / strtod(of->height, NULL);
    printf("%s, spacing %s m, seed %u: %.3f of the height of linear theory; momentum %.2g; lost %llu\n",
           flap ? "flap" : "piston", of->spacing, seed, height, imbalance,
           (unsigned long long)sb_sim_report(f.sim)->lost);
    assert_true(imbalance < 1e-5 && sb_sim_report(f.sim)->lost == 0);
    free_flume(&f);
    return height;
}

/* At 10 particles per depth a flap's waves are 4 % too high, and single runs are off by up to 3 %. */
static void waves_have_the_height_of_theory(void **state)
{
    (void)state;
    for (int flap = 0; flap <= 1; flap++)
        for (unsigned seed = 1; seed <= SEEDS; seed++)
            assert_true(fabs(relative_height(flap, &COARSE, seed) - 1) < 0.06);
}

static void flaps_make_the_waves_of_pistons(void **state)
{
    (void)state;
    assert_true(fabs(relative_height(true, &FINE, 1) - relative_height(false, &FINE, 1)) < 0.03);
}

static void rows_follow_the_hinge(void **state)
{
    (void)state;
    flume f;
    make(&f, ", motion: flap", &COARSE, 1);
    assert_int_equal(f.model.bodies[0].plates, 8);
    assert_true(f.model.bodies[0].report && !f.model.bodies[1].report);
    /* Still water: 1000 g/2 N, acting a third of the depth above the bed. */
    assert_int_equal(tank_steps(f.sim, 1), 0);
    const sb_body_impulse *impulse = sb_sim_impulse(f.sim, 0);
    const double force = -impulse->pressure.x / sb_sim_report(f.sim)->time, still = 0.5 * 9810;
    const double arm = impulse->moment.y / impulse->pressure.x;
    printf("force %.4g N of %.4g N, %.4g m above the bed\n", force, still, arm);
    assert_true(fabs(force - still) < 0.03 * still);
    assert_true(fabs(arm - 1.0 / 3) < 0.02);
    while (sb_sim_report(f.sim)->time < 2.9) assert_int_equal(tank_steps(f.sim, 1), 0);
    const double lowest = sb_sim_body_displacement(f.sim, 0).x;
    assert_true(fabs(lowest) > 1e-3);
    for (size_t k = 0; k < 8; k++)
        assert_near(sb_sim_body_displacement(f.sim, k).x, lowest * (2 * (double)k + 1), 1e-12);
    free_flume(&f);
}

static void unfit_flaps_are_refused(void **state)
{
    (void)state;
    const struct {
        const char *more, *expected;
    } cases[] = {
        {", motion: flap, absorb: true", "does not absorb"},
        {", motion: flap, direction: [0, 1]", "not horizontal"},
        {", motion: wedge", "piston or flap"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sb_scene scene;
        sb_error error = {0};
        assert_int_equal(read_scene(cases[k].more, &COARSE, &scene, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[k].expected)) fail_msg("%s: %s", cases[k].more, error.text);
    }
}

/* 1.6 m at 4 mm would be 200 rows of two spacings. */
static void fine_flaps_have_a_hundred_rows(void **state)
{
    (void)state;
    static const fineness finest = {"0.004", "0.05"};
    sb_scene scene;
    sb_plate_row row;
    sb_error error = {0};
    if (read_scene(", motion: flap", &finest, &scene, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(sb_scene_plates(&scene, &scene.wavemakers[0], &row), 100);
    assert_near(row.to - row.from, 1.6, 1e-12);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unfit_flaps_are_refused),         cmocka_unit_test(fine_flaps_have_a_hundred_rows),
        cmocka_unit_test(rows_follow_the_hinge),           cmocka_unit_test(waves_have_the_height_of_theory),
        cmocka_unit_test(flaps_make_the_waves_of_pistons),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

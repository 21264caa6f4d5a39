/* Waves on the water at the start travel through a periodic tank at the speed of their theory and keep their height;
   a sum of waves has the surface and the velocities of its parts; waves that do not fit are refused. */
#include "../../check.h"
#include "sim/tank.h"

#include <complex.h>
#include <stdio.h>
#include <string.h>

/* One wavelength of kd = 1. */
static const char text[] = "dimensions: 2\nresolution: %g\nduration: 30\n"
                           "domain: {min: [0, 0], max: [6.283185307179586, 1.6], sides: {x_min: periodic, x_max: "
                           "periodic}}\n"
                           "water:\n  level: 1.0\n  seed: [2, 0.5]\n  wave: {depth: 1, position: 1, %s}\n";

typedef struct tank2 {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
} tank2;

static sb_status read_scene(double spacing, const char *wave, sb_scene *scene, sb_error *error)
{
    const char *path = SB_BINARY_DIR "/initial_waves.yaml";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, text, spacing, wave);
    assert_int_equal(fclose(file), 0);
    return sb_scene_read(path, NULL, NULL, 0, scene, error);
}

static void make(tank2 *t, double spacing, const char *wave, bool jitter)
{
    sb_error error = {0};
    *t = (tank2){0};
    if (read_scene(spacing, wave, &t->scene, &error) != SB_OK) fail_msg("%s", error.text);
    if (!jitter) t->scene.numerics.jitter = 0;
    if (sb_model_build(&t->scene, &t->model, &error) != SB_OK) fail_msg("%s", error.text);
}

static void free_tank(tank2 *t)
{
    sb_sim_destroy(t->sim);
    sb_model_free(&t->model);
    sb_scene_free(&t->scene);
}

/* First harmonic of the depth along x, from the volume of the particles: a exp(-i k x) of a wave with a crest at x. */
static double complex harmonic(const sb_sim *sim)
{
    double complex sum = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        sum += cexp(CMPLX(0, -sb_space_position(&sim->space, sim->state.position[i]).x));
    return sum * 2 * (double)sim->constant.mass / (double)sim->constant.rest_density / (2 * M_PI);
}

/* Follows the harmonic over the periods of the theory. *rate: of its phase, by least squares; *kept: mean amplitude in
   the last period over that in the first. */
static void follow(tank2 *t, int periods, double *rate, double *kept)
{
    const double period = t->scene.wave.stokes.length / t->scene.wave.stokes.celerity;
    double last = carg(harmonic(t->sim)), sums[5] = {0}, amplitude[2] = {0};
    int counts[2] = {0};
    for (double time = 0; time < periods * period;) {
        assert_int_equal(tank_steps(t->sim, 1), 0);
        time = sb_sim_report(t->sim)->time;
        const double complex a = harmonic(t->sim);
        last += remainder(carg(a) - last, 2 * M_PI);
        const double terms[] = {1, time, last, time * time, time * last};
        for (int k = 0; k < 5; k++) sums[k] += terms[k];
        for (int end = 0; end < 2; end++)
            if (end ? time > (periods - 1) * period : time < period) {
                amplitude[end] += cabs(a);
                counts[end]++;
            }
    }
    *rate = (sums[0] * sums[4] - sums[1] * sums[2]) / (sums[0] * sums[3] - sums[1] * sums[1]);
    *kept = amplitude[1] / counts[1] / (amplitude[0] / counts[0]);
}

/* Towards +x and -x, 20 and 16 particles per depth. */
static void regular_waves_travel(void **state)
{
    (void)state;
    const struct {
        double spacing;
        const char *wave;
        double speed, kept;
    } cases[] = {
        {0.05, "kind: regular, height: 0.19, wavelength: 6.283185307179586", 0.007, 0.93},
        {0.0625, "kind: regular, height: 0.19, wavelength: 6.283185307179586, direction: -1", 0.007, 0.9},
    };
    for (int k = 0; k < 2; k++) {
        tank2 t;
        sb_error error = {0};
        double rate, kept;
        make(&t, cases[k].spacing, cases[k].wave, true);
        if (sb_sim_create(&t.scene, &t.model, NULL, &t.sim, &error) != SB_OK) fail_msg("%s", error.text);
        if (sb_sim_settle(t.sim, &error) != SB_OK) fail_msg("%s", error.text);
        const double theory = t.scene.wave.stokes.surface[0], made = cabs(harmonic(t.sim));
        follow(&t, 3, &rate, &kept);
        const double speed = (k == 0 ? -rate : rate) / t.scene.wave.stokes.celerity;
        printf(
            "spacing %g m: first harmonic %.4g m of %.4g m, speed %.4f of the theory's, %.3f of the height kept from "
            "the first to the third period\n",
            cases[k].spacing, made, theory, speed, kept);
        assert_true(fabs(made - theory) < 0.02 * theory);
        assert_true(fabs(speed - 1) < cases[k].speed);
        assert_true(kept > cases[k].kept && kept < 1.02);
        free_tank(&t);
    }
}

/* The water of a model has the surface and the velocities of a sum, computed here. */
static void sums_have_their_parts(void **state)
{
    (void)state;
    tank2 t;
    make(&t, 0.05,
         "kind: components, components: [{amplitude: 0.05, wavelength: 6.283185307179586}, {amplitude: 0.03, "
         "wavelength: "
         "3.141592653589793, phase: 90, direction: -1}]",
         false);
    const double omega[] = {sqrt(9.81 * tanh(1)), sqrt(9.81 * 2 * tanh(2))};
    double top[7] = {0}, worst = 0;
    for (size_t i = 0; i < t.model.fluid_count; i++) {
        const sb_vec3 at = t.model.fluid_position[i], v = t.model.fluid_velocity[i];
        const double one = at.x - 1, two = -2 * (at.x - 1) + 0.5 * M_PI, z = fmin(at.z, 1);
        const double u =
            0.05 * omega[0] * cosh(z) / sinh(1) * cos(one) - 0.03 * omega[1] * cosh(2 * z) / sinh(2) * cos(two);
        const double w =
            0.05 * omega[0] * sinh(z) / sinh(1) * sin(one) + 0.03 * omega[1] * sinh(2 * z) / sinh(2) * sin(two);
        worst = fmax(worst, hypot(v.x - u, v.z - w));
        if (fabs(at.x - round(at.x)) < 0.03) top[(int)round(at.x)] = fmax(top[(int)round(at.x)], at.z);
    }
    assert_true(worst < 1e-12);
    for (int x = 1; x <= 6; x++) {
        const double eta = 0.05 * cos(x - 1) + 0.03 * cos(-2.0 * (x - 1) + 0.5 * M_PI);
        assert_true(fabs(top[x] + 0.025 - 1 - eta) < 0.02);
    }
    free_tank(&t);
}

static void unfit_waves_are_refused(void **state)
{
    (void)state;
    const struct {
        const char *wave, *expected;
    } cases[] = {
        {"kind: regular, height: 0.1, wavelength: 5", "a whole number of times, expected for example 6.283185307"},
        {"kind: regular, height: 0.1, wavelength: 2.2", "expected for example 2.094395102"},
        {"kind: regular, height: 0.9, wavelength: 6.283185307179586", "breaks"},
        {"kind: regular, height: 0.1, wavelength: 6.283185307179586, direction: 0", "expected 1 or -1"},
        {"kind: components", "components"},
        {"kind: components, components: []", "at least one"},
        {"kind: components, components: [{amplitude: 0.1, wavelength: 4}]", "a whole number of times"},
        {"kind: components, components: [{amplitude: 0.1, wavelength: 6.283185307179586}, {amplitude: 0.5, wavelength: "
         "6.283185307179586}]",
         "components: item 1 with an amplitude of 0.5 m and a wavelength of 6.28319 m on 1 m breaks, expected an "
         "amplitude of at most 0.315 m"},
        {"kind: components, components: [{amplitude: 0.3, wavelength: 6.283185307179586}, {amplitude: 0.1, wavelength: "
         "3.141592653589793}]",
         "components: the waves together have a significant height of 0.8 m and break: the highest is 6.28 m long on 1 "
         "m, expected a significant height of at most 0.63 m"},
        {"kind: standing, height: 0.1, wavelength: 4, order: linear", "does not apply"},
        {"kind: standing, height: 0.1, wavelength: 4", "a whole number of times, expected for example 3.141592654"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sb_scene scene;
        sb_error error = {0};
        assert_int_equal(read_scene(0.1, cases[k].wave, &scene, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[k].expected)) fail_msg("%s: %s", cases[k].wave, error.text);
    }
}

/* One component may be as high as a regular wave; two that meet may be as high each. */
static void waves_that_do_not_break_are_accepted(void **state)
{
    (void)state;
    static const char *const waves[] = {
        "kind: components, components: [{amplitude: 0.315, wavelength: 6.283185307179586}]",
        "kind: components, components: [{amplitude: 0.3, wavelength: 6.283185307179586}, {amplitude: 0.3, wavelength: "
        "6.283185307179586, direction: -1}]",
    };
    for (size_t k = 0; k < sizeof waves / sizeof *waves; k++) {
        sb_scene scene;
        sb_error error = {0};
        if (read_scene(0.1, waves[k], &scene, &error) != SB_OK) fail_msg("%s", error.text);
        sb_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_have_their_parts),
        cmocka_unit_test(unfit_waves_are_refused),
        cmocka_unit_test(waves_that_do_not_break_are_accepted),
        cmocka_unit_test(regular_waves_travel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

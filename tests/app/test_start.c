/* The state at t = 0 is that of the scene: settling must not change a dam, a wave or a velocity. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Absolute elevation at the first gauge and kinetic energy (J), at t = 0 with the preset's own settling. */
static void start_of(const char *scene, double *z, double *kinetic)
{
    write_text("start.yaml", scene);
    RUN_AND_FORGET(0, "run", "start.yaml", "--out", "s", "--overwrite", "--quiet", "--set", "output.plots=false");
    char *text = text_of("s/gauges.csv");
    const char *row = strstr(text, "\n0,g,");
    assert_non_null(row);
    const char *comma = strchr(row + 5, ',');
    assert_non_null(comma);
    *z = strtod(comma + 1, NULL);
    sb_free(text);
    *kinetic = json_number_of("s/summary.json", "kinetic_J"); /* the first value is energy_start */
}

static void a_dam_stands(void **state)
{
    (void)state;
    double z, kinetic;
    start_of("{dimensions: 2, resolution: 0.04, duration: 0.01,\n"
             " domain: {min: [0, 0], max: [3, 1]},\n"
             " water: {boxes: [{min: [0, 0], max: [0.8, 0.6]}]},\n"
             " measure: {interval: 0.01, gauges: [{name: g, x: 0.4}]}}\n",
             &z, &kinetic);
    assert_near(z, 0.6, 0.02);
}

static void a_wave_stands_and_moves(void **state)
{
    (void)state;
    double z, kinetic;
    start_of("{dimensions: 2, resolution: 0.05, duration: 0.01,\n"
             " domain: {min: [0, 0], max: [8, 1]},\n"
             " water: {level: 0.5, seed: [4, 0.2],\n"
             "         wave: {kind: solitary, height: 0.15, depth: 0.5, position: 4}},\n"
             " measure: {interval: 0.01, gauges: [{name: g, x: 4}]}}\n",
             &z, &kinetic);
    assert_near(z, 0.65, 0.025);
    assert_near(kinetic, 174, 20); /* the value without settling */
}

/* Kinetic energy (J) in the last row of energy.csv. */
static double last_kinetic(const char *scene)
{
    write_text("start.yaml", scene);
    RUN_AND_FORGET(0, "run", "start.yaml", "--out", "q", "--overwrite", "--quiet", "--set", "output.plots=false");
    char *text = text_of("q/energy.csv");
    size_t end = strlen(text) - 1;
    while (end > 0 && text[end - 1] != '\n') end--;
    const char *comma = strchr(text + end, ',');
    assert_non_null(comma);
    double kinetic = strtod(comma + 1, NULL);
    sb_free(text);
    return kinetic;
}

/* Linear theory: E sin^2(omega t) with E = rho g a^2 L/4 = 12.26 J/m and omega = 5.541 /s. Velocities belong to half a
   step before the row's time of 0.024 s, except in the water that starts as calm: theory has 0.165 and 0.2156 J/m at
   0.021 and 0.024 s. Six seeds give 0.1917 to 0.1924 J/m. Without settling, the rearrangement of the lattice would give
   249 J/m. */
static void a_wave_starts_quietly(void **state)
{
    (void)state;
    double kinetic = last_kinetic("{dimensions: 2, resolution: 0.05, duration: 0.024,\n"
                                  " domain: {min: [0, 0], max: [2, 1.5]},\n"
                                  " numerics: {time_step_max: 0.006},\n"
                                  " water: {level: 1, seed: [1, 0.5],\n"
                                  "         wave: {kind: standing, height: 0.05, depth: 1, wavelength: 2}},\n"
                                  " measure: {interval: 0.012}}\n");
    printf("kinetic energy of the wave: %.4f J/m\n", kinetic);
    assert_true(kinetic > 0.165 && kinetic < 0.2156);
}

/* Kinetic energy (J/m) of a dam of 0.8 m by 0.6 m at a time (s) shortly after its release. The water accelerates by
   -grad p/rho - g, where p is harmonic, zero at the surface (x = L, z = H), and lets no water through the floor or the
   wall at x = 0: p/rho = sum_n 2 g (-1)^n/(L k^2) cos(k x) sinh(k (H - z))/cosh(k H), k = (n + 1/2) pi/L. The mean
   square of the acceleration follows from Green's theorem. In the pressure, L and H are larger by `moved` (m). */
static double dam_kinetic(double time, double moved)
{
    const double length = 0.8 + moved, height = 0.6 + moved, g = 9.81;
    double held = 0; /* m^2: the part of the area by which pressure reduces the free fall */
    for (int n = 0; n < 100; n++) {
        const double k = (n + 0.5) * M_PI / length;
        held += 2 / length * tanh(k * height) / (k * k * k);
    }
    return 0.5 * 1000 * time * time * g * g * (0.8 * 0.6 - held);
}

/* Velocities belong to half a step before the row's time. In the lattice, the surface at which the pressure is zero is
   known to half a spacing only. Without settling, the velocities would be those of the row's time, 1.3 J/m; with the
   summed density, the rearrangement of the lattice would give 25 J/m. */
static void a_dam_starts_quietly(void **state)
{
    (void)state;
    const double spacing = 0.04, step = 0.006;
    double kinetic = last_kinetic("{dimensions: 2, resolution: 0.04, duration: 0.012,\n"
                                  " domain: {min: [0, 0], max: [3, 1]},\n"
                                  " numerics: {time_step_max: 0.006},\n"
                                  " water: {boxes: [{min: [0, 0], max: [0.8, 0.6]}]},\n"
                                  " measure: {interval: 0.012}}\n");
    const double least = dam_kinetic(2 * step - step / 2, spacing / 2);
    const double most = dam_kinetic(2 * step - step / 2, -spacing / 2);
    printf("kinetic energy of the dam: %.4f J/m, in theory %.4f to %.4f\n", kinetic, least, most);
    assert_true(kinetic > least && kinetic < most);
}

static void a_moving_box_moves(void **state)
{
    (void)state;
    double z, kinetic;
    start_of("{dimensions: 2, resolution: 0.04, duration: 0.01,\n"
             " domain: {min: [0, 0], max: [3, 1]},\n"
             " water: {boxes: [{min: [0, 0], max: [0.8, 0.2], velocity: [1, 0]}]},\n"
             " measure: {interval: 0.01, gauges: [{name: g, x: 0.4}]}}\n",
             &z, &kinetic);
    assert_near(kinetic, 80, 1); /* m v^2 / 2 of 160 kg per metre */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dam_stands),          cmocka_unit_test(a_wave_stands_and_moves),
        cmocka_unit_test(a_wave_starts_quietly), cmocka_unit_test(a_dam_starts_quietly),
        cmocka_unit_test(a_moving_box_moves),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}

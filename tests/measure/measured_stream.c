/* Pressures on the face of a box that a steady stream strikes and leaves at the upper edge, against potential flow.

   A stream of depth h and speed U on a floor meets a vertical face of height a and leaves its upper edge as a jet at
   the angle A to the floor. Without gravity the complex velocity (over U) lies in a quarter of the unit disk: the
   source upstream at 1, the sink of the jet on the circle, walls on both radii. By reflection of source and sink in the
   radii, the speed q on the face has the potential

       phi = (2 h/pi) [log(1 + q^2) - log(q^4 + 2 q^2 cos 2A + 1)/2],   dz = dphi/q,   p = rho U^2 (1 - q^2)/2.

   Momentum gives the force on the face, rho U^2 h (1 - cos A), which checks the formula. At the edge the pressure is 0.
 */
#include "geometry/model/model.h"
#include "measure/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* h = a = 0.4 m, ten spacings. Walls have no shear, because the theory has none: with it the water before the foot
   loses speed. Gravity adds less than 2 % of the pressure at the foot. */
#define SPACING 0.04
#define HEIGHT 0.4
#define SPEED 8.0
#define BEGIN 0.25 /* s: the first splash has gone */
#define END 0.5    /* s: water from the end of the stream has not come yet */

enum { PROBES = 10, PARTS = 20000 };

static const double PI = 3.14159265358979323846;
static const double STAGNATION = 0.5 * 1000 * SPEED * SPEED;

static void check_ok(sb_status status, const sb_error *error)
{
    if (status != SB_OK) fail_msg("%s", error->text);
}

/* ---- theory ---- */

/* dz/dq over h, with c = cos 2A. */
static double slope(double q, double c)
{
    const double q2 = q * q;
    return 2 / PI * (2 / (1 + q2) - (2 * q2 + 2 * c) / (q2 * q2 + 2 * q2 * c + 1));
}

static double height(double c)
{
    double sum = 0;
    for (int k = 0; k < PARTS; k++) sum += slope((k + 0.5) / PARTS, c) / PARTS;
    return sum;
}

/* cos 2A of a face as high as the stream is deep. */
static double find_angle(void)
{
    double low = -0.99, high = 1;
    for (int k = 0; k < 50; k++) {
        const double c = 0.5 * (low + high);
        *(height(c) > 1 ? &low : &high) = c;
    }
    return 0.5 * (low + high);
}

/* Mean pressures over stagnation pressure of ten parts of the face. */
static void solve(double pressure[PROBES])
{
    const double c = find_angle(), angle = 0.5 * acos(c);
    double z = 0, sum = 0;
    memset(pressure, 0, PROBES * sizeof *pressure);
    for (int k = 0; k < PARTS; k++) {
        const double q = (k + 0.5) / PARTS, dz = slope(q, c) / PARTS;
        const int part = (int)((z + 0.5 * dz) * PROBES);
        if (part < PROBES) pressure[part] += (1 - q * q) * dz * PROBES;
        z += dz;
    }
    for (int k = 0; k < PROBES; k++) sum += pressure[k] / PROBES;
    assert_true(fabs(0.5 * sum - (1 - cos(angle))) < 1e-3);
}

/* ---- simulation ---- */

static void read_scene(sb_scene *scene)
{
    char path[] = "/tmp/shorebreak-stream-XXXXXX", probes[1024] = "";
    sb_error error = {0};
    for (int k = 0; k < PROBES; k++)
        snprintf(probes + strlen(probes), sizeof probes - strlen(probes), "%s{name: p%d, at: [6.1, %g]}", k ? ", " : "",
                 k, (k + 0.5) * SPACING);
    int file = mkstemp(path);
    assert_true(file >= 0);
    assert_true(dprintf(file,
                        "dimensions: 2\nresolution: %g\nduration: %g\nfluid: {gravity: 1}\n"
                        "numerics: {wall_shear: none}\n"
                        "domain: {min: [0, 0], max: [12, 6], sides: {x_min: open, x_max: open}}\n"
                        "water: {boxes: [{min: [1, 0], max: [6, %g], velocity: [%g, 0]}]}\n"
                        "bodies: [{name: box, shape: box, min: [6.1, -0.2], max: [8.5, %g]}]\n"
                        "measure: {interval: 0.01, probes: [%s]}\n",
                        SPACING, END, HEIGHT, SPEED, HEIGHT, probes) > 0);
    close(file);
    sb_status status = sb_scene_read(path, NULL, NULL, 0, scene, &error);
    unlink(path);
    check_ok(status, &error);
}

/* Means from BEGIN to END. */
typedef struct means {
    double pressure[PROBES], force; /* Pa; N/m */
    int rows;
} means;

static void add_row(const sb_measure_records *row, means *m)
{
    if (row->force_count == 0 || row->forces[0].time < BEGIN) return;
    for (size_t i = 0; i < row->probe_count; i++)
        if (isfinite(row->probes[i].pressure)) m->pressure[row->probes[i].probe] += row->probes[i].pressure;
    for (size_t i = 0; i < row->force_count; i++) m->force += row->forces[i].body == 0 ? row->forces[i].pressure.x : 0;
    m->rows++;
}

static means run(void)
{
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_measure *measure = NULL;
    sb_error error = {0};
    means m = {0};
    read_scene(&scene);
    check_ok(sb_model_build(&scene, &model, &error), &error);
    check_ok(sb_sim_create(&scene, &model, NULL, &sim, &error), &error);
    check_ok(sb_sim_settle(sim, &error), &error);
    check_ok(sb_measure_create(&scene, &model, sim, &measure, &error), &error);
    while (sb_sim_report(sim)->time < END) {
        check_ok(sb_sim_step(sim, &error), &error);
        check_ok(sb_measure_step(measure, sim, &error), &error);
        add_row(sb_measure_latest(measure), &m);
    }
    for (int k = 0; k < PROBES; k++) m.pressure[k] /= m.rows;
    m.force /= m.rows;
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return m;
}

static void a_stream_presses_on_a_face_as_in_potential_flow(void **state)
{
    (void)state;
    double theory[PROBES], sum = 0;
    solve(theory);
    const means m = run();
    for (int k = 0; k < PROBES; k++) {
        const double read = m.pressure[k] / STAGNATION;
        print_message("%2d.5 spacings up: %.3f, theory %.3f\n", k, read, theory[k]);
        sum += m.pressure[k] * SPACING;
        /* Beside the edge the theory's pressure falls from 0.5 of that at the foot to 0 within a spacing. */
        assert_true(fabs(read - theory[k]) < (k < PROBES - 1 ? 0.08 : 0.2));
    }
    print_message("force %.0f N/m, sum of the probes %.0f\n", m.force, sum);
    assert_true(fabs(sum - m.force) < 0.03 * m.force);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_stream_presses_on_a_face_as_in_potential_flow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The pressures of probes all over a face sum to the force on the body, row by row, while a bore strikes and overtops
   it; and no probe that water stands at is blank. 2D; the spacing is 4 cm. */
#include "geometry/model/model.h"
#include "measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define SPACING 0.04

enum { PROBES = 10 };

static void check_ok(sb_status status, const sb_error *error)
{
    if (status != SB_OK) fail_msg("%s", error->text);
}

/* Ten probes up the face of a box of ten spacings. */
static void read_scene(const char *walls, sb_scene *scene)
{
    char path[] = "/tmp/shorebreak-edge-XXXXXX", probes[1024] = "";
    sb_error error = {0};
    for (int k = 0; k < PROBES; k++)
        snprintf(probes + strlen(probes), sizeof probes - strlen(probes), "%s{name: p%d, at: [2, %g]}", k ? ", " : "",
                 k, (k + 0.5) * SPACING);
    int file = mkstemp(path);
    assert_true(file >= 0);
    assert_true(dprintf(file,
                        "dimensions: 2\nresolution: %g\nduration: 0.7\nnumerics: {walls: %s}\n"
                        "domain: {min: [0, 0], max: [4, 3]}\n"
                        "water: {boxes: [{min: [0, 0], max: [1.6, 0.36], velocity: [3, 0]}]}\n"
                        "bodies: [{name: box, shape: box, min: [2, -0.2], max: [3.5, 0.4]}]\n"
                        "measure: {interval: 0.01, probes: [%s]}\n",
                        SPACING, walls, probes) > 0);
    close(file);
    sb_status status = sb_scene_read(path, NULL, NULL, 0, scene, &error);
    unlink(path);
    check_ok(status, &error);
}

/* Sums over all rows. */
typedef struct sums {
    double force, difference; /* N s/m: of the body; |body - probes| */
    double top;               /* m, the water's highest place */
    int rows;
    bool wet[PROBES]; /* has read a pressure */
    int blank;        /* rows without one after that */
} sums;

static void add_row(const sb_measure_records *row, sums *s)
{
    double pressure = 0, force = 0;
    if (row->force_count == 0) return;
    for (size_t i = 0; i < row->probe_count; i++) {
        const sb_probe_record *probe = &row->probes[i];
        s->blank += s->wet[probe->probe] && isnan(probe->pressure);
        s->wet[probe->probe] |= !isnan(probe->pressure);
        pressure += isnan(probe->pressure) ? 0 : probe->pressure * SPACING;
    }
    for (size_t i = 0; i < row->force_count; i++) force += row->forces[i].body == 0 ? row->forces[i].pressure.x : 0;
    s->force += 0.01 * force;
    s->difference += 0.01 * fabs(force - pressure);
    s->rows++;
}

static sums run(const char *walls)
{
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_measure *measure = NULL;
    sb_error error = {0};
    sums s = {0};
    read_scene(walls, &scene);
    check_ok(sb_model_build(&scene, &model, &error), &error);
    check_ok(sb_sim_create(&scene, &model, NULL, &sim, &error), &error);
    check_ok(sb_sim_settle(sim, &error), &error);
    check_ok(sb_measure_create(&scene, &model, sim, &measure, &error), &error);
    while (sb_sim_report(sim)->time < scene.duration) {
        check_ok(sb_sim_step(sim, &error), &error);
        check_ok(sb_measure_step(measure, sim, &error), &error);
        add_row(sb_measure_latest(measure), &s);
        for (size_t i = 0; i < sb_sim_report(sim)->fluid_count; i++)
            s.top = fmax(s.top, sb_sim_particle(sim, i).position.z);
    }
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return s;
}

static void probes_sum_to_the_force_in_every_row(void **state)
{
    (void)state;
    static const char *const walls[] = {"particles, density: summed, stress_correction: 0", "images"};
    for (int w = 0; w < 2; w++) {
        const sums s = run(walls[w]);
        print_message("%s: force %.0f N s/m, difference %.1f, %d blank in %d rows of %d probes, water up to %.2f m\n",
                      walls[w], s.force, s.difference, s.blank, s.rows, PROBES, s.top);
        assert_true(s.top > 0.6 && s.force > 300); /* it strikes and overtops */
        assert_true(s.difference < 0.03 * s.force);
        for (int k = 0; k < PROBES; k++) assert_true(s.wet[k]);
        assert_int_equal(s.blank, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(probes_sum_to_the_force_in_every_row)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

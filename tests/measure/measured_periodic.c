/* Measurements at periodic sides give the same values as elsewhere. */
#include "base/random.h"
#include "measure/measure.h"
#include "sim/tank.h"

#include "../check.h"
#include <omp.h>
#include <stdio.h>

#define SPACING 0.1

enum { AT_SIDE, INSIDE, PLACES };

static sb_measure *start(const tank *t, sb_sim **sim)
{
    sb_measure *measure;
    sb_error error = {0};
    *sim = tank_sim(t);
    assert_non_null(*sim);
    assert_int_equal(sb_sim_settle(*sim, &error), SB_OK);
    if (sb_measure_create(&t->scene, &t->model, *sim, &measure, &error) != SB_OK) fail_msg("%s", error.text);
    return measure;
}

static void step(sb_sim *sim, sb_measure *measure)
{
    sb_error error = {0};
    assert_int_equal(sb_sim_step(sim, &error), SB_OK);
    assert_int_equal(sb_measure_step(measure, sim, &error), SB_OK);
}

static void make_slab(tank *t, sb_vec3 size)
{
    tank_make(t, 3, SPACING, size, size.x, 0.6, 0.1);
    tank_repeat(t, 0);
    tank_repeat(t, 1);
    /* Settling and the end of solves would amplify round-off. */
    t->scene.numerics.settle_steps = 0;
    t->scene.numerics.stress_correction = 0; /* its means depend on the place of the cells */
    t->scene.numerics.tolerance = 1e-30;
    t->scene.numerics.max_iterations = 25;
}

/* A slab of water is shifted so that its middle lies at its periodic sides: the values stay the same. */
static void gauges_and_probes_read_across_periodic_sides(void **state)
{
    (void)state;
    double eta[PLACES], pressure[PLACES][2];
    for (int place = AT_SIDE; place <= INSIDE; place++) {
        tank t;
        make_slab(&t, sb_vec(1, 0.4, 1));
        const sb_vec3 size = tank_whole_quanta(&t, sb_vec(1, 0.4, 1));
        tank_free(&t);
        make_slab(&t, size);
        const sb_vec3 half = tank_whole_quanta(&t, sb_vec(0.5, 0.2, 0));
        sb_vec3 at = half;
        if (place == AT_SIDE) {
            tank_roll(&t, half);
            at = sb_vec(0, size.y, 0);
        }
        sb_gauge gauge = {"gauge", at.x, at.y, 0};
        sb_probe probes[] = {{"inside", {at.x, at.y, 0.3}, 0}, {"floor", at, 0}};
        t.scene.measure = (sb_measure_settings){
            .interval = 0.02, .gauge_count = 1, .gauges = &gauge, .probe_count = 2, .probes = probes};
        sb_sim *sim;
        sb_measure *measure = start(&t, &sim);
        while (sb_sim_report(sim)->time < 0.02) step(sim, measure);
        const sb_measure_records *r = sb_measure_latest(measure);
        assert_int_equal(r->gauge_count, 1);
        assert_int_equal(r->probe_count, 2);
        eta[place] = r->gauges[0].z;
        for (int p = 0; p < 2; p++) pressure[place][p] = r->probes[p].pressure;
        sb_measure_destroy(measure);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    printf("gauge %.9f and %.9f m; probes %.5f and %.5f, %.5f and %.5f Pa\n", eta[0], eta[1], pressure[0][0],
           pressure[1][0], pressure[0][1], pressure[1][1]);
    assert_near(eta[INSIDE], 0.6, SPACING);
    assert_true(pressure[INSIDE][0] > 1000 && pressure[INSIDE][1] > 3000);
    assert_near(eta[AT_SIDE], eta[INSIDE], 1e-6);
    for (int p = 0; p < 2; p++) assert_near(pressure[AT_SIDE][p], pressure[INSIDE][p], 1e-5 * pressure[INSIDE][p]);
}

/* A uniform flow passes the same volume through planes at a side, near it and elsewhere. The map contains all water and
   shows no difference at the sides. */
static void planes_and_maps_read_across_periodic_sides(void **state)
{
    (void)state;
    tank t;
    sb_vec3 size = {1, 0.4, 1};
    tank_make(&t, 3, SPACING, size, 1, 0.6, 0.01);
    tank_repeat(&t, 0);
    tank_repeat(&t, 1);
    sb_model *m = &t.model;
    for (size_t i = 0; i < m->fluid_count; i++) m->fluid_velocity[i] = sb_vec(1, -0.7, 0);
    sb_flow_plane planes[] = {{"side", 0, 0, 0, 0.4, -1, 4, false, 0, 0, {.height = 0}},
                              {"beside", 0.98, 0, 0.98, 0.4, -1, 4, false, 0, 0, {.height = 0}},
                              {"middle", 0.5, 0, 0.5, 0.4, -1, 4, false, 0, 0, {.height = 0}},
                              {"along", 0, 0.4, 1, 0.4, -1, 4, false, 0, 0, {.height = 0}}};
    enum { PLANES = sizeof planes / sizeof *planes };
    t.scene.measure =
        (sb_measure_settings){.interval = 0.25,
                              .plane_count = PLANES,
                              .planes = planes,
                              .map = {.present = true, .x_max = 1, .y_max = 0.4, .cell = 0.05, .threshold = 1}};
    sb_sim *sim;
    sb_measure *measure = start(&t, &sim);
    const sb_map_record *map = sb_measure_map(measure);
    double water = 0, least = 1, most = 0;
    for (size_t i = 0; i < map->columns * map->rows; i++) {
        water += (double)map->depth[i] * 0.05 * 0.05;
        least = fmin(least, (double)map->depth[i]);
        most = fmax(most, (double)map->depth[i]);
    }
    printf("map: %.6f m3, depths %.4f to %.4f m\n", water, least, most);
    assert_near(water, 0.24, 1e-6);
    assert_true(least > 0.58 && most < 0.62);
    /* Twice through the period in x. */
    while (sb_sim_report(sim)->time < 2.01) step(sim, measure);
    const sb_energy e = sb_sim_energy(sim);
    double volume[PLANES] = {0};
    double time = 0;
    while (time < 2.249) {
        step(sim, measure);
        const sb_measure_records *r = sb_measure_latest(measure);
        for (size_t i = 0; i < r->flow_count; i++) {
            volume[r->flows[i].plane] = r->flows[i].volume;
            time = r->flows[i].time;
        }
    }
    double through = 0.24 * e.momentum.x / e.mass * 2.25;
    for (int p = 0; p < PLANES; p++) printf("%s: %.4f m3\n", planes[p].name, volume[p]);
    printf("the stream's %.4f m3\n", through);
    for (int p = 0; p < 3; p++) assert_near(volume[p], through, 0.05 * through);
    /* To the right of +x is -y. */
    assert_near(volume[3], 0.7 * 0.6 * 2.25, 0.1 * 0.7 * 0.6 * 2.25);
    assert_int_equal(sb_sim_report(sim)->fluid_count, m->fluid_count);
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    omp_set_num_threads(1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gauges_and_probes_read_across_periodic_sides),
        cmocka_unit_test(planes_and_maps_read_across_periodic_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

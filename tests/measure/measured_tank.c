/* Measurements of the real simulation in 2D: a small tank at rest and a collapsing column. */
#include "measure/measure.h"
#include "sim/tank.h"
#include "sim/walls/basin.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <omp.h>
#include <string.h>

#define SPACING 0.1

typedef struct sums {
    double force, level, pressure[3];
    int forces, levels, pressures[3];
} sums;

static void collect(sums *s, const sb_measure_records *r)
{
    for (size_t i = 0; i < r->force_count; i++, s->forces++) s->force += r->forces[i].force.z;
    for (size_t i = 0; i < r->gauge_count; i++, s->levels++) s->level += r->gauges[i].z;
    for (size_t i = 0; i < r->probe_count; i++) {
        s->pressure[r->probes[i].probe] += r->probes[i].pressure;
        s->pressures[r->probes[i].probe]++;
    }
}

static void a_tank_at_rest_reads_hydrostatic_values(void **state)
{
    (void)state;
    tank t;
    sb_vec3 size = {2, 1, 2};
    tank_make(&t, 2, SPACING, size, 2, 1, 0);
    sb_gauge gauge = {"middle", 1.03, 0, 0};
    sb_probe probes[] = {{"inside", {1, 0, 0.5}, 0}, {"floor", {0.9, 0, 0}, 0}, {"wall", {0, 0, 0.4}, 0}};
    t.scene.measure =
        (sb_measure_settings){.interval = 0.05, .gauge_count = 1, .gauges = &gauge, .probe_count = 3, .probes = probes};
    sb_sim *sim;
    sb_measure *measure;
    sums s = {0};
    assert_int_equal(sb_sim_create(&t.scene, &t.model, NULL, &sim, NULL), SB_OK);
    assert_int_equal(sb_sim_settle(sim, NULL), SB_OK);
    assert_int_equal(sb_measure_create(&t.scene, &t.model, sim, &measure, NULL), SB_OK);
    double weight = sb_sim_energy(sim).mass * 9.81;
    while (sb_sim_report(sim)->time < 2) {
        assert_int_equal(sb_sim_step(sim, NULL), SB_OK);
        assert_int_equal(sb_measure_step(measure, sim, NULL), SB_OK);
        if (sb_sim_report(sim)->time > 0.5) collect(&s, sb_measure_latest(measure));
    }
    double force = s.force / s.forces, level = s.level / s.levels;
    print_message("force/weight %.4f, level %.4f\n", -force / weight, level);
    assert_true(fabs(-force / weight - 1) < 0.01);
    assert_true(fabs(level - 1) < 0.5 * SPACING);
    for (int k = 0; k < 3; k++) {
        double expected = 9810 * (level - probes[k].at.z), p = s.pressure[k] / s.pressures[k];
        print_message("%s: %.0f Pa, hydrostatic %.0f\n", probes[k].name, p, expected);
        assert_true(fabs(p / expected - 1) < 0.1);
    }
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static double beyond(const sb_sim *sim, double x)
{
    size_t count = 0;
    for (size_t i = 0; i < sb_sim_report(sim)->fluid_count; i++) count += sb_sim_particle(sim, i).position.x >= x;
    return (double)count * SPACING * SPACING;
}

static void a_plane_counts_every_particle(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 2, SPACING, sb_vec(4, 1, 2), 1, 1, 0);
    sb_flow_plane plane = {"plane", 1.5, 0, 1.5, 1, -1, 4, false, 0, 0, {.height = 0}};
    t.scene.measure = (sb_measure_settings){.interval = 0.01, .plane_count = 1, .planes = &plane};
    sb_sim *sim;
    sb_measure *measure;
    double passed = 0, before = 0, after = 0;
    assert_int_equal(sb_sim_create(&t.scene, &t.model, NULL, &sim, NULL), SB_OK);
    assert_int_equal(sb_measure_create(&t.scene, &t.model, sim, &measure, NULL), SB_OK);
    while (sb_sim_report(sim)->time < 2) {
        before = beyond(sim, 1.5);
        assert_int_equal(sb_sim_step(sim, NULL), SB_OK);
        assert_int_equal(sb_measure_step(measure, sim, NULL), SB_OK);
        after = beyond(sim, 1.5);
        const sb_measure_records *r = sb_measure_latest(measure);
        for (size_t i = 0; i < r->flow_count; i++) {
            passed = r->flows[i].volume; /* within the step: between its two ends */
            assert_true(passed >= fmin(before, after) - 1e-9);
            assert_true(passed <= fmax(before, after) + 1e-9);
        }
    }
    assert_true(passed > 0.2);
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* A column collapses and strikes a wall. Probes stand a spacing apart along the wall, each for one spacing of it. Their
   sum is the body's force, except for the contact force on single drops. */
static void wall_probes_add_up_to_the_force(void **state)
{
    (void)state;
    enum { PROBES = 38 };
    const double spacing = 0.05;
    const sb_override set[] = {{"dimensions", "2"},
                               {"resolution", "0.05"},
                               {"domain.max", "[2.4, 2]"},
                               {"domain.min", "[0, 0]"},
                               {"water", "{boxes: [{min: [0, 0], max: [1, 1]}]}"},
                               {"bodies", "[{name: wall, shape: box, min: [2, 0], max: [2.4, 2]}]"}};
    basin b;
    basin_fill_from(&b, set, sizeof set / sizeof *set);
    sb_probe probes[PROBES];
    for (int k = 0; k < PROBES; k++) probes[k] = (sb_probe){"wall", {2, 0, (k + 0.5) * spacing}, 0};
    b.scene.measure = (sb_measure_settings){.interval = 0.002, .probe_count = PROBES, .probes = probes};
    sb_measure *measure;
    double probe_impulse = 0, force = 0, greatest = 0;
    assert_int_equal(sb_measure_create(&b.scene, &b.model, b.sim, &measure, NULL), SB_OK);
    while (sb_sim_report(b.sim)->time < 1.2) {
        assert_int_equal(sb_sim_step(b.sim, NULL), SB_OK);
        assert_int_equal(sb_measure_step(measure, b.sim, NULL), SB_OK);
        const sb_measure_records *r = sb_measure_latest(measure);
        for (size_t i = 0; i < r->probe_count; i++)
            probe_impulse += isnan(r->probes[i].pressure) ? 0 : r->probes[i].pressure * spacing * 0.002;
        for (size_t i = 0; i < r->force_count; i++) {
            if (strcmp(b.model.bodies[r->forces[i].body].name, "wall") != 0) continue;
            force += r->forces[i].force.x * 0.002;
            greatest = fmax(greatest, r->forces[i].force.x);
        }
    }
    print_message("probes %.0f N s/m, body %.0f N s/m, at most %.0f N/m\n", probe_impulse, force, greatest);
    assert_true(greatest > 5000); /* the water struck the wall: more than the column at rest would exert */
    assert_true(fabs(probe_impulse / force - 1) < 0.01);
    sb_measure_destroy(measure);
    b.scene.measure = (sb_measure_settings){0};
    basin_free(&b);
}

int main(void)
{
    omp_set_num_threads(1); /* a few hundred particles are faster on one thread */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tank_at_rest_reads_hydrostatic_values),
        cmocka_unit_test(a_plane_counts_every_particle),
        cmocka_unit_test(wall_probes_add_up_to_the_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

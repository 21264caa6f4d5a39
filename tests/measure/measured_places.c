/* Measurements at difficult positions: probes in corners and on thin plates, gauges over decks and beside walls, map
   cells that the domain cuts. Water at rest in 2D; the spacing is 2.5 cm. */
#include "base/memory.h"
#include "geometry/model/model.h"
#include "measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>
#include <omp.h>

#define SPACING 0.025

enum { PLACES = 8 };

/* Means over 0.5 s to 1 s at rest. */
typedef struct readings {
    double eta[PLACES], pressure[PLACES];
    float depth[PLACES];
} readings;

static void check_ok(sb_status status, const sb_error *error)
{
    if (status != SB_OK) fail_msg("%s", error->text);
}

static void read_scene(const char *text, sb_scene *scene)
{
    char path[] = "/tmp/shorebreak-places-XXXXXX";
    sb_error error = {0};
    int file = mkstemp(path);
    assert_true(file >= 0);
    assert_true(dprintf(file,
                        "dimensions: 2\nresolution: %g\nduration: 1\n"
                        "domain: {min: [0, 0], max: [2, 0.9]}\n%s",
                        SPACING, text) > 0);
    close(file);
    sb_status status = sb_scene_read(path, NULL, NULL, 0, scene, &error);
    unlink(path);
    check_ok(status, &error);
}

static readings at_rest(const char *text)
{
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_measure *measure = NULL;
    sb_error error = {0};
    readings r = {0};
    int rows = 0;
    read_scene(text, &scene);
    check_ok(sb_model_build(&scene, &model, &error), &error);
    check_ok(sb_sim_create(&scene, &model, NULL, &sim, &error), &error);
    check_ok(sb_sim_settle(sim, &error), &error);
    check_ok(sb_measure_create(&scene, &model, sim, &measure, &error), &error);
    while (sb_sim_report(sim)->time < 1) {
        check_ok(sb_sim_step(sim, &error), &error);
        check_ok(sb_measure_step(measure, sim, &error), &error);
        const sb_measure_records *now = sb_measure_latest(measure);
        if (sb_sim_report(sim)->time < 0.5 || now->gauge_count + now->probe_count == 0) continue;
        for (size_t i = 0; i < now->gauge_count; i++) r.eta[now->gauges[i].gauge] += now->gauges[i].z;
        for (size_t i = 0; i < now->probe_count; i++) r.pressure[now->probes[i].probe] += now->probes[i].pressure;
        rows += (int)((now->gauge_count + now->probe_count) / (scene.measure.gauge_count + scene.measure.probe_count));
    }
    assert_true(rows > 5);
    for (int k = 0; k < PLACES; k++) {
        r.eta[k] /= rows;
        r.pressure[k] /= rows;
    }
    const sb_map_record *map = sb_measure_map(measure);
    for (size_t k = 0; map && k < map->columns && k < PLACES; k++) r.depth[k] = map->depth[k];
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return r;
}

/* Compares the pressures at heights z with the hydrostatic ones below a level; tolerance: relative. */
static void check_pressures(const readings *r, const double *z, int count, double level, double tolerance)
{
    for (int k = 0; k < count; k++) {
        const double expected = 9810 * (level - z[k]);
        print_message("z = %.4f m: %.0f Pa, hydrostatic %.0f\n", z[k], r->pressure[k], expected);
        assert_true(fabs(r->pressure[k] / expected - 1) < tolerance);
    }
}

/* The surface of the walls continues behind the floor, where there is no water. Over six start seeds the corners read
   up to 5 % low. */
static void probes_in_corners_read_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0, 0.0125, 0.025, 0.05, 0, 0, 0};
    const readings r = at_rest("water: {level: 0.5, seed: [0.1, 0.1]}\n"
                               "measure:\n"
                               "  interval: 0.05\n"
                               "  probes: [{name: a, at: [0, 0]}, {name: b, at: [0, 0.0125]},\n"
                               "           {name: c, at: [0, 0.025]}, {name: d, at: [0, 0.05]},\n"
                               "           {name: e, at: [0.0125, 0]}, {name: f, at: [0.025, 0]},\n"
                               "           {name: g, at: [2, 0]}]\n");
    check_pressures(&r, z, 7, 0.5, 0.08);
}

/* A tread ends at two risers with the same normal: the riser at its back crosses it, the one at its front does not. */
static void probes_on_stairs_read_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0.15, 0.15, 0.3, 0.15};
    const readings r = at_rest("water: {level: 0.6, seed: [1.9, 0.1]}\n"
                               "bodies: [{name: upper, shape: box, min: [0, 0], max: [0.3, 0.3]},\n"
                               "         {name: lower, shape: box, min: [0.3, 0], max: [0.5, 0.15]}]\n"
                               "measure:\n"
                               "  interval: 0.05\n"
                               "  probes: [{name: a, at: [0.4, 0.15]}, {name: b, at: [0.35, 0.15]},\n"
                               "           {name: c, at: [0.15, 0.3]}, {name: d, at: [0.425, 0.15]}]\n");
    check_pressures(&r, z, 4, 0.6, 0.05);
}

/* Three spacings wide. */
static void a_narrow_channel_has_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0.2, 0.3};
    const readings r = at_rest("water: {level: 0.5, seed: [1.9, 0.1]}\n"
                               "bodies: [{name: left, shape: box, min: [0.6, 0.1], max: [0.9, 0.4]},\n"
                               "         {name: right, shape: box, min: [0.975, 0.1], max: [1.25, 0.4]}]\n"
                               "measure:\n"
                               "  interval: 0.05\n"
                               "  probes: [{name: a, at: [0.9, 0.2]}, {name: b, at: [0.975, 0.3]}]\n");
    check_pressures(&r, z, 2, 0.5, 0.05);
}

/* The opposite wall, two spacings away, is not a crossing wall. In so narrow a channel the pressure itself is 0.5 rho g
   spacings too high with a support radius of 3.25 spacings, 0.2 with one of 2.75. */
static void a_probe_in_a_narrow_channel_reads_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0.2, 0.3};
    const readings r = at_rest("water: {level: 0.5, seed: [1.9, 0.1]}\nnumerics: {support: 2.75}\n"
                               "bodies: [{name: left, shape: box, min: [0.6, 0.1], max: [0.9, 0.4]},\n"
                               "         {name: right, shape: box, min: [0.95, 0.1], max: [1.25, 0.4]}]\n"
                               "measure:\n"
                               "  interval: 0.05\n"
                               "  probes: [{name: a, at: [0.9, 0.2]}, {name: b, at: [0.95, 0.3]}]\n");
    check_pressures(&r, z, 2, 0.5, 0.05);
}

/* A tread of two and a half spacings consists almost only of edges. */
static void a_probe_on_a_narrow_tread_reads_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0.15};
    const readings r = at_rest("water: {level: 0.6, seed: [1.9, 0.1]}\n"
                               "bodies: [{name: upper, shape: box, min: [0, 0], max: [0.3, 0.3]},\n"
                               "         {name: lower, shape: box, min: [0.3, 0], max: [0.3625, 0.15]}]\n"
                               "measure: {interval: 0.05, probes: [{name: a, at: [0.33125, 0.15]}]}\n");
    check_pressures(&r, z, 1, 0.6, 0.05);
}

/* Both sides of a plate thinner than the support radius carry the force of the water in front of it. */
static void probes_on_thin_plates_read_hydrostatic_pressure(void **state)
{
    (void)state;
    static const double z[] = {0.1, 0.2, 0.3};
    const readings r =
        at_rest("water: {level: 0.5, seed: [1.9, 0.1]}\n"
                "bodies: [{name: plate, shape: box, min: [0.95, 0], max: [1, 0.8]}]\n"
                "measure:\n"
                "  interval: 0.05\n"
                "  probes: [{name: a, at: [1, 0.1]}, {name: b, at: [1, 0.2]}, {name: c, at: [1, 0.3]}]\n");
    check_pressures(&r, z, 3, 0.5, 0.05);
}

/* Gauges over the deck, at its ends and beside it. The domain's side at 2 m cuts the map's last cell. */
static void a_gauge_over_a_deck_reads_the_surface(void **state)
{
    (void)state;
    const readings r = at_rest("water: {level: 0.6, seed: [0.1, 0.05]}\n"
                               "bodies: [{name: deck, shape: box, min: [0.8, 0.3], max: [1.2, 0.425]}]\n"
                               "measure:\n"
                               "  interval: 0.05\n"
                               "  gauges: [{name: a, x: 1}, {name: b, x: 0.9}, {name: c, x: 0.8}, {name: d, x: 0.4}]\n"
                               "  map: {cell: 0.35}\n");
    for (int k = 0; k < 4; k++) {
        print_message("gauge %d: %.4f m\n", k, r.eta[k]);
        assert_true(fabs(r.eta[k] - 0.6) < 0.3 * SPACING);
    }
    for (int k = 0; k < 6; k++) {
        if (k == 2 || k == 3) continue; /* the deck occupies a part of these cells */
        assert_true(fabs((double)r.depth[k] - 0.6) < 0.5 * SPACING);
    }
}

/* Water under the deck only. */
static void a_gauge_over_a_dry_deck_reads_the_water_below(void **state)
{
    (void)state;
    const readings r = at_rest("water: {level: 0.3, seed: [0.1, 0.05]}\n"
                               "bodies: [{name: deck, shape: box, min: [0.8, 0.5], max: [1.2, 0.625]}]\n"
                               "measure: {interval: 0.05, gauges: [{name: a, x: 1}]}\n");
    assert_true(fabs(r.eta[0] - 0.3) < 0.3 * SPACING);
}

/* Shallow water at the gauge has more weight than deep water three spacings away, behind a wall. */
static void a_gauge_at_a_wall_reads_its_own_side(void **state)
{
    (void)state;
    const readings r = at_rest("water: {boxes: [{min: [0, 0], max: [0.925, 0.6]}, {min: [1, 0], max: [2, 0.1]}]}\n"
                               "bodies: [{name: wall, shape: box, min: [0.925, 0], max: [1, 0.8]}]\n"
                               "measure: {interval: 0.05, gauges: [{name: a, x: 1}, {name: b, x: 0.925}]}\n");
    print_message("%.4f m, %.4f m\n", r.eta[0], r.eta[1]);
    assert_true(fabs(r.eta[0] - 0.1) < 0.5 * SPACING);
    assert_true(fabs(r.eta[1] - 0.6) < 0.5 * SPACING);
}

/* On the last lines the puddle on the plateau has more particles than the sea. */
static void a_puddle_on_a_plateau_is_not_the_runup(void **state)
{
    (void)state;
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_measure *measure = NULL;
    sb_error error = {0};
    read_scene("water: {level: 0.3, seed: [0.1, 0.1], boxes: [{min: [1.4, 0.5], max: [2, 0.6]}]}\n"
               "bodies: [{name: plateau, shape: box, min: [1, 0], max: [2, 0.5]}]\n"
               "measure:\n"
               "  runups: [{name: deep, from: [0.2], to: [2]}, {name: near, from: [0.9], to: [2]},\n"
               "           {name: shore, from: [1], to: [2]}]\n",
               &scene);
    check_ok(sb_model_build(&scene, &model, &error), &error);
    check_ok(sb_sim_create(&scene, &model, NULL, &sim, &error), &error);
    check_ok(sb_sim_settle(sim, &error), &error);
    check_ok(sb_measure_create(&scene, &model, sim, &measure, &error), &error);
    const sb_measure_records *now = sb_measure_latest(measure);
    assert_int_equal(now->runup_count, 3);
    for (size_t i = 0; i < now->runup_count; i++) {
        const sb_runup_record *r = &now->runups[i];
        print_message("front %.4f m, top %.4f m, apart %.4f m\n", r->front, r->place.z, r->apart);
        assert_true(fabs(r->front - (1 - scene.measure.runups[i].ax)) < 0.5 * SPACING);
        assert_true(fabs(r->place.z - 0.3) < 0.5 * SPACING);
        assert_true(fabs(r->apart - 0.6) < 3 * SPACING); /* the puddle's end spreads during settling */
    }
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
}

int main(void)
{
    omp_set_num_threads(1); /* some thousand particles */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probes_in_corners_read_hydrostatic_pressure),
        cmocka_unit_test(probes_on_stairs_read_hydrostatic_pressure),
        cmocka_unit_test(a_narrow_channel_has_hydrostatic_pressure),
        cmocka_unit_test(a_probe_in_a_narrow_channel_reads_hydrostatic_pressure),
        cmocka_unit_test(a_probe_on_a_narrow_tread_reads_hydrostatic_pressure),
        cmocka_unit_test(probes_on_thin_plates_read_hydrostatic_pressure),
        cmocka_unit_test(a_gauge_over_a_deck_reads_the_surface),
        cmocka_unit_test(a_gauge_over_a_dry_deck_reads_the_water_below),
        cmocka_unit_test(a_gauge_at_a_wall_reads_its_own_side),
        cmocka_unit_test(a_puddle_on_a_plateau_is_not_the_runup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

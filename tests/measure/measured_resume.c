/* Measurements that continue from a saved state give the same records as uninterrupted ones. */
#include "../check.h"
#include "base/hash.h"
#include "measure/measure.h"
#include "sim/tank.h"

#include <omp.h>
#include <string.h>

enum { BEFORE = 60, AFTER = 60 };

static const sb_gauge gauges[] = {{"wet", 0.33, 0, 0}, {"far", 0.61, 0, 0}, {"dry", 1.7, 0, 0}};
static const sb_probe probes[] = {{"inside", {0.5, 0, 0.3}, 0}, {"wall", {2, 0, 0.1}, 0}};
static const sb_flow_plane planes[] = {{"plane", 1.1, 0, 1.1, 1, -1, 4, true, 0.026, 1, {.height = 0}},
                                       {"lip", 1.3, 0, 1.3, 1, 0.2, 4, false, 0, 0, {.height = 0}}};
static const sb_runup_line lines[] = {{"floor", 0, 0, 2, 0}};

static const sb_gauge_name split_names[] = {{"wet"}, {"far"}, {"dry"}};
static const sb_reflection_set splits[] = {
    {"waves", 3, (sb_gauge_name *)split_names, 0.11, 2, 0.3, 0, 0.02, 0.2, false},
    {"whole", 3, (sb_gauge_name *)split_names, 0.3, 1, 0.3, 0, 0, 9, false}};

/* A water column that has begun to collapse. */
static void make(tank *t)
{
    tank_make(t, 2, 0.05, sb_vec(2, 0, 1.5), 1, 0.8, 0.05);
    t->scene.measure = (sb_measure_settings){
        .interval = 0.013,
        .gauge_count = 3,
        .gauges = (sb_gauge *)gauges,
        .probe_count = 2,
        .probes = (sb_probe *)probes,
        .plane_count = 2,
        .planes = (sb_flow_plane *)planes,
        .runup_count = 1,
        .runups = (sb_runup_line *)lines,
        .reflection_count = 2,
        .reflections = (sb_reflection_set *)splits,
        .map = {.present = true, .x_max = 2, .cell = 0.1, .threshold = 0.05},
    };
}

/* Continues a hash over all records of a step; counts the flow rows. */
static uint64_t hash_records(uint64_t hash, const sb_measure_records *r, size_t *flows)
{
    hash = sb_hash(hash, r->forces, r->force_count * sizeof *r->forces);
    hash = sb_hash(hash, r->gauges, r->gauge_count * sizeof *r->gauges);
    hash = sb_hash(hash, r->probes, r->probe_count * sizeof *r->probes);
    hash = sb_hash(hash, r->flows, r->flow_count * sizeof *r->flows);
    hash = sb_hash(hash, r->runups, r->runup_count * sizeof *r->runups);
    *flows += r->flow_count;
    hash = sb_hash(hash, r->waters, r->water_count * sizeof *r->waters);
    hash = sb_hash(hash, r->reflections, r->reflection_count * sizeof *r->reflections);
    return sb_hash(hash, r->energies, r->energy_count * sizeof *r->energies);
}

static uint64_t steps(sb_sim *sim, sb_measure *measure, int count, size_t *flows)
{
    uint64_t hash = 0;
    for (int s = 0; s < count; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        assert_int_equal(sb_measure_step(measure, sim, NULL), SB_OK);
        hash = hash_records(hash, sb_measure_latest(measure), flows);
    }
    const sb_map_record *map = sb_measure_map(measure);
    const size_t bytes = map->columns * map->rows * sizeof(float);
    hash = sb_hash(hash, map->depth, bytes);
    hash = sb_hash(hash, map->speed, bytes);
    hash = sb_hash(hash, map->flux, bytes);
    hash = sb_hash(hash, map->arrival, bytes);
    const double missed[] = {sb_measure_gauge_missed(measure, 0), sb_measure_gauge_missed(measure, 2)};
    hash = sb_hash(hash, missed, sizeof missed);
    size_t row_count;
    const sb_reflection_record *rows;
    assert_int_equal(sb_measure_reflections(measure, &rows, &row_count, NULL), SB_OK);
    hash = sb_hash(hash, rows, row_count * sizeof *rows);
    const sb_body_record *body = &sb_measure_bodies(measure)[0];
    const double totals[] = {body->peak,     body->peak_time, body->impulse.x,
                             body->moment.y, body->torque.y,  body->layers};
    return sb_hash(hash, totals, sizeof totals);
}

static void create(const tank *t, sb_sim **sim, sb_measure **measure)
{
    *sim = tank_sim(t);
    assert_non_null(*sim);
    assert_int_equal(sb_measure_create(&t->scene, &t->model, *sim, measure, NULL), SB_OK);
}

static void save(const sb_sim *sim, const sb_measure *measure, sb_archive_out *out)
{
    sb_archive_begin(out, "TEST", 1);
    sb_sim_save(sim, out);
    sb_measure_save(measure, out);
    assert_int_equal(sb_archive_close(out, NULL), SB_OK);
}

static void check(int before)
{
    tank t;
    sb_sim *sim;
    sb_measure *measure;
    sb_archive_out out = {0};
    sb_archive_in in;
    sb_error error = {0};
    size_t flows = 0, resumed_flows = 0;
    make(&t);
    create(&t, &sim, &measure);
    steps(sim, measure, before, &flows);
    save(sim, measure, &out);
    flows = 0;
    const uint64_t whole = steps(sim, measure, AFTER, &flows);
    assert_true(flows > 10);
    const double volume = sb_measure_bodies(measure)[0].peak;
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    create(&t, &sim, &measure);
    assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, &error), SB_OK);
    if (sb_sim_load(sim, &in, &error) != SB_OK || sb_measure_load(measure, &in, &error) != SB_OK)
        fail_msg("%s", error.text);
    assert_int_equal(sb_measure_latest(measure)->gauge_count, 0);
    const uint64_t resumed = steps(sim, measure, AFTER, &resumed_flows);
    assert_int_equal(resumed_flows, flows);
    assert_true(sb_measure_bodies(measure)[0].peak == volume);
    assert_true(resumed == whole);
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_archive_out_free(&out);
    tank_free(&t);
}

/* Saved at several times within an interval: the state of the interval in progress differs. */
static void rows_continue_after_resume(void **state)
{
    (void)state;
    for (int before = BEFORE; before < BEFORE + 6; before++) check(before);
}

static void measurements_of_another_scene_are_refused(void **state)
{
    (void)state;
    tank t, other;
    sb_sim *sim;
    sb_measure *measure;
    sb_archive_out out = {0};
    size_t flows = 0;
    make(&t);
    create(&t, &sim, &measure);
    steps(sim, measure, 10, &flows);
    save(sim, measure, &out);
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    static const char *const messages[] = {"a different number of flow planes, expected 1", "expected none",
                                           "a list of 20 elements", "the next rows at "};
    for (int k = 0; k < 4; k++) {
        sb_archive_in in;
        sb_error error = {0};
        make(&other);
        other.scene.measure.plane_count -= k == 0;
        other.scene.measure.map.present = k != 1;
        other.scene.measure.map.cell *= k == 2 ? 2 : 1;
        other.scene.measure.interval *= k == 3 ? 0.01 : 1;
        create(&other, &sim, &measure);
        assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, NULL), SB_OK);
        assert_int_equal(sb_measure_load(measure, &in, &error), SB_BAD_INPUT);
        if (!strstr(error.text, messages[k])) fail_msg("%d: %s", k, error.text);
        sb_measure_destroy(measure);
        sb_sim_destroy(sim);
        tank_free(&other);
    }
    sb_archive_out_free(&out);
    tank_free(&t);
}

int main(void)
{
    omp_set_num_threads(1); /* a few hundred particles are faster on one thread */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_continue_after_resume),
        cmocka_unit_test(measurements_of_another_scene_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Intervals, forces, and totals over the whole run. */
#include "fake_sim.h"

#include "base/memory.h"
#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* A scene with two reporting bodies and one that does not report. */
static void make_world(fake_world *world, sb_model_body bodies[3])
{
    fake_world_make(world, 3, 1, sb_vec(0, 0, 0), sb_vec(20, 20, 20));
    for (int b = 0; b < 3; b++) bodies[b] = (sb_model_body){.report = b != 1};
    world->model.body_count = 3;
    world->model.bodies = bodies;
}

static void push(sb_body_impulse *impulse, double dt, double force)
{
    impulse->pressure.x += dt * force;
    impulse->pressure.z -= 2 * dt * force;
    impulse->friction.x += 0.1 * dt * force;
    impulse->moment.y += 3 * dt * force;
}

static void impulse_of_all_rows_is_the_integral(void **state)
{
    (void)state;
    fake_world world;
    sb_model_body bodies[3];
    make_world(&world, bodies);
    sb_measure *measure;
    world.sim.impulses[0].pressure.x = 77; /* from settling: does not count */
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    double sum = 0, sum_moment = 0, expected = 0;
    size_t rows = 0;
    for (uint64_t k = 0; rows < 2 * 50; k++) {
        /* Some steps are shorter than the interval, some contain several of its multiples. */
        double dt = k % 7 == 3 ? 0.37 : 0.03 + 0.02 * sb_random(5, k);
        double force = 100 * sin((double)k) + 50, before = world.sim.report.time;
        push(&world.sim.impulses[0], dt, force);
        push(&world.sim.impulses[2], dt, -force);
        fake_step(&world.sim, dt);
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
        const sb_measure_records *records = sb_measure_latest(measure);
        double last = before;
        for (size_t i = 0; i < records->force_count; i++) {
            const sb_force_record *row = &records->forces[i];
            rows++;
            assert_true(row->body == (i % 2 ? 2 : 0));
            assert_true(fabs(row->time / 0.1 - round(row->time / 0.1)) < 1e-9);
            assert_true(row->time == (double)((rows - 1) / 2 + 1) * 0.1);
            if (row->body == 2) continue;
            sum += row->force.x * 0.1;
            sum_moment += row->moment.y * 0.1;
            expected += 1.1 * force * (row->time - last);
            last = row->time;
            assert_true(fabs(sum - expected) < 1e-9);
            assert_true(fabs(sum_moment - 3 * expected / 1.1) < 1e-9);
        }
        expected += 1.1 * force * (world.sim.report.time - last);
    }
    assert_true(sum != 0);
    const sb_body_record *body = sb_measure_bodies(measure);
    assert_true(fabs(body[0].impulse.x - sum) < 1e-9); /* what comes after the last row is counted by the next */
    assert_true(fabs(body[2].impulse.x + sum) < 1e-9);
    assert_true(body[1].peak == 0 && !body[1].report);
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

static void peak_is_of_interval_means(void **state)
{
    (void)state;
    fake_world world;
    sb_model_body bodies[3];
    make_world(&world, bodies);
    sb_measure *measure;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    for (int k = 0; k < 40; k++) {
        /* A force during one step of 0.025 s has a quarter of its value as mean over 0.1 s. */
        world.sim.impulses[0].pressure.x += 0.025 * (k == 17 ? 400 : 0);
        fake_step(&world.sim, 0.025);
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
    }
    const sb_body_record *body = sb_measure_bodies(measure);
    assert_true(fabs(body[0].peak - 100) < 1e-9);
    assert_true(fabs(body[0].peak_time - 0.5) < 1e-12);
    sb_frame_body in_frame[3] = {0};
    sb_frame frame = {.body_count = 3, .bodies = in_frame};
    world.sim.impulses[2].friction.y += 5;
    for (int k = 0; k < 4; k++) {
        fake_step(&world.sim, 0.025);
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
    }
    assert_int_equal(sb_measure_fill_frame(measure, &frame, NULL), SB_OK);
    assert_true(fabs(in_frame[2].force.y - 50) < 1e-9);
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

/* Water that rises at 0.7 m/s: values must belong to the exact multiple of the interval, not to the step's end. */
static void instants_lie_on_multiples(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, -5), sb_vec(10, 10, 30));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(10, 10, 5), 0, 0, 0, 1);
    for (size_t i = 0; i < world.sim.report.fluid_count; i++) world.sim.samples[i].velocity = sb_vec(0, 0, 0.7);
    world.sim.report.max_speed = 0.7;
    sb_gauge gauge = {"g", 5, 5, 0};
    world.scene.measure.gauges = &gauge;
    world.scene.measure.gauge_count = 1;
    world.scene.sea = (sb_sea){.present = true, .level = 5.5};
    sb_measure *measure;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    assert_int_equal(sb_measure_latest(measure)->gauge_count, 1);
    assert_true(sb_measure_latest(measure)->gauges[0].time == 0);
    int rows = 0;
    double largest = 0; /* since the last row */
    for (int k = 0; k < 20; k++) {
        world.sim.ledger.pressure = -k;
        world.sim.report.momentum_imbalance = k % 3 ? 1e-7 * k : 1e-9;
        largest = fmax(largest, world.sim.report.momentum_imbalance);
        fake_step(&world.sim, 0.07 + 0.02 * (k % 9));
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
        const sb_measure_records *records = sb_measure_latest(measure);
        for (size_t i = 0; i < records->gauge_count; i++) {
            rows++;
            assert_true(records->gauges[i].time == rows * 0.1);
            assert_true(fabs(records->gauges[i].z - (5 + 0.7 * rows * 0.1)) < 1e-6);
            assert_true(fabs(records->gauges[i].eta - (0.7 * rows * 0.1 - 0.5)) < 1e-6);
        }
        assert_true(records->energy_count == (records->gauge_count > 0));
        if (!records->energy_count) continue;
        assert_true(records->energies[0].ledger.pressure == -k);
        assert_true(records->energies[0].momentum_imbalance == largest);
        largest = 0;
    }
    assert_true(rows > 20);
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

/* In a scene with boxes of water only there is no still-water level. */
static void without_a_level_there_is_no_elevation_above_it(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, -5), sb_vec(10, 10, 30));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(10, 10, 5), 0, 0, 0, 1);
    sb_gauge gauge = {"g", 5, 5, 0};
    world.scene.measure.gauges = &gauge;
    world.scene.measure.gauge_count = 1;
    sb_measure *measure;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    const sb_gauge_record *row = sb_measure_latest(measure)->gauges;
    assert_true(fabs(row->z - 5) < 1e-6);
    assert_true(isnan(row->eta));
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

static void nothing_requested_allocates_nothing(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(10, 10, 10));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(10, 10, 5), 0, 0, 0, 1);
    sb_measure *measure;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    int lines = 0;
    while (sb_measure_skipped(measure)[lines].what) lines++;
    assert_int_equal(lines, 6);
    assert_null(sb_measure_map(measure));
    assert_true(sb_measure_bytes(measure) < 4096);
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

/* Every allocation fails once: an error, no leak (the sanitizer checks), no crash. */
static void survives_failing_memory(void **state)
{
    (void)state;
    fake_world world;
    sb_model_body bodies[3];
    make_world(&world, bodies);
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(10, 10, 5), 0, 0, 0, 1);
    sb_gauge gauge = {"g", 5, 5, 0};
    sb_flow_plane plane = {"plane", 5, 0, 5, 10, 0, 10, false, 0, 0, {.height = 0}};
    sb_measure_settings *settings = &world.scene.measure;
    settings->gauges = &gauge;
    settings->gauge_count = 1;
    settings->planes = &plane;
    settings->plane_count = 1;
    settings->map = (sb_map){true, 0, 0, 10, 10, 2, 0.5};
    int failures = 0;
    for (long n = 1; n < 200; n++) {
        sb_measure *measure = NULL;
        sb_error error = {0};
        sb_memory_fail_at(n);
        sb_status status = sb_measure_create(&world.scene, &world.model, &world.sim, &measure, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) {
            sb_measure_destroy(measure);
            break;
        }
        assert_int_equal(status, SB_FAILED);
        assert_null(measure);
        assert_true(error.text[0] != '\0');
        failures++;
    }
    assert_true(failures > 10 && failures < 199);
    fake_world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impulse_of_all_rows_is_the_integral),
        cmocka_unit_test(peak_is_of_interval_means),
        cmocka_unit_test(instants_lie_on_multiples),
        cmocka_unit_test(without_a_level_there_is_no_elevation_above_it),
        cmocka_unit_test(nothing_requested_allocates_nothing),
        cmocka_unit_test(survives_failing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

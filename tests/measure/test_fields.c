/* Volume through planes, run-up, maps, and flow depth at faces. */
#include "fake_sim.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void drift(sb_sim *sim, sb_vec3 velocity)
{
    for (size_t i = 0; i < sim->report.fluid_count; i++) sim->samples[i].velocity = velocity;
    sim->report.max_speed = sb_norm(velocity);
}

static double passed(fake_world *world, const sb_flow_plane *plane, sb_vec3 velocity, double dt, int steps)
{
    sb_measure_view view = fake_view(world);
    sb_plane_counter *counter;
    double volume = 0;
    drift(&world->sim, velocity);
    assert_int_equal(sb_plane_counter_create(&view, plane, &counter, NULL), SB_OK);
    for (int k = 0; k < steps; k++) {
        fake_step(&world->sim, dt);
        assert_int_equal(sb_plane_counter_step(counter, &view, &volume, NULL), SB_OK);
    }
    sb_plane_counter_destroy(counter);
    return volume;
}

static void plane_counts_every_particle_once(void **state)
{
    (void)state;
    /* From (5, 2) to (5, 8), heights 1 to 4: +x is to the right. */
    const sb_flow_plane plane = {"plane", 5, 2, 5, 8, 1, 4, false, 0, 0, {.height = 0}};
    fake_world world;
    fake_world_make(&world, 3, 0.5, sb_vec(-5, 0, 0), sb_vec(30, 10, 10));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 10, 6), 0, 0, 0, 1);
    /* The block of 4 x 6 x 3 m in front of the opening passes, for any step length. */
    assert_true(fabs(passed(&world, &plane, sb_vec(3, 0, 0), 0.11, 40) - 72) < 1e-9);
    assert_true(fabs(passed(&world, &plane, sb_vec(-2, 0, 0), 0.07, 200) + 72) < 1e-9);
    fake_world_free(&world);
}

static void an_oblique_plane_has_the_same_flux(void **state)
{
    (void)state;
    const sb_flow_plane plane = {"plane", 8, 2, 5, 8, -1, 20, false, 0, 0, {.height = 0}};
    const sb_flow_plane turned = {"plane", 5, 8, 8, 2, -1, 20, false, 0, 0, {.height = 0}};
    fake_world world;
    fake_world_make(&world, 3, 0.5, sb_vec(-5, 0, 0), sb_vec(30, 10, 10));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 10, 6), 0, 0, 0.1, 1);
    /* The oblique plane spans 6 m of y. Jitter changes the count only at its two ends. */
    assert_true(fabs(passed(&world, &plane, sb_vec(3, 0, 0), 0.11, 60) - 4 * 6 * 6) < 6);
    assert_true(fabs(passed(&world, &turned, sb_vec(-3, 0, 0), 0.1, 60) - 4 * 6 * 6) < 6);
    fake_world_free(&world);
}

static void plane_in_two_dimensions(void **state)
{
    (void)state;
    const sb_flow_plane plane = {"plane", 5, 0, 5, 1, 0, 3, false, 0, 0, {.height = 0}};
    fake_world world;
    fake_world_make(&world, 2, 0.25, sb_vec(-5, 0, 0), sb_vec(30, 0, 10));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 0, 4), 0, 0, 0, 1);
    assert_true(fabs(passed(&world, &plane, sb_vec(2, 0, 0), 0.1, 60) - 12) < 1e-9);
    fake_world_free(&world);
}

static void runup_is_the_top_of_connected_water(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 0.5, sb_vec(0, 0, 0), sb_vec(40, 10, 20));
    /* A film two layers thick on a 1:4 slope up to x = 20, and a drop above it. */
    for (double x = 0.25; x < 20; x += 0.5)
        for (double y = 0.25; y < 10; y += 0.5)
            for (int k = 0; k < 2; k++)
                fake_add(&world.sim, sb_vec(x, y, 0.25 * x + 0.25 + 0.5 * k), sb_vec(0, 0, 0), 0);
    fake_add(&world.sim, sb_vec(12, 5, 15), sb_vec(0, 0, 0), 0);
    const sb_runup_line line = {"beach", 0, 5, 40, 5};
    sb_measure_view view = fake_view(&world);
    sb_runup_record record;
    assert_int_equal(sb_runup_read(&view, &line, &record, NULL), SB_OK);
    assert_true(fabs(record.place.x - 19.75) < 1e-9);
    assert_true(fabs(record.place.z - (0.25 * 19.75 + 1.0)) < 1e-9);
    assert_true(fabs(record.front - 20) < 1e-9);
    const sb_runup_line away = {"away", 30, 5, 40, 5};
    assert_int_equal(sb_runup_read(&view, &away, &record, NULL), SB_OK);
    assert_true(isnan(record.place.z) && isnan(record.front));
    fake_world_free(&world);
}

/* Water of a known extent, particles displaced by up to 0.2 spacings: the front is correct to this distance in every
   direction of the line, and the drop ahead of it does not count. */
static void front_is_the_extent_of_connected_water(void **state)
{
    (void)state;
    for (int k = 0; k < 40; k++) {
        int dimensions = 2 + k % 2;
        double extent = 6 + 0.5 * (k % 10), spacing = 0.5;
        fake_world world;
        fake_world_make(&world, dimensions, spacing, sb_vec(-20, 0, 0), sb_vec(20, 10, 20));
        bool back = k % 4 >= 2; /* the water then lies on the other side, too */
        fake_fill(&world, sb_vec(back ? -extent : 0, 0, 0), sb_vec(back ? 0 : extent, 10, 1), 0, 0, 0.2,
                  (uint64_t)k + 1);
        fake_add(&world.sim, sb_vec(back ? -extent - 2 : extent + 2, dimensions == 2 ? 0 : 5, 0.25), sb_vec(0, 0, 0),
                 0);
        const sb_runup_line line = {"floor", back ? 2 : -2, 5, back ? -20 : 20, 5};
        const sb_runup_line little = {"little", 0, 5, back ? -5 : 5, 5};
        sb_measure_view view = fake_view(&world);
        sb_runup_record record;
        assert_int_equal(sb_runup_read(&view, &line, &record, NULL), SB_OK);
        assert_true(fabs(record.front - (extent + 2)) <= 0.2 * spacing);
        assert_int_equal(sb_runup_read(&view, &little, &record, NULL), SB_OK);
        assert_true(fabs(record.front - 5) < 1e-9);
        fake_world_free(&world);
    }
}

/* A layer whose particles are 1.8 spacings apart is still connected; at 2.1 spacings they are drops. */
static void front_follows_a_thin_film(void **state)
{
    (void)state;
    for (int torn = 0; torn < 2; torn++) {
        double spacing = 0.5, gap = torn ? 2.1 * spacing : 1.8 * spacing, last = 5.75;
        fake_world world;
        fake_world_make(&world, 2, spacing, sb_vec(0, 0, 0), sb_vec(40, 0, 20));
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(6, 0, 1), 0, 0, 0, 1);
        for (int k = 1; k <= 5; k++) fake_add(&world.sim, sb_vec(last + k * gap, 0, 0.25), sb_vec(0, 0, 0), 0);
        const sb_runup_line line = {"floor", 0, 0, 40, 0};
        sb_measure_view view = fake_view(&world);
        sb_runup_record record;
        assert_int_equal(sb_runup_read(&view, &line, &record, NULL), SB_OK);
        double front = (torn ? last : last + 5 * gap) + spacing / 2;
        assert_true(fabs(record.front - front) < 1e-9);
        fake_world_free(&world);
    }
}

/* A block of 4 x 6 x 3 m over the grid: depth 3 inside; volume is conserved for any cell size. */
static void map_conserves_volume(void **state)
{
    (void)state;
    const double cells[] = {0.13, 0.5, 1, 2, 3.3};
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
        fake_world world;
        fake_world_make(&world, 3, 0.5, sb_vec(0, 0, 0), sb_vec(12, 12, 10));
        fake_fill(&world, sb_vec(3, 3, 0), sb_vec(7, 9, 3), 0, 0, 0, 1);
        drift(&world.sim, sb_vec(3, 4, 1));
        world.scene.measure.map = (sb_map){true, 0, 0, 12, 12, cells[c], 0.5};
        sb_measure_view view = fake_view(&world);
        sb_map_field *map;
        assert_int_equal(sb_map_create(&view, &map, NULL), SB_OK);
        const sb_map_record *result = sb_map_result(map);
        double volume = 0, deepest = 0;
        for (size_t i = 0; i < result->columns * result->rows; i++) {
            if (isnan(result->depth[i])) continue;
            volume += (double)result->depth[i] * cells[c] * cells[c];
            deepest = fmax(deepest, (double)result->depth[i]);
            if (!isnan(result->speed[i])) {
                assert_true(fabs((double)result->speed[i] - 5) < 1e-4);
                assert_true(fabs((double)(result->flux[i] / result->depth[i]) - 25) < 1e-3);
            }
        }
        assert_true(fabs(volume - 72) < 1e-2);
        assert_true(deepest < 3.001 && (cells[c] > 2 || deepest > 2.999));
        sb_map_destroy(map);
        fake_world_free(&world);
    }
}

static void map_contains_arrival_times(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 0.5, sb_vec(0, 0, 0), sb_vec(20, 4, 10));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 4, 3), 0, 0, 0, 1);
    drift(&world.sim, sb_vec(2, 0, 0));
    world.scene.measure.map = (sb_map){true, 0, 0, 20, 4, 1, 1.5};
    sb_measure_view view = fake_view(&world);
    sb_map_field *map;
    assert_int_equal(sb_map_create(&view, &map, NULL), SB_OK);
    for (int k = 0; k < 600; k++) {
        fake_step(&world.sim, 0.01);
        sb_map_step(map, &world.sim);
    }
    const sb_map_record *result = sb_map_result(map);
    /* Cell 10 is half full (threshold 1.5 of 3 m) when the front is at x = 10.5. */
    assert_true(fabs((double)result->arrival[2 * 20 + 10] - (10.5 - 4) / 2) < 0.06);
    assert_true(isnan(result->arrival[2 * 20 + 19])); /* never wet */
    assert_true(result->arrival[2 * 20 + 1] == 0);    /* wet from the start */
    assert_true(isnan(result->depth[2 * 20 + 19]));
    sb_map_destroy(map);
    fake_world_free(&world);
}

/* Returns the depth of the flow towards a body's faces in spacings, and adds it to *sum. */
static double approach(fake_world *world, const sb_footprint *body, sb_vec3 displacement, sb_approach *sum)
{
    sb_measure_view view = fake_view(world);
    sb_approach now = {0}, *to = sum ? sum : &now;
    assert_int_equal(sb_face_approach(&view, body, displacement, to, NULL), SB_OK);
    return to->weight > 0 ? to->layers / to->weight : 0;
}

static void depth_of_still_water_at_faces(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(20, 20, 10));
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 20, 3), 0, 0, 0, 1); /* 6 layers */
        /* A building whose seaward face is at x = 8: its particles lie half a spacing inside. */
        const sb_footprint building = {{8.25, 5.25, 0}, {14.75, 14.75, 8}};
        assert_true(fabs(approach(&world, &building, sb_vec(0, 0, 0), NULL) - 6) < 0.7);
        assert_true(approach(&world, &building, sb_vec(5, 0, 0), NULL) == 0);
        /* The tank around the water has the water inside. */
        const sb_footprint tank = {{-0.25, -0.25, -0.25}, {20.25, 20.25, 9}};
        assert_true(fabs(approach(&world, &tank, sb_vec(0, 0, 0), NULL) - 6) < 0.7);
        fake_world_free(&world);
    }
}

/* Two layers flow towards a wall, where water splashes ten layers high. Later a pool of six layers is thrown back. */
static void flow_depth_is_that_of_the_approaching_water(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        sb_approach sum = {0};
        const sb_footprint wall = {{8.25, -1, 0}, {20, 21, 8}};
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(20, 20, 10));
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(7.5, 20, 1), 0, 0, 0, 1);
        for (size_t i = 0; i < world.sim.report.fluid_count; i++) world.sim.samples[i].velocity = sb_vec(4, 0, 0);
        fake_fill(&world, sb_vec(7.5, 0, 0), sb_vec(8, 20, 5), 0, 0, 0, 2);
        assert_true(fabs(approach(&world, &wall, sb_vec(0, 0, 0), &sum) - 2) < 0.3);
        world.sim.report.fluid_count = 0;
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 20, 3), 0, 0, 0, 1);
        for (size_t i = 0; i < world.sim.report.fluid_count; i++)
            world.sim.samples[i].velocity = sb_vec(i % 2 ? 0.3 : -0.4, 0, 0);
        for (int rows = 0; rows < 10; rows++) approach(&world, &wall, sb_vec(0, 0, 0), &sum);
        assert_true(fabs(sum.layers / sum.weight - 2) < 0.3);
        /* A deeper flow that follows counts by its momentum. */
        for (size_t i = 0; i < world.sim.report.fluid_count; i++) world.sim.samples[i].velocity = sb_vec(4, 0, 0);
        for (int rows = 0; rows < 3; rows++) approach(&world, &wall, sb_vec(0, 0, 0), &sum);
        assert_true(sum.layers / sum.weight > 5);
        fake_world_free(&world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_counts_every_particle_once),
        cmocka_unit_test(an_oblique_plane_has_the_same_flux),
        cmocka_unit_test(plane_in_two_dimensions),
        cmocka_unit_test(runup_is_the_top_of_connected_water),
        cmocka_unit_test(front_is_the_extent_of_connected_water),
        cmocka_unit_test(front_follows_a_thin_film),
        cmocka_unit_test(map_conserves_volume),
        cmocka_unit_test(map_contains_arrival_times),
        cmocka_unit_test(depth_of_still_water_at_faces),
        cmocka_unit_test(flow_depth_is_that_of_the_approaching_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

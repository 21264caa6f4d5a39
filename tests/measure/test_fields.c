/* Volume through planes, run-up, maps, and flow depth at faces. */
#include "fake_sim.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

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
    assert_int_equal(sb_runup_read(&view, &line, NULL, &record, NULL), SB_OK);
    assert_true(fabs(record.place.x - 19.75) < 1e-9);
    assert_true(fabs(record.place.z - (0.25 * 19.75 + 1.0)) < 1e-9);
    assert_true(fabs(record.front - 20) < 1e-9);
    const sb_runup_line away = {"away", 30, 5, 40, 5};
    assert_int_equal(sb_runup_read(&view, &away, NULL, &record, NULL), SB_OK);
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
        assert_int_equal(sb_runup_read(&view, &line, NULL, &record, NULL), SB_OK);
        assert_true(fabs(record.front - (extent + 2)) <= 0.2 * spacing);
        assert_int_equal(sb_runup_read(&view, &little, NULL, &record, NULL), SB_OK);
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
        assert_int_equal(sb_runup_read(&view, &line, NULL, &record, NULL), SB_OK);
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
        assert_int_equal(sb_map_create(&view, &world.model, &map, NULL), SB_OK);
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
    assert_int_equal(sb_map_create(&view, &world.model, &map, NULL), SB_OK);
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

/* Adds a rectangle that faces upwards to a world, as a body of its own. */
static void add_rectangle(fake_world *world, sb_role role, sb_vec3 low, sb_vec3 high)
{
    sb_model *model = &world->model;
    static sb_model_body bodies[9];
    sb_model_body *body = &bodies[model->body_count++];
    *body = (sb_model_body){.wavemaker = -1, .source = SIZE_MAX, .role = role};
    assert_int_equal(sb_mesh_alloc(&body->mesh, 4, 2, NULL), SB_OK);
    /* z rises along x from low.z to high.z. */
    body->mesh.vertices[0] = low;
    body->mesh.vertices[1] = sb_vec(high.x, low.y, high.z);
    body->mesh.vertices[2] = high;
    body->mesh.vertices[3] = sb_vec(low.x, high.y, low.z);
    static const uint32_t corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    memcpy(body->mesh.triangles, corners, sizeof corners);
    model->bodies = bodies;
}

static void free_bodies(fake_world *world)
{
    for (size_t b = 0; b < world->model.body_count; b++) sb_mesh_free(&world->model.bodies[b].mesh);
}

/* Drops in flight, and a jet that has left the ground, are in none of the maps, over land and over water; water on the
   ground, on a slope, on a roof and below a deck is, with all of its volume. */
static void maps_are_of_standing_water(void **state)
{
    (void)state;
    static const double cells[] = {0.13, 0.5, 1, 2};
    for (int k = 0; k < 8; k++) {
        const double cell = cells[k / 2];
        const int dimensions = 2 + k % 2;
        fake_world world;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, -1), sb_vec(60, 8, 30));
        add_rectangle(&world, SB_ROLE_TERRAIN, sb_vec(0, -1, 0), sb_vec(40, 9, 0));
        add_rectangle(&world, SB_ROLE_TERRAIN, sb_vec(40, -1, 0), sb_vec(60, 9, 10)); /* a slope of 1 : 2 */
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(20, -1, 6), sb_vec(30, 9, 6));    /* a deck */
        fake_fill(&world, sb_vec(1, 1, 0), sb_vec(10, 7, 4), 0, 0, 0.2, 1);
        fake_fill(&world, sb_vec(20, 1, 0), sb_vec(24, 7, 2), 0, 0, 0.2, 2);   /* below the deck */
        fake_fill(&world, sb_vec(26, 1, 6), sb_vec(30, 7, 7.5), 0, 0, 0.2, 3); /* on it */
        for (double x = 40.25; x < 60; x += 0.5)
            for (double y = 1.25; y < (dimensions == 2 ? 1.5 : 7); y += 0.5)
                fake_add(&world.sim, sb_vec(x, dimensions == 2 ? 0 : y, 0.5 * (x - 40) + 0.25), sb_vec(0, 0, 0), 0);
        const double standing = 9 * 4 + 4 * 2 + 4 * 1.5 + 20 * 0.5;
        /* In the air: a drop over each, and a jet of 3 m whose foot is 2 m above the ground. */
        for (double x = 1.25; x < 60; x += 4)
            fake_add(&world.sim, sb_vec(x, dimensions == 2 ? 0 : 4, 16), sb_vec(9, 0, 0), 0);
        fake_fill(&world, sb_vec(14, 1, 2), sb_vec(15, 7, 5), 0, 0, 0, 4);
        world.scene.measure.map = (sb_map){true, 0, 0, 60, 8, cell, 0.4};
        sb_measure_view view = fake_view(&world);
        sb_map_field *map;
        assert_int_equal(sb_map_create(&view, &world.model, &map, NULL), SB_OK);
        const sb_map_record *result = sb_map_result(map);
        double volume = 0;
        for (size_t i = 0; i < result->columns * result->rows; i++) {
            const double x = ((double)(i % result->columns) + 0.5) * cell;
            const bool land = (x > 10.5 + cell && x < 19.5 - cell) || (x > 30.5 + cell && x < 39.5 - cell);
            if (land) assert_true(isnan(result->depth[i]) && isnan(result->speed[i]) && isnan(result->arrival[i]));
            if (!isnan(result->speed[i])) assert_true(result->speed[i] == 0);
            if (!isnan(result->depth[i]))
                volume += (double)result->depth[i] * fmin(cell, 60 - x + cell / 2) *
                          (dimensions == 2 ? 1 : fmin(cell, 8 - (double)(i / result->columns) * cell));
        }
        /* The ground: bare land, neither below water at the start nor below the deck. */
        for (size_t i = 0; i < result->columns * result->rows; i++) {
            const double x = ((double)(i % result->columns) + 0.5) * cell;
            if (x > 11 + cell && x < 19 - cell) assert_true(result->ground[i] == 0);
            if (x > 1 && x < 10 && dimensions == 2) assert_true(isnan(result->ground[i]));
            if (x > 20 && x < 30) assert_true(isnan(result->ground[i]));
            if (x > 31 + cell && x < 39.5 - cell) assert_true(result->ground[i] == 0);
        }
        const double whole = standing * (dimensions == 2 ? 1 : 6);
        if (fabs(volume - whole) > 1e-3 * whole)
            fail_msg("cells of %g m in %d dimensions: %g of %g", cell, dimensions, volume, whole);
        sb_map_destroy(map);
        free_bodies(&world);
        fake_world_free(&world);
    }
}

static sb_map_field *map_of(fake_world *world, double columns, double cell)
{
    const double rows = world->scene.dimensions == 2 ? 1 : 8;
    world->scene.measure.map = (sb_map){true, 0, 0, columns, rows, cell, 0.4};
    sb_measure_view view = fake_view(world);
    sb_map_field *map;
    assert_int_equal(sb_map_create(&view, &world->model, &map, NULL), SB_OK);
    return map;
}

/* Dry ground in cells of 0.5 m, with a paddle at x = 4 to 6, a dam with faces of 65 degrees at x = 28 to 30.8, and a
   slab at x = 34 to 36. In between, a sea stands over a dam with faces of 70 degrees. */
static void moving_and_steep_bodies_are_no_bare_ground(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const double slope = tan(M_PI * 70 / 180), run = 6 / slope, steep = 1.4 * tan(M_PI * 65 / 180);
        fake_world world;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, -1), sb_vec(40, 8, 30));
        add_rectangle(&world, SB_ROLE_TERRAIN, sb_vec(0, -1, 0), sb_vec(40, 9, 0));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(4, -1, 3), sb_vec(6, 9, 3));
        world.model.bodies[1].wavemaker = 0;
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(16 - run, -1, 0), sb_vec(16, 9, 6));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(16, -1, 6), sb_vec(18, 9, 6));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(18, -1, 6), sb_vec(18 + run, 9, 0));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(28, -1, 0), sb_vec(29.4, 9, steep));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(29.4, -1, steep), sb_vec(30.8, 9, 0));
        add_rectangle(&world, SB_ROLE_SOLID, sb_vec(34, -1, 2), sb_vec(36, 9, 2));
        for (double x = 10.25; x < 24; x += 0.5)
            for (double y = dimensions == 2 ? 0 : 0.25; y < (dimensions == 2 ? 0.1 : 8); y += 0.5)
                for (double z = 0.25; z < 8; z += 0.5)
                    if (z > slope * (x - 16 + run) || z > slope * (18 + run - x) || z > 6)
                        fake_add(&world.sim, sb_vec(x, y, z), sb_vec(0, 0, 0), 0);
        sb_map_field *map = map_of(&world, 40, 0.5);
        const sb_map_record *result = sb_map_result(map);
        double volume = 0;
        for (size_t i = 0; i < result->columns * result->rows; i++) {
            const double x = ((double)(i % result->columns) + 0.5) * 0.5;
            const bool covered = (x > 4 && x < 6) || (x > 9.5 && x < 24.5) || (x > 28 && x < 31) || (x > 34 && x < 36);
            if (covered && !isnan(result->ground[i])) fail_msg("%d dimensions: bare at x = %g", dimensions, x);
            if (!covered && result->ground[i] != 0) fail_msg("%d dimensions: no ground at x = %g", dimensions, x);
            if (!isnan(result->depth[i])) volume += (double)result->depth[i] * (dimensions == 2 ? 0.5 : 0.25);
        }
        const double particles = (double)world.sim.report.fluid_count * (dimensions == 2 ? 0.25 : 0.125);
        if (fabs(volume - particles) > 1e-3 * particles) fail_msg("%g of %g", volume, particles);
        sb_map_destroy(map);
        free_bodies(&world);
        fake_world_free(&world);
    }
}

/* In a cell wider than h half a layer is judged in that cell and those around it. */
static void films_in_wide_cells(void **state)
{
    (void)state;
    static const double apart[] = {1.25, 0.6};
    for (int k = 0; k < 2; k++) {
        fake_world world;
        fake_world_make(&world, 3, 0.5, sb_vec(0, 0, 0), sb_vec(20, 8, 10));
        for (double x = 0.25; x < 20; x += apart[k])
            for (double y = 0.25; y < 8; y += apart[k]) fake_add(&world.sim, sb_vec(x, y, 0.25), sb_vec(0, 0, 0), 0);
        sb_map_field *map = map_of(&world, 20, 2);
        const sb_map_record *result = sb_map_result(map);
        for (size_t i = 0; i < result->columns * result->rows; i++) assert_true((isnan(result->depth[i]) ? 0 : 1) == k);
        sb_map_destroy(map);
        fake_world_free(&world);
    }
}

/* A map that is loaded has the ground of the start, not that which is dry when the run continues, and all values. */
static void a_loaded_map_has_the_ground_of_the_start(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 0.5, sb_vec(0, 0, -1), sb_vec(20, 4, 10));
    add_rectangle(&world, SB_ROLE_TERRAIN, sb_vec(0, -1, 0), sb_vec(20, 5, 0));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 4, 3), 0, 0, 0, 1);
    drift(&world.sim, sb_vec(2, 0, 0));
    world.scene.measure.map = (sb_map){true, 0, 0, 20, 4, 1, 1.5};
    sb_measure_view view = fake_view(&world);
    sb_map_field *map, *loaded;
    sb_archive_out out = {0};
    sb_archive_in in;
    assert_int_equal(sb_map_create(&view, &world.model, &map, NULL), SB_OK);
    for (int k = 0; k < 200; k++) {
        fake_step(&world.sim, 0.02);
        sb_map_step(map, &world.sim);
    }
    sb_archive_begin(&out, "TEST", 1);
    sb_archive_section(&out, "map");
    sb_map_save(map, &out);
    assert_int_equal(sb_archive_close(&out, NULL), SB_OK);
    view = fake_view(&world);
    assert_int_equal(sb_map_create(&view, &world.model, &loaded, NULL), SB_OK);
    const sb_map_record *a = sb_map_result(map), *b = sb_map_result(loaded);
    assert_true(isnan(a->ground[2]) && a->ground[10] == 0 && b->ground[2] == 0 && isnan(b->ground[10]));
    assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, NULL), SB_OK);
    assert_int_equal(sb_archive_enter(&in, "map", NULL), SB_OK);
    sb_map_load(loaded, &in);
    assert_int_equal(sb_archive_leave(&in, NULL), SB_OK);
    const size_t bytes = a->columns * a->rows * sizeof(float);
    assert_memory_equal(a->ground, b->ground, bytes);
    assert_memory_equal(a->depth, b->depth, bytes);
    assert_memory_equal(a->arrival, b->arrival, bytes);
    sb_archive_in_free(&in);
    sb_archive_out_free(&out);
    sb_map_destroy(map);
    sb_map_destroy(loaded);
    free_bodies(&world);
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
        cmocka_unit_test(maps_are_of_standing_water),
        cmocka_unit_test(moving_and_steep_bodies_are_no_bare_ground),
        cmocka_unit_test(films_in_wide_cells),
        cmocka_unit_test(a_loaded_map_has_the_ground_of_the_start),
        cmocka_unit_test(depth_of_still_water_at_faces),
        cmocka_unit_test(flow_depth_is_that_of_the_approaching_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

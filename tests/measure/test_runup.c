/* Run-up lines: which water on a line belongs to the run-up, and which is unconnected. Spacing 0.5 m, support 1 m. */
#include "fake_sim.h"

#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static const double SPACING = 0.5;

static void make_world(fake_world *world, int dimensions)
{
    fake_world_make(world, dimensions, SPACING, sb_vec(0, 0, 0), sb_vec(60, 10, 20));
}

static void fill(fake_world *world, double x0, double x1, double z0, double z1)
{
    fake_fill(world, sb_vec(x0, 0, z0), sb_vec(x1, 10, z1), 0, 0, 0, 1);
}

static void row(sb_vec3 first, sb_vec3 step, int count, fake_world *world)
{
    for (int k = 0; k < count; k++) fake_add(&world->sim, sb_madd(first, k, step), sb_vec(0, 0, 0), 0);
}

static sb_runup_record read_line(fake_world *world, double from, double to)
{
    const sb_runup_line line = {"line", from, 5, to, 5};
    sb_measure_view view = fake_view(world);
    sb_runup_record record = {0};
    assert_int_equal(sb_runup_read(&view, &line, NULL, &record, NULL), SB_OK);
    return record;
}

/* A sea of 20 m and, 10 m behind it, a puddle that is as long as the sea on the line, and higher. */
static void a_puddle_is_not_the_runup(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        /* The line starts in the sea, at its edge, just ahead of it and well ahead of it. */
        static const double from[] = {10, 20, 20.5, 25};
        fake_world world;
        make_world(&world, dimensions);
        fill(&world, 0, 20, 0, 2);
        fill(&world, 30, 45, 4, 5);
        for (int k = 0; k < 4; k++) {
            const sb_runup_record r = read_line(&world, from[k], 55);
            assert_true(fabs(r.front - fmax(20 - from[k], 0)) < 1e-9);
            assert_true(fabs(r.apart - 15) < 1e-9);
            if (k < 3) assert_true(fabs(r.place.z - 2) < 1e-9);
            if (k == 3) assert_true(isnan(r.place.z));
        }
        fake_world_free(&world);
    }
}

/* The ends of a line may lie far beyond the domain: its parts there are skipped, and the water is found. */
static void a_line_may_end_far_beyond_the_domain(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        make_world(&world, dimensions);
        fill(&world, 0, 20, 0, 2);
        const sb_runup_record near = read_line(&world, 10, 55), far = read_line(&world, 10, 1e12);
        assert_true(near.front == 10 && far.front == near.front);
        assert_true(far.place.x == near.place.x && far.place.z == near.place.z);
        assert_true(fabs(read_line(&world, -1e12, 55).front - 1e12 - 20) < 1e-3);
        assert_true(isnan(read_line(&world, 1e11, 1e12).front));
        fake_world_free(&world);
    }
}

/* Water that comes from before the line counts. A puddle that it meets belongs to the run-up from then on. */
static void a_line_on_land_is_empty_until_the_sea_arrives(void **state)
{
    (void)state;
    static const double extent[] = {20, 24.5, 26, 29, 29.5, 30};
    for (int k = 0; k < 6; k++) {
        fake_world world;
        make_world(&world, 2);
        fill(&world, 0, extent[k], 0, 1);
        fill(&world, 30, 45, 0, 1);
        const sb_runup_record r = read_line(&world, 25, 55);
        const double gap = 30 - extent[k] + SPACING; /* between particles */
        assert_true(fabs(r.front - (gap < 1 ? 20 : fmax(extent[k] - 25, 0))) < 1e-9);
        assert_true(fabs(r.apart - (gap < 1 ? 0 : 15)) < 1e-9);
        fake_world_free(&world);
    }
}

static void no_water_is_an_empty_row(void **state)
{
    (void)state;
    fake_world world;
    make_world(&world, 3);
    sb_runup_record r = read_line(&world, 5, 55);
    assert_true(isnan(r.place.z) && isnan(r.front) && r.apart == 0);
    fill(&world, 0, 20, 0, 2);
    r = read_line(&world, 30, 55);
    assert_true(isnan(r.place.z) && isnan(r.front) && r.apart == 0);
    fake_add(&world.sim, sb_vec(40, 5, 3), sb_vec(0, 0, 0), 0);
    r = read_line(&world, 30, 55);
    assert_true(isnan(r.place.z) && r.front == 0 && fabs(r.apart - SPACING) < 1e-9);
    fake_world_free(&world);
}

/* A film one layer thick, in 3D a few particles wide: a gap smaller than the support radius does not end it. */
static void a_gap_within_the_support_radius_does_not_count(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int torn = 0; torn < 2; torn++) {
            const double first = 19.75 + (torn ? 1.05 : 0.95);
            fake_world world;
            make_world(&world, dimensions);
            fill(&world, 0, 20, 0, 0.5);
            for (int j = 0; j < (dimensions == 3 ? 4 : 1); j++)
                row(sb_vec(first, dimensions == 3 ? 4.25 + 0.5 * j : 0, 0.25), sb_vec(SPACING, 0, 0), 8, &world);
            const double end = first + 3.75;
            const sb_runup_record r = read_line(&world, 10, 55);
            assert_true(fabs(r.front - (torn ? 10 : end - 10)) < 1e-9);
            assert_true(fabs(r.apart - (torn ? 4 : 0)) < 1e-9);
            fake_world_free(&world);
        }
}

/* Water behind a wall 2 m thick and as high as the sea is unconnected until water stands over the wall. */
static void a_splash_over_a_wall_is_unconnected_until_water_is_over_it(void **state)
{
    (void)state;
    for (int over = 0; over < 2; over++) {
        fake_world world;
        make_world(&world, 3);
        fill(&world, 0, 20, 0, 3);
        fill(&world, 22, 26, 0, 3);
        fake_add(&world.sim, sb_vec(21, 5, 5), sb_vec(5, 0, 0), 0); /* a drop in flight */
        if (over) fill(&world, 0, 26, 3, 3.5);
        const sb_runup_record r = read_line(&world, 10, 55);
        assert_true(fabs(r.front - (over ? 16 : 10)) < 1e-9);
        assert_true(fabs(r.apart - (over ? 0 : 4.5)) < 1e-9);
        fake_world_free(&world);
    }
}

/* A random film of a fifth of a layer ahead of two layers: for some seeds it is connected over metres. It never belongs
   to the run-up, except within a support radius. */
static void a_film_too_thin_does_not_move_the_front(void **state)
{
    (void)state;
    double apart = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        fake_world world;
        make_world(&world, 3);
        fill(&world, 0, 20, 0, 1);
        for (uint64_t i = 0; i < 160; i++) /* 20 m by 10 m */
            fake_add(&world.sim, sb_vec(20 + 20 * sb_random(seed, 2 * i), 10 * sb_random(seed, 2 * i + 1), 0.25),
                     sb_vec(0, 0, 0), 0);
        const sb_runup_record r = read_line(&world, 10, 55);
        print_message("front %.2f m, apart %.2f m\n", r.front, r.apart);
        assert_true(r.front >= 10 && r.front < 10 + 2 + 2 * SPACING);
        apart += r.apart / 30;
        fake_world_free(&world);
    }
    assert_true(apart > 5);
}

/* Where two parts of the line meet, 0.2 m ahead of the two layers, the film's particles count once. */
static void parts_of_a_line_count_no_particle_twice(void **state)
{
    (void)state;
    fake_world world;
    make_world(&world, 3);
    fill(&world, 0, 20, 0, 1);
    for (double x = 20.5; x < 30; x += 0.9)
        for (double y = 0.5; y < 10; y += 0.9) fake_add(&world.sim, sb_vec(x, y, 0.25), sb_vec(0, 0, 0), 0);
    const sb_runup_record r = read_line(&world, 10, 31.4);
    assert_true(fabs(r.front - 11.65) < 1e-9); /* the first row is surrounded by the sea and connects the second */
    fake_world_free(&world);
}

/* No water before the first end; the nearest water is 0.85 m ahead, and a puddle is larger. */
static void a_line_starts_in_water_within_the_support_radius(void **state)
{
    (void)state;
    fake_world world;
    make_world(&world, 2);
    fill(&world, 10, 20, 0, 1);
    fill(&world, 30, 50, 0, 1);
    const sb_runup_record r = read_line(&world, 9.4, 55);
    assert_true(fabs(r.front - 10.6) < 1e-9);
    assert_true(fabs(r.apart - 20) < 1e-9);
    fake_world_free(&world);
}

/* A pillar that is wider than the strip around the front: the water beside it is connected around it. */
static void water_beside_a_line_connects_around_a_gap(void **state)
{
    (void)state;
    fake_world world;
    make_world(&world, 3);
    for (double x = 0.25; x < 30; x += SPACING)
        for (double y = 0.25; y < 10; y += SPACING)
            for (double z = 0.25; z < 2; z += SPACING)
                if (!(x > 18 && x < 20.5 && y > 3.9 && y < 6.1))
                    fake_add(&world.sim, sb_vec(x, y, z), sb_vec(0, 0, 0), 0);
    const sb_runup_record r = read_line(&world, 10, 55);
    assert_true(fabs(r.front - 20) < 1e-9);
    assert_true(r.apart == 0);
    fake_world_free(&world);
}

/* An oblique line is read in parts; each particle counts once. */
static void an_oblique_line_is_read_like_any_other(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, SPACING, sb_vec(0, 0, 0), sb_vec(60, 60, 20));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(40, 60, 1), 0, 0, 0, 1);
    fake_fill(&world, sb_vec(48, 0, 0), sb_vec(60, 60, 1), 0, 0, 0, 1);
    const sb_runup_line line = {"line", 1, 1, 59, 59};
    sb_measure_view view = fake_view(&world);
    sb_runup_record r;
    assert_int_equal(sb_runup_read(&view, &line, NULL, &r, NULL), SB_OK);
    /* The edges cross the line at 45 degrees: particles a spacing to one side of it are a spacing ahead. */
    assert_true(fabs(r.front - 39 * sqrt(2)) <= 2 * SPACING);
    assert_true(fabs(r.apart - 11 * sqrt(2)) <= 2 * SPACING);
    assert_true(fabs(r.place.z - 1) < 1e-9);
    fake_world_free(&world);
}

/* The run-up along the line from x = 2 to 55, with what is wetted by the model's boundary particles. */
static sb_runup_record read_with_shore(fake_world *world)
{
    const sb_runup_line line = {"line", 2, 5, 55, 5};
    sb_measure_view view = fake_view(world);
    sb_runup_record r = {0};
    sb_shore shore = {0};
    assert_int_equal(sb_shore_find(&world->scene, &world->model, &line, &shore, NULL), SB_OK);
    assert_int_equal(sb_runup_read(&view, &line, &shore, &r, NULL), SB_OK);
    sb_shore_free(&shore);
    return r;
}

/* Water 2 m deep, with the crest of a wave at x = 10, before a wall with its face at x = 30 and its crest at z = 4. Of
   a jet 10 m high at the face, which is connected, what is within 1.5 spacings of the wall has wetted it. A paddle is
   no shore. */
static void a_jet_beyond_a_wall_is_not_the_runup(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const int dimensions = 2 + k % 2;
        const double jet = k < 2 ? 10 : 3.5;
        fake_world world;
        make_world(&world, dimensions);
        sb_vec3 points[3000], normals[3000] = {{0, 0, 0}};
        size_t count = 0;
        for (double y = dimensions == 2 ? 0 : 0.25; y < (dimensions == 2 ? 0.1 : 10); y += 0.5) {
            for (double x = 0.25; x < 30; x += 0.5) points[count++] = sb_vec(x, y, 0);
            for (double z = 0.25; z < 4; z += 0.5) points[count++] = sb_vec(30, y, z);
        }
        const size_t still = count;
        for (double z = 0.25; z < 12; z += 0.5) points[count++] = sb_vec(29.5, dimensions == 2 ? 0 : 5, z);
        sb_model_body bodies[2] = {{.begin = 0, .count = still, .wavemaker = -1},
                                   {.begin = still, .count = count - still, .wavemaker = 0}};
        world.model.body_count = 2;
        world.model.bodies = bodies;
        world.model.wall_position = points;
        world.model.wall_normal = normals;
        fill(&world, 0, 30, 0, 2);
        fill(&world, 10, 12, 2, 9);
        fill(&world, 28, 30, 2, jet);
        const sb_runup_record r = read_with_shore(&world);
        if (k < 2) assert_true(r.place.z > 4 && r.place.z <= 4 + 2 * SPACING);
        if (k >= 2) assert_true(fabs(r.place.z - jet) < 1e-9);
        assert_true(r.place.x > 29 && fabs(r.front - 28) < 1e-9);
        fake_world_free(&world);
    }
}

/* A flow of six layers over flat land, whose boundary particles lie one or two spacings below it. What is more than 1.5
   spacings above the land does not wet it, whatever h is. Where there is no land at all, nothing wets it. */
static void the_upper_layers_of_a_flow_do_not_wet_the_land(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        const int dimensions = 2 + k % 2;
        const double offset = k < 4 ? (1 + k / 2) : 1;
        fake_world world;
        make_world(&world, dimensions);
        world.scene.numerics.support = 2.75;
        world.scene.numerics.wall_offset = offset;
        sb_vec3 points[3000], normals[3000];
        size_t count = 0;
        for (double y = dimensions == 2 ? 0 : 0.2; y < (dimensions == 2 ? 0.1 : 10); y += 0.4)
            for (double x = 0.2; x < 30; x += 0.4) {
                points[count] = sb_vec(x, y, -offset * SPACING);
                normals[count++] = sb_vec(0, 0, 1);
            }
        sb_model_body body = {.begin = 0, .count = k < 4 ? count : 0, .wavemaker = -1};
        world.model.body_count = 1;
        world.model.bodies = &body;
        world.model.wall_position = points;
        world.model.wall_normal = normals;
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(20, 10, 3), 0, 0, 0.2, 1);
        const sb_runup_record r = read_with_shore(&world);
        if (k < 4) assert_true(r.place.z > 0.5 && r.place.z <= 2 * SPACING);
        if (k >= 4) assert_true(isnan(r.place.z));
        assert_true(fabs(r.front - 18) < 0.2);
        fake_world_free(&world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_puddle_is_not_the_runup),
        cmocka_unit_test(a_line_may_end_far_beyond_the_domain),
        cmocka_unit_test(a_line_on_land_is_empty_until_the_sea_arrives),
        cmocka_unit_test(no_water_is_an_empty_row),
        cmocka_unit_test(a_gap_within_the_support_radius_does_not_count),
        cmocka_unit_test(a_splash_over_a_wall_is_unconnected_until_water_is_over_it),
        cmocka_unit_test(a_film_too_thin_does_not_move_the_front),
        cmocka_unit_test(parts_of_a_line_count_no_particle_twice),
        cmocka_unit_test(a_line_starts_in_water_within_the_support_radius),
        cmocka_unit_test(water_beside_a_line_connects_around_a_gap),
        cmocka_unit_test(a_jet_beyond_a_wall_is_not_the_runup),
        cmocka_unit_test(the_upper_layers_of_a_flow_do_not_wet_the_land),
        cmocka_unit_test(an_oblique_line_is_read_like_any_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Tests models with periodic sides: there are no walls there, and water and boundary particles continue across them. */
#include "check.h"
#include "geometry/model/model.h"

#include <stdio.h>
#include <string.h>

enum { BODIES = 4 };

static sb_scene scene;
static sb_body bodies[BODIES];
static sb_model model;

/* A flume of 20 x width x 8 m, 4 m deep, periodic in y. */
static void set_up(double width)
{
    memset(&scene, 0, sizeof scene);
    memset(bodies, 0, sizeof bodies);
    scene.dimensions = 3;
    scene.resolution = 0.5;
    scene.fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    scene.domain.max = sb_vec(20, width, 8);
    scene.domain.side[SB_Y_MIN] = scene.domain.side[SB_Y_MAX] = SB_SIDE_PERIODIC;
    scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    scene.sea = (sb_sea){true, 4, {3, width / 2, 3}};
    scene.numerics.support = 2;
    scene.numerics.wall_offset = 0.5;
    scene.numerics.wall_spacing = 1;
    scene.bodies = bodies;
}

static int tear_down(void **state)
{
    (void)state;
    sb_model_free(&model);
    return 0;
}

static void add_box(const char *name, sb_vec3 min, sb_vec3 max)
{
    sb_body *body = &bodies[scene.body_count++];
    snprintf(body->name, sizeof body->name, "%s", name);
    body->shape = SB_SHAPE_BOX;
    body->up = 'z';
    body->scale = 1;
    body->color[0] = -1;
    body->min = min;
    body->max = max;
}

static void build(void)
{
    sb_error error = {0};
    sb_model_free(&model);
    if (sb_model_build(&scene, &model, &error) != SB_OK) fail_msg("%s", error.text);
}

static size_t warnings_of(const char *text)
{
    size_t count = 0;
    for (size_t w = 0; w < model.warning_count; ++w) count += strstr(model.warnings[w], text) != 0;
    return count;
}

/* Smallest distance of two points, including images in y. */
static double closest(const sb_vec3 *point, size_t count, double width)
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < count; ++i)
        for (size_t j = 0; j < count; ++j)
            for (int k = -1; k <= 1; ++k) {
                if (i == j && k == 0) continue;
                sb_vec3 arm = sb_sub(point[i], sb_add(point[j], sb_vec(0, k * width, 0)));
                best = fmin(best, sb_norm(arm));
            }
    return best;
}

/* Checks that points lie in rows with one step from side to side. */
static void check_rows(const sb_vec3 *point, size_t count, double step)
{
    for (size_t i = 0; i < count; ++i) {
        double row = point[i].y / step - 0.5;
        assert_near(row, nearbyint(row), 1e-6);
        assert_true(point[i].y > 0 && point[i].y < scene.domain.max.y);
    }
}

static void a_flume_has_rows_across(void **state)
{
    (void)state;
    const double widths[] = {2, 3.5, 2.07, 4.8};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; ++w) {
        double rows = nearbyint(widths[w] / 0.5), step = widths[w] / rows;
        set_up(widths[w]);
        build();
        printf("%g m wide: %zu fluid, %zu boundary particles\n", widths[w], model.fluid_count, model.wall_count);
        check_rows(model.wall_position, model.wall_count, step);
        check_rows(model.fluid_position, model.fluid_count, step);
        for (size_t b = 0; b < model.wall_count; ++b) assert_near(model.wall_normal[b].y, 0, 1e-9);
        /* The floor with its rims, and two walls of 16 rows. */
        assert_int_equal(model.wall_count, (size_t)rows * (42 + 2 * 16));
        assert_near((double)model.fluid_count * 0.125, 20 * widths[w] * 4, 0.5);
        assert_true(closest(model.wall_position, model.wall_count, widths[w]) > 0.7 * 0.5);
        assert_true(closest(model.fluid_position, model.fluid_count, widths[w]) > 0.7 * 0.5);
        assert_int_equal(warnings_of("periodic"), 0);
    }
}

/* Counts the boundary particles on lattices, without those between the sill and the floor below it. If the offset is
   not a half, lattices do not meet at edges, and only those of the sill's top are counted. */
static size_t regular(sb_vec3 *point)
{
    size_t count = 0;
    for (size_t b = 0; b < model.wall_count; ++b) {
        sb_vec3 p = model.wall_position[b];
        bool below = p.x > 10.1 && p.x < 12.9 && p.z < 0.6;
        bool top = p.x > 10.6 && p.x < 12.4 && p.z > 1.5;
        if (scene.numerics.wall_offset == 0.5 ? below : !top) continue;
        assert_near(model.wall_normal[b].y, 0, 1e-9);
        point[count++] = p;
    }
    return count;
}

/* A sill across the flume gives the same particles whether it ends at the sides or continues beyond them. */
static void a_sill_continues_across_sides(void **state)
{
    (void)state;
    static sb_vec3 point[2][4000];
    size_t count[2];
    for (int paper = 0; paper <= 1; ++paper) {
        for (int beyond = 0; beyond <= 1; ++beyond) {
            double more = beyond ? 3 : 0;
            set_up(2);
            scene.numerics.wall_offset = paper ? 0.6 : 0.5;
            add_box("sill", sb_vec(10, -more, 0), sb_vec(13, 2 + more, 2));
            build();
            assert_true(model.wall_count < 4000);
            count[beyond] = regular(point[beyond]);
            check_rows(point[beyond], count[beyond], 0.5);
            assert_int_equal(warnings_of("periodic"), 0);
        }
        printf("sill: %zu and %zu particles\n", count[0], count[1]);
        assert_int_equal(count[0], count[1]);
        assert_true(count[0] >= 4 * 4);
        for (size_t b = 0; b < count[0]; ++b) {
            double nearest = HUGE_VAL;
            for (size_t k = 0; k < count[1]; ++k) nearest = fmin(nearest, sb_norm(sb_sub(point[0][b], point[1][k])));
            assert_near(nearest, 0, 1e-6);
        }
    }
}

/* In 2D along x: a bed from side to side is one row, with no particles at its ends. */
static void a_flat_bed_continues_across_sides(void **state)
{
    (void)state;
    set_up(2);
    scene.dimensions = 2;
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_PERIODIC;
    scene.sea.seed.y = 0;
    add_box("bed", sb_vec(0, -1, 0), sb_vec(20, 1, 1));
    build();
    size_t top = 0;
    for (size_t b = 0; b < model.wall_count; ++b) {
        sb_vec3 p = model.wall_position[b];
        double column = p.x / 0.5 - 0.5;
        assert_near(fabs(model.wall_normal[b].z), 1, 1e-9);
        if (p.z < 0.5) continue;
        assert_near(column, nearbyint(column), 1e-6);
        ++top;
    }
    assert_int_equal(top, 40);
    assert_int_equal(model.fluid_count, 40 * 6);
    assert_int_equal(warnings_of("periodic"), 0);
}

static void a_sea_is_filled_across_sides(void **state)
{
    (void)state;
    set_up(6);
    /* The part with the seed and the other part are connected across the sides only. */
    add_box("dike", sb_vec(0, 2, 0), sb_vec(20, 2.5, 8));
    scene.sea.seed = sb_vec(3, 1, 3);
    build();
    assert_near((double)model.fluid_count * 0.125, 20 * 5.5 * 4, 1);
    scene.domain.side[SB_Y_MIN] = scene.domain.side[SB_Y_MAX] = SB_SIDE_WALL;
    build();
    assert_near((double)model.fluid_count * 0.125, 20 * 2 * 4, 1);
}

static void solids_that_do_not_continue_are_reported(void **state)
{
    (void)state;
    set_up(4);
    add_box("pillar", sb_vec(10, 3, -1), sb_vec(11, 5, 9));
    build();
    assert_int_equal(warnings_of("solids do not continue across the periodic sides in y"), 1);
    assert_int_equal(warnings_of("at 32 of 640 places, the first near (10.25, 3.99"), 1);
    for (size_t b = 0; b < model.wall_count; ++b)
        assert_true(model.wall_position[b].y >= 0 && model.wall_position[b].y < 4);
    add_box("its-other-part", sb_vec(10, -1, -1), sb_vec(11, 1, 9));
    build();
    assert_int_equal(warnings_of("periodic"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_flume_has_rows_across, tear_down),
        cmocka_unit_test_teardown(a_sill_continues_across_sides, tear_down),
        cmocka_unit_test_teardown(a_flat_bed_continues_across_sides, tear_down),
        cmocka_unit_test_teardown(a_sea_is_filled_across_sides, tear_down),
        cmocka_unit_test_teardown(solids_that_do_not_continue_are_reported, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

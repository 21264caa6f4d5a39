/* Tests the filling with water: volumes, levels, boxes, waves, and seas that escape. */
#include "base/memory.h"
#include "geometry/model/model.h"
#include "physics/waves/wave_theory.h"

#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

enum { BODIES = 8 };

static sb_scene scene;
static sb_body bodies[BODIES];
static sb_fluid_box boxes[4];
static sb_model model;
static sb_error error;

/* A tank that is open at its top and filled from its middle. */
static int set_up(void **state)
{
    (void)state;
    memset(&scene, 0, sizeof scene);
    memset(bodies, 0, sizeof bodies);
    memset(boxes, 0, sizeof boxes);
    memset(&error, 0, sizeof error);
    scene.dimensions = 3;
    scene.resolution = 0.5;
    scene.fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    scene.domain.min = sb_vec(0, 0, 0);
    scene.domain.max = sb_vec(20, 10, 8);
    scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    scene.sea = (sb_sea){true, 4, {10, 5, 3}};
    scene.numerics.support = 2;
    scene.numerics.wall_offset = 0.5;
    scene.numerics.wall_spacing = 1;
    scene.bodies = bodies;
    scene.boxes = boxes;
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    sb_model_free(&model);
    return 0;
}

static sb_body *add(const char *name, sb_shape shape)
{
    sb_body *body = &bodies[scene.body_count++];
    snprintf(body->name, sizeof body->name, "%s", name);
    body->shape = shape;
    body->up = 'z';
    body->scale = 1;
    body->color[0] = -1;
    return body;
}

static void add_box(const char *name, sb_vec3 min, sb_vec3 max)
{
    sb_body *body = add(name, SB_SHAPE_BOX);
    body->min = min;
    body->max = max;
}

static void build(void)
{
    sb_model_free(&model);
    sb_status status = sb_model_build(&scene, &model, &error);
    if (status != SB_OK) print_message("%s\n", error.text);
    assert_int_equal(status, SB_OK);
}

static double volume(void)
{
    double s = scene.resolution;
    return (double)model.fluid_count * (scene.dimensions == 2 ? s * s : s * s * s);
}

static void volume_within(double expected, double share)
{
    if (fabs(volume() - expected) > share * expected) print_message("volume %g, expected %g\n", volume(), expected);
    assert_true(fabs(volume() - expected) <= share * expected);
}

static void refuse(const char *first, const char *second)
{
    sb_model untouched = {.fluid_count = 77};
    assert_int_equal(sb_model_build(&scene, &untouched, &error), SB_BAD_INPUT);
    assert_int_equal(untouched.fluid_count, 77);
    if (!strstr(error.text, first) || !strstr(error.text, second)) print_message("%s\n", error.text);
    assert_non_null(strstr(error.text, first));
    assert_non_null(strstr(error.text, second));
}

/* Smallest distance between two particles. */
static double closest(void)
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < model.fluid_count; ++i)
        for (size_t j = i + 1; j < model.fluid_count; ++j) {
            sb_vec3 arm = sb_sub(model.fluid_position[i], model.fluid_position[j]);
            best = fmin(best, sb_dot(arm, arm));
        }
    return sqrt(best);
}

static void a_tank_is_filled_with_a_lattice(void **state)
{
    (void)state;
    build();
    assert_int_equal(model.fluid_count, 40 * 20 * 8);
    assert_true(fabs(model.still_depth - 4) < 1e-12);
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        double cell = (p.x / 0.5) - floor(p.x / 0.5);
        assert_true(fabs(cell - 0.5) < 1e-9);
        assert_true(fabs(model.fluid_pressure[i] - 1000 * 9.81 * (4 - p.z)) < 1e-6);
        assert_true(sb_norm(model.fluid_velocity[i]) == 0);
    }
}

static void odd_levels_keep_volume_and_surface(void **state)
{
    (void)state;
    for (double level = 1.07; level < 7; level += 0.61) {
        scene.sea.level = level;
        scene.sea.seed.z = 0.5;
        build();
        volume_within(200 * level, 0.005);
        double top = 0;
        for (size_t i = 0; i < model.fluid_count; ++i) top = fmax(top, model.fluid_position[i].z);
        assert_true(top < level && top > level - 0.75 * scene.resolution);
    }
}

static void odd_walls_keep_volume(void **state)
{
    (void)state;
    scene.domain.min = sb_vec(-0.3, 0.11, -1.13);
    scene.domain.max = sb_vec(7.05, 6.2, 8);
    scene.sea = (sb_sea){true, 2.3, {2, 2, 1}};
    build();
    volume_within(7.35 * 6.09 * 3.43, 0.01);
}

static void solids_displace_water(void **state)
{
    (void)state;
    add_box("pillar", sb_vec(5.2, 3.1, -1), sb_vec(8.3, 6.7, 9));
    add_box("step 1", sb_vec(12, -1, -1), sb_vec(21, 11, 1.3));
    add_box("step 2", sb_vec(15, -1, -1), sb_vec(21, 11, 2.6));
    add_box("hidden", sb_vec(16, 2, 0.2), sb_vec(18, 4, 1.1));
    build();
    double expected = 800 - 3.1 * 3.6 * 4 - 3 * 10 * 1.3 - 5 * 10 * 2.6;
    volume_within(expected, 0.01);
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        assert_false(p.x > 5.2 && p.x < 8.3 && p.y > 3.1 && p.y < 6.7);
        assert_false(p.x > 12 && p.z < 1.3);
        assert_false(p.x > 15 && p.z < 2.6);
        /* No particle starts nearer than 0.3 spacings to a face. */
        assert_false(p.x > 5.2 - 0.149 && p.x < 8.3 + 0.149 && p.y > 3.1 && p.y < 6.7);
    }
}

/* Straight walls anywhere between two rows of columns. */
static void walls_between_columns_keep_volume(void **state)
{
    (void)state;
    static const double faces[] = {0.05, 0.13, 0.2, 0.32, 0.41};
    for (int k = 0; k < 5; k++) {
        const double face = faces[k], other = 18.9 + face * face;
        scene.body_count = 0;
        add_box("low", sb_vec(-1, -1, -1), sb_vec(face, 11, 9));
        add_box("high", sb_vec(other, -1, -1), sb_vec(21, 11, 9));
        build();
        volume_within((other - face) * 10 * 4, 0.002);
    }
}

static void a_wedge_over_a_slope_has_its_volume(void **state)
{
    (void)state;
    /* A beach of 1:4 from x = 4 up to the shore at x = 20. */
    sb_body *beach = add("beach", SB_SHAPE_BOX);
    beach->min = sb_vec(0, -6, -10);
    beach->max = sb_vec(40, 6, 0);
    beach->rotate = sb_vec(0, -atan(0.25) * 180 / M_PI, 0);
    beach->translate = sb_vec(4, 5, 0);
    build();
    volume_within(10 * (4 * 4 + 0.5 * 16 * 4), 0.01);
}

static void a_basin_and_a_round_pool(void **state)
{
    (void)state;
    sb_body *basin = add("basin", SB_SHAPE_BASIN);
    basin->min = sb_vec(2, 1, 1);
    basin->max = sb_vec(18, 9, 7);
    build();
    volume_within(16 * 8 * 3, 0.01);
    set_up(NULL);
    sb_body *pile = add("pile", SB_SHAPE_CYLINDER);
    pile->center = sb_vec(10, 5, -1);
    pile->radius = 3;
    pile->height = 10;
    scene.sea.seed = sb_vec(2, 5, 3);
    build();
    volume_within(800 - M_PI * 9 * 4, 0.01);
}

static void a_wall_thinner_than_a_cell_holds_the_sea(void **state)
{
    (void)state;
    add_box("dam", sb_vec(9.9, -1, -1), sb_vec(10.16, 11, 9));
    scene.sea.seed = sb_vec(5, 5, 3);
    build();
    volume_within(9.9 * 10 * 4, 0.02);
    for (size_t i = 0; i < model.fluid_count; ++i) assert_true(model.fluid_position[i].x < 9.9);
    /* With an opening in the dam the sea is on both sides. */
    bodies[0].max.y = 8;
    build();
    volume_within(800, 0.02);
}

static void a_sea_that_escapes_is_refused_with_the_place(void **state)
{
    (void)state;
    scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    refuse("escapes", "x_max");
    assert_non_null(strstr(error.text, "(20, "));
    add_box("dam", sb_vec(18, -1, -1), sb_vec(18.26, 11, 9));
    build();
    volume_within(720, 0.02);
    scene.domain.side[SB_Z_MIN] = SB_SIDE_OPEN;
    refuse("escapes", "z_min");
}

static void bad_seeds_are_refused(void **state)
{
    (void)state;
    scene.sea.seed = sb_vec(10, 5, 1);
    add_box("pier", sb_vec(9, 4, 0), sb_vec(11, 6, 5));
    refuse("water.seed", "\"pier\"");
}

static void boxes_have_level_and_velocity(void **state)
{
    (void)state;
    scene.sea.present = false;
    boxes[0] = (sb_fluid_box){{0, 0, 0}, {5, 10, 6}, 3.2, {1, 0, 0.5}};
    scene.box_count = 1;
    build();
    volume_within(5 * 10 * 3.2, 0.005);
    assert_true(fabs(model.still_depth - 3.2) < 1e-9);
    for (size_t i = 0; i < model.fluid_count; ++i) {
        assert_true(model.fluid_velocity[i].x == 1 && model.fluid_velocity[i].z == 0.5);
        assert_true(model.fluid_position[i].x < 5);
    }
    /* A second box that shares half of the first, and a solid block in it. */
    boxes[1] = (sb_fluid_box){{2.5, 0, 0}, {10, 10, 6}, 3.2, {0, 0, 0}};
    scene.box_count = 2;
    add_box("block", sb_vec(7, 2, -1), sb_vec(9, 4, 7));
    build();
    volume_within((10 * 10 - 4) * 3.2, 0.01);
    assert_true(closest() > 0.69 * scene.resolution);
}

static void a_box_on_the_sea(void **state)
{
    (void)state;
    boxes[0] = (sb_fluid_box){{0, 0, 2}, {5, 10, 6}, 6, {0, 0, 0}};
    scene.box_count = 1;
    build();
    volume_within(800 + 5 * 10 * 2, 0.01);
    assert_true(closest() > 0.69 * scene.resolution);
}

static void flumes_in_two_dimensions(void **state)
{
    (void)state;
    scene.dimensions = 2;
    scene.resolution = 0.1;
    scene.sea.level = 3.93;
    add_box("block", sb_vec(12.03, -0.5, -1), sb_vec(14.11, 0.5, 2.22));
    build();
    volume_within(20 * 3.93 - 2.08 * 2.22, 0.01);
    for (size_t i = 0; i < model.fluid_count; ++i) assert_true(model.fluid_position[i].y == 0);
    for (size_t i = 0; i < model.wall_count; ++i) assert_true(model.wall_position[i].y == 0);
}

static void a_solitary_wave_stands_on_the_sea(void **state)
{
    (void)state;
    scene.dimensions = 2;
    scene.resolution = 0.1;
    scene.domain.max = sb_vec(60, 0, 4);
    scene.sea = (sb_sea){true, 2, {10, 0, 1}};
    scene.wave =
        (sb_initial_wave){.kind = SB_INITIAL_SOLITARY, .height = 0.6, .depth = 2, .position = 30, .direction = -1};
    build();
    const sb_solitary wave = {.height = 0.6, .depth = 2, .gravity = 9.81};
    double crest = 0;
    for (int i = -300; i < 300; i++) crest += 0.1 * sb_solitary_elevation(&wave, 0.1 * i);
    volume_within(60 * 2 + crest, 0.003);
    double top = 0, worst = -1e9, best_u = 0;
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        double eta = sb_solitary_elevation(&wave, p.x - 30);
        top = fmax(top, p.z);
        worst = fmax(worst, p.z - (2 + eta));
        best_u = fmin(best_u, model.fluid_velocity[i].x);
        assert_true(model.fluid_pressure[i] >= 0);
    }
    assert_true(worst < 0 && top > 2.6 - 0.075);
    double u, w;
    sb_solitary_velocity(&wave, 0, top, &u, &w);
    assert_true(fabs(best_u + u) < 0.01 * u);
    assert_true(fabs(model.still_depth - 2) < 1e-9);
}

static void a_standing_wave_keeps_the_volume(void **state)
{
    (void)state;
    scene.resolution = 0.25;
    scene.wave = (sb_initial_wave){.kind = SB_INITIAL_STANDING, .height = 0.6, .depth = 4, .wavelength = 20};
    build();
    volume_within(800, 0.005);
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        assert_true(p.z < 4 + 0.6 * cos(2 * M_PI * p.x / 20));
    }
}

static void jitter_is_bounded_and_repeatable(void **state)
{
    (void)state;
    build();
    sb_vec3 *still = model.fluid_position;
    size_t count = model.fluid_count;
    model.fluid_position = NULL;
    scene.numerics.jitter = 0.1;
    scene.numerics.seed = 5;
    build();
    assert_int_equal(model.fluid_count, count);
    double most = 0, mean = 0;
    for (size_t i = 0; i < count; ++i) {
        sb_vec3 d = sb_sub(model.fluid_position[i], still[i]);
        most = fmax(most, fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
        mean += d.x / (double)count;
    }
    assert_true(most <= 0.05 && most > 0.045 && fabs(mean) < 0.002);
    sb_free(still);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    add_box("pillar", sb_vec(5.2, 3.1, -1), sb_vec(8.3, 6.7, 9));
    boxes[0] = (sb_fluid_box){{0, 0, 2}, {5, 10, 6}, 6, {0, 0, 0}};
    scene.box_count = 1;
    scene.numerics.jitter = 0.1;
    int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    build();
    sb_model one = model;
    memset(&model, 0, sizeof model);
    omp_set_num_threads(3);
    build();
    omp_set_num_threads(threads);
    assert_int_equal(model.fluid_count, one.fluid_count);
    assert_memory_equal(model.fluid_position, one.fluid_position, one.fluid_count * sizeof(sb_vec3));
    assert_memory_equal(model.fluid_pressure, one.fluid_pressure, one.fluid_count * sizeof(double));
    assert_int_equal(model.wall_count, one.wall_count);
    assert_memory_equal(model.wall_position, one.wall_position, one.wall_count * sizeof(sb_vec3));
    sb_model_free(&one);
}

int main(void)
{
#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CASE(a_tank_is_filled_with_a_lattice),
        CASE(odd_levels_keep_volume_and_surface),
        CASE(odd_walls_keep_volume),
        CASE(solids_displace_water),
        CASE(walls_between_columns_keep_volume),
        CASE(a_wedge_over_a_slope_has_its_volume),
        CASE(a_basin_and_a_round_pool),
        CASE(a_wall_thinner_than_a_cell_holds_the_sea),
        CASE(a_sea_that_escapes_is_refused_with_the_place),
        CASE(bad_seeds_are_refused),
        CASE(boxes_have_level_and_velocity),
        CASE(a_box_on_the_sea),
        CASE(flumes_in_two_dimensions),
        CASE(a_solitary_wave_stands_on_the_sea),
        CASE(a_standing_wave_keeps_the_volume),
        CASE(jitter_is_bounded_and_repeatable),
        CASE(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Tests whole models of small scenes: bodies, names, the inside test, and failing allocations. */
#include "small_model.h"

static void bodies_and_their_particles(void **state)
{
    (void)state;
    add_box("block", sb_vec(5, 2, 0), sb_vec(7, 4, 4))->report = true;
    add_box("gate", sb_vec(8, 0, 0), sb_vec(8.5, 6, 5));
    scene.wavemaker_count = 1;
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "gate");
    wavemaker.direction = sb_vec(1, 0, 0);
    build();
    assert_int_equal(model.body_count, 3);
    const sb_model_body *b = model.bodies;
    assert_string_equal(b[0].name, "block");
    assert_true(b[0].report && b[0].wavemaker == -1);
    assert_true(b[0].moment_point.x == 6 && b[0].moment_point.y == 3 && b[0].moment_point.z == 0);
    assert_string_equal(b[1].name, "gate");
    assert_int_equal(b[1].wavemaker, 0);
    assert_string_equal(b[2].name, "domain");
    assert_false(b[2].report);
    assert_int_equal(b[2].mesh.triangle_count, 0);
    assert_true(b[0].color[0] > 0 && b[0].color[0] != b[1].color[0]);
    assert_int_equal(b[0].begin, 0);
    assert_int_equal(b[1].begin, b[0].count);
    assert_int_equal(b[2].begin, b[1].begin + b[1].count);
    assert_int_equal(b[2].begin + b[2].count, model.wall_count);
    /* The floor with its rim, except four particles below the block, and four walls of ten rows, from half a spacing
       behind the surface on. */
    assert_int_equal(b[2].count, 22 * 14 - 4 + 10 * 2 * (22 + 14 - 2));
    for (size_t i = b[2].begin; i < model.wall_count; ++i) {
        sb_vec3 p = model.wall_position[i];
        assert_true(p.x < -0.24 || p.x > 10.24 || p.y < -0.24 || p.y > 6.24 || p.z < -0.24);
        sb_vec3 in = sb_madd(p, 2, model.wall_normal[i]);
        assert_true(sb_norm(sb_sub(in, sb_vec(5, 3, 2.5))) < sb_norm(sb_sub(p, sb_vec(5, 3, 2.5))));
    }
    sb_model alone;
    assert_int_equal(sb_model_import_bodies(&scene, &alone, &error), SB_OK);
    assert_int_equal(alone.body_count, 3);
    assert_int_equal(alone.wall_count + alone.fluid_count, 0);
    assert_int_equal(alone.bodies[0].mesh.triangle_count, 12);
    sb_model_free(&alone);
}

static void names_are_unique(void **state)
{
    (void)state;
    add_box("house", sb_vec(4, 2, 0), sb_vec(5, 3, 4));
    add_box("house", sb_vec(7, 2, 0), sb_vec(8, 3, 4));
    add_box("domain", sb_vec(9, 2, 0), sb_vec(9.5, 3, 4));
    build();
    assert_string_equal(model.bodies[1].name, "house-2");
    assert_string_equal(model.bodies[2].name, "domain");
    assert_string_equal(model.bodies[3].name, "domain-2");
}

static void a_wavemaker_needs_its_body(void **state)
{
    (void)state;
    scene.wavemaker_count = 1;
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "nobody");
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "nobody"));
}

/* A wave maker of a part has precedence over that of the whole body, in any order. */
static void parts_may_have_wavemakers_of_their_own(void **state)
{
    (void)state;
    char path[] = SB_BINARY_DIR "/test_model_parts.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int k = 0; k < 2; k++) {
        const int v = 4 * k, x = 3 + 4 * k;
        fprintf(file, "v %d 2 0\nv %d 2 0\nv %d 4 0\nv %d 2 4\n", x, x + 2, x, x);
        fprintf(file, "o %s\nf %d %d %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\n", k ? "gate" : "tower", v + 1, v + 3,
                v + 2, v + 1, v + 2, v + 4, v + 1, v + 4, v + 3, v + 2, v + 3, v + 4);
    }
    assert_int_equal(fclose(file), 0);
    static const char *const moved[2][2] = {{"plant", "gate"}, {"gate", "plant"}};
    for (int order = 0; order < 2; order++) {
        sb_wavemaker_use makers[2] = {wavemaker, wavemaker};
        for (int k = 0; k < 2; k++) {
            snprintf(makers[k].name, sizeof makers[k].name, "push-%d", k);
            snprintf(makers[k].body, sizeof makers[k].body, "%s", moved[order][k]);
            makers[k].direction = sb_vec(1, 0, 0);
        }
        scene.wavemakers = makers;
        scene.wavemaker_count = 2;
        scene.body_count = 0;
        add_file("plant", path)->split = true;
        build();
        assert_string_equal(model.bodies[0].name, "tower");
        assert_int_equal(model.bodies[0].wavemaker, order);
        assert_int_equal(model.bodies[1].wavemaker, 1 - order);
    }
    scene.wavemakers = &wavemaker;
    remove(path);
}

/* Coordinates that are not finite after rotation and scaling. */
static void bodies_without_finite_coordinates_are_refused(void **state)
{
    (void)state;
    char path[] = SB_BINARY_DIR "/test_model_nowhere.xyz";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("0 50 1\n10 50 1\n0 60 1\n10 60 1\n", file);
    assert_int_equal(fclose(file), 0);
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        scene.dimensions = dimensions;
        scene.body_count = 0;
        sb_body *body = add_file("coast", path);
        body->shape = SB_SHAPE_GRID;
        body->role = SB_ROLE_TERRAIN;
        body->scale = 1e308;
        sb_model_free(&model);
        assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
        assert_non_null(strstr(error.text, "\"coast\""));
        assert_non_null(strstr(error.text, "expected"));
    }
    remove(path);
}

/* A paddle whose face lies in the plane of the tank's end has all its particles, and so has the tank. A warning says
   that both carry the load of the water. */
static void a_moving_face_in_a_walls_plane_is_sampled(void **state)
{
    (void)state;
    static const double fronts[] = {0, 0.5, 2}; /* m; the support radius is 1 */
    size_t alone = 0;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int f = 2; f >= 0; f--) {
            scene.dimensions = dimensions;
            scene.body_count = 0;
            add_box("paddle", sb_vec(-1, -1, -1), sb_vec(fronts[f], 7, 6));
            snprintf(wavemaker.name, sizeof wavemaker.name, "w");
            wavemaker.direction = sb_vec(1, 0, 0);
            snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
            scene.wavemaker_count = 1;
            build();
            const sb_model_body *paddle = &model.bodies[0];
            size_t front = 0;
            for (size_t i = paddle->begin; i < paddle->begin + paddle->count; i++)
                front += model.wall_normal[i].x > 0.99 && model.wall_position[i].x < fronts[f];
            if (f == 2) alone = front;
            assert_true(front > 0 && front == alone);
            assert_int_equal(warned("\"paddle\" moves", "\"domain\""), f < 2);
            sb_model_free(&model);
        }
}

static void open_sides_have_no_wall(void **state)
{
    (void)state;
    add_box("dam", sb_vec(8, -1, -1), sb_vec(9, 7, 6));
    scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    build();
    for (size_t i = model.bodies[1].begin; i < model.wall_count; ++i) assert_true(model.wall_position[i].x < 10);
    for (int side = 0; side < SB_SIDES; ++side) scene.domain.side[side] = SB_SIDE_OPEN;
    scene.sea.present = false;
    build();
    assert_int_equal(model.body_count, 1);
}

static void points_inside_are_found(void **state)
{
    (void)state;
    add_box("block", sb_vec(5, 2, 0), sb_vec(7, 4, 4));
    build();
    size_t n = model.fluid_count;
    float *at = sb_alloc(3 * n, sizeof *at);
    sb_vec3 origin = sb_vec(-3, 1, 2);
    for (size_t i = 0; i < n; ++i) {
        sb_vec3 p = sb_sub(model.fluid_position[i], origin);
        at[3 * i] = (float)p.x;
        at[3 * i + 1] = (float)p.y;
        at[3 * i + 2] = (float)p.z;
    }
    sb_inside_report report;
    assert_int_equal(sb_model_first_inside(&model, at, n, origin, NULL, 0.1, &report, &error), SB_OK);
    assert_int_equal(report.count, 0);
    assert_true(report.first == SIZE_MAX && report.body == SIZE_MAX);
    /* Two points inside the block, one of them by less than the tolerance. */
    const float deep[3] = {9, 2, 0}, shallow[3] = {8.05F, 2, 0};
    memcpy(at + 3 * 17, shallow, sizeof shallow);
    memcpy(at + 3 * 40, deep, sizeof deep);
    assert_int_equal(sb_model_first_inside(&model, at, n, origin, NULL, 0.1, &report, &error), SB_OK);
    assert_int_equal(report.count, 1);
    assert_int_equal(report.first, 40);
    assert_int_equal(report.body, 0);
    assert_true(fabs(report.depth - 1) < 1e-5);
    /* The block moved by 1.5 m contains other points. */
    sb_vec3 moved[2] = {{1.5, 0, 0}, {0, 0, 0}};
    assert_int_equal(sb_model_first_inside(&model, at, n, origin, moved, 0.1, &report, &error), SB_OK);
    assert_int_equal(report.count, 3 * 4 * 6);
    sb_free(at);
}

/* An open surface has a front and a back. A point beyond its border is neither. */
static void a_point_beside_an_open_surface_is_not_inside(void **state)
{
    (void)state;
    sb_body *slope = add_box("slope", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    slope->shape = SB_SHAPE_PLANE;
    slope->center = sb_vec(5, 3, 2);
    slope->normal = sb_vec(-1, 0, 0);
    slope->width = 2;
    slope->length = 2;
    build();
    /* Points behind its middle, behind near an edge, and in front of it; then beyond an edge and a corner, each a
       metre away. */
    static const struct {
        float at[3];
        size_t within;
    } points[] = {{{6, 3, 2}, 1},    {{6, 3.9F, 2}, 1}, {{4, 3, 2}, 0},
                  {{6, 4.1F, 2}, 0}, {{6, 3, 3.5F}, 0}, {{6, 4.5F, 3.5F}, 0}};
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i) {
        sb_inside_report report;
        assert_int_equal(sb_model_first_inside(&model, points[i].at, 1, sb_vec(0, 0, 0), NULL, 0.1, &report, &error),
                         SB_OK);
        if (report.count != points[i].within) fail_msg("point %zu: within %zu solids", i, report.count);
    }
}

static void the_start_is_freed_except_nonzero_velocities(void **state)
{
    (void)state;
    build();
    const size_t n = model.fluid_count;
    assert_non_null(model.fluid_velocity);
    model.fluid_velocity[n - 1].x = -1e-3;
    sb_model_free_start(&model);
    assert_null(model.fluid_position);
    assert_null(model.fluid_pressure);
    assert_non_null(model.fluid_velocity);
    model.fluid_velocity[n - 1].x = 0;
    sb_model_free_start(&model);
    assert_null(model.fluid_velocity);
    sb_model_free_start(&model);
    assert_int_equal(model.fluid_count, n);
    const size_t walls = model.wall_count;
    assert_non_null(model.wall_position);
    sb_model_free_particles(&model);
    assert_null(model.wall_position);
    assert_null(model.wall_normal);
    assert_int_equal(model.wall_count, walls);
}

static void two_dimensions_have_no_side_walls(void **state)
{
    (void)state;
    scene.dimensions = 2;
    scene.resolution = 0.1;
    sb_body *block = add_box("block", sb_vec(5, -1, 0), sb_vec(7, 1, 1));
    build();
    /* The block's sides and top. Below it, the floor and the block have no particles except where its sides end. */
    assert_int_equal(model.bodies[0].count, 2 * 10 + 18);
    size_t count = model.bodies[1].count;
    assert_int_equal(count, 102 - 18 + 2 * 50);
    for (size_t i = 0; i < model.wall_count; ++i)
        for (size_t j = i + 1; j < model.wall_count; ++j)
            assert_true(sb_norm(sb_sub(model.wall_position[i], model.wall_position[j])) > 0.07);
    /* A rotated block, measured along its outline half a spacing inside. */
    block->rotate = sb_vec(0, 30, 0);
    block->translate = sb_vec(0, 0, 4);
    build();
    assert_in_range(model.bodies[0].count, 50, 66);
    double c = cos(M_PI / 6), s = sin(M_PI / 6);
    for (int k = 0; k <= 1000; ++k) {
        double t = k / 1000.0, x = 5.05 + 1.9 * t, z = 0.95;
        double wx = c * x + s * z, wz = c * z - s * x + 4, best = 1;
        for (size_t i = 0; i < model.wall_count; ++i)
            best = fmin(best, hypot(model.wall_position[i].x - wx, model.wall_position[i].z - wz));
        assert_true(best < 0.075);
    }
    block->min.y = 3;
    block->max.y = 4;
    build();
    assert_true(warned("\"block\"", "no surface"));
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    scene.resolution = 1;
    scene.domain.max = sb_vec(4, 3, 4);
    scene.sea = (sb_sea){true, 2.2, {1, 1.5, 1}};
    add_box("block", sb_vec(2.2, 1, 0), sb_vec(2.8, 2, 4));
    build();
    assert_true(model.warning_count > 0);
    size_t walls = model.wall_count, water = model.fluid_count;
    long failures = 0;
    for (long n = 1; n < 100000; ++n) {
        sb_model made = {.wall_count = 77};
        sb_memory_fail_at(n);
        sb_status status = sb_model_build(&scene, &made, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) {
            /* The n-th allocation may be dispensable: that of a mesh's diagnosis. */
            assert_int_equal(made.wall_count, walls);
            assert_int_equal(made.fluid_count, water);
            bool complete = made.warning_count == model.warning_count;
            sb_model_free(&made);
            if (complete && n > failures + 20) break;
            continue;
        }
        ++failures;
        assert_int_equal(status, SB_FAILED);
        assert_int_equal(made.wall_count, 77);
    }
    assert_true(failures > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(bodies_and_their_particles),
        CASE(names_are_unique),
        CASE(a_wavemaker_needs_its_body),
        CASE(parts_may_have_wavemakers_of_their_own),
        CASE(bodies_without_finite_coordinates_are_refused),
        CASE(open_sides_have_no_wall),
        CASE(a_moving_face_in_a_walls_plane_is_sampled),
        CASE(points_inside_are_found),
        CASE(a_point_beside_an_open_surface_is_not_inside),
        CASE(the_start_is_freed_except_nonzero_velocities),
        CASE(two_dimensions_have_no_side_walls),
        CASE(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The whole model of small scenes: bodies, names, warnings, the inside test, no memory. */
#include "base/memory.h"
#include "geometry/model.h"
#include "physics/wavemaker.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static sb_scene scene;
static sb_body bodies[16];
static sb_wavemaker_use wavemaker;
static sb_model model;
static sb_error error;

static int set_up(void **state)
{
    (void)state;
    memset(&scene, 0, sizeof scene);
    memset(bodies, 0, sizeof bodies);
    memset(&wavemaker, 0, sizeof wavemaker);
    wavemaker.law = (sb_wavemaker_parameters){.kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 1};
    memset(&error, 0, sizeof error);
    scene.dimensions = 3;
    scene.resolution = 0.5;
    scene.fluid = (sb_fluid_properties){1000, 9.81, 0};
    scene.domain.min = sb_vec(0, 0, 0);
    scene.domain.max = sb_vec(10, 6, 5);
    scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    scene.sea = (sb_sea){true, 3, {2, 3, 2}};
    scene.numerics.support = 2;
    scene.numerics.wall_offset = 0.5;
    scene.numerics.wall_spacing = 1;
    scene.bodies = bodies;
    scene.wavemakers = &wavemaker;
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    sb_model_free(&model);
    return 0;
}

static sb_body *add_box(const char *name, sb_vec3 min, sb_vec3 max)
{
    sb_body *body = &bodies[scene.body_count++];
    snprintf(body->name, sizeof body->name, "%s", name);
    body->shape = SB_SHAPE_BOX;
    body->color[0] = -1;
    body->min = min;
    body->max = max;
    return body;
}

static void build(void)
{
    sb_model_free(&model);
    sb_status status = sb_model_build(&scene, &model, &error);
    if (status != SB_OK) print_message("%s\n", error.text);
    assert_int_equal(status, SB_OK);
}

static bool warned(const char *first, const char *second)
{
    for (size_t i = 0; i < model.warning_count; ++i)
        if (strstr(model.warnings[i], first) && strstr(model.warnings[i], second)) return true;
    return false;
}

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
    /* Floor with its rim, but for four below the block, and four walls of ten rows, from half a spacing behind. */
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

/* A paddle whose face lies in the plane of the tank's end has all its particles, and so has the tank; that both bear
   the water is told. */
static void a_moving_face_in_a_walls_plane_is_there(void **state)
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

static void warnings_say_what_is_too_coarse(void **state)
{
    (void)state;
    build();
    assert_int_equal(model.warning_count, 0);
    add_box("plate", sb_vec(5, 1, 0), sb_vec(5.4, 5, 4));
    add_box("block", sb_vec(7, 2, 0), sb_vec(9, 4, 4));
    add_box("far", sb_vec(70, 2, 0), sb_vec(90, 4, 4));
    scene.sea.level = 1.5;
    scene.sea.seed.z = 0.8;
    scene.wave = (sb_initial_wave){.kind = SB_INITIAL_STANDING, .height = 0.3, .depth = 1.5, .wavelength = 10};
    build();
    assert_true(warned("\"plate\"", "about 0.4"));
    assert_false(warned("\"block\"", "thick"));
    assert_true(warned("\"far\"", "no surface"));
    assert_true(warned("1.5 m deep", "3 particles"));
    assert_true(warned("initial wave", "0.6 particles"));
    scene.sea.present = false;
    build();
    assert_true(warned("nothing is wet", ""));
    scene.numerics.time_step_rule = SB_TIME_STEP_DEPTH;
    scene.numerics.time_step_factor = 0.3;
    build();
    assert_false(warned("time_step_factor", ""));
    scene.numerics.time_step_factor = 0.31;
    build();
    assert_true(warned("time_step_factor 0.31", "expected 0.3"));
    sb_model_free(&model);
    scene.numerics.time_step_factor = 0.61;
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "time_step_factor 0.61"));
    assert_non_null(strstr(error.text, "expected 0.6"));
}

static void waves_are_held_against_the_water_there(void **state)
{
    (void)state;
    /* The sea is 3 m deep below a lid at 5 m. */
    static const struct {
        double height, depth, position;
        const char *expected;
    } cases[] = {{1, 3, 5, NULL},
                 {1, 1.5, 5, "its depth is 1.5 m, but the water there is about 3 m deep"},
                 {1, 3, 40, "at its crest: no water is there"},
                 {2.2, 3, 5, "above the domain's top, 5 m"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene.wave = (sb_initial_wave){.kind = SB_INITIAL_SOLITARY,
                                       .height = cases[k].height,
                                       .depth = cases[k].depth,
                                       .position = cases[k].position,
                                       .direction = 1};
        build();
        assert_int_equal(warned("water.wave", ": "), cases[k].expected != NULL);
        if (cases[k].expected) assert_true(warned("water.wave", cases[k].expected));
    }
    scene.wave.kind = SB_INITIAL_NONE;
    add_box("paddle", sb_vec(1, -1, -1), sb_vec(3, 7, 6));
    scene.wavemaker_count = 1;
    scene.sea.seed = sb_vec(5, 3, 2);
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
    wavemaker.direction = sb_vec(1, 0, 0);
    for (int right = 0; right < 2; right++) {
        wavemaker.law.depth = right ? 3 : 6;
        build();
        assert_int_equal(warned("\"push\": its depth is 6 m", "about 3 m deep"), !right);
        assert_false(warned("\"push\" moves", "units"));
    }
    wavemaker.law.stroke = 500; /* mm */
    wavemaker.law.speed = 1000;
    build();
    assert_true(warned("\"push\" moves", "units"));
}

static void boxes_that_get_no_water_of_their_own_are_told(void **state)
{
    (void)state;
    sb_fluid_box box = {.min = {4, 1, 0}, .max = {6, 3, 2}, .level = 2, .velocity = {1, 0, 0}};
    scene.boxes = &box;
    scene.box_count = 1;
    build(); /* in the sea */
    assert_true(warned("water.boxes[0]", "64 of its 64 particles"));
    scene.sea.present = false;
    build(); /* alone */
    assert_false(warned("water.boxes[0]", ""));
    add_box("rock", sb_vec(3, 0, 0), sb_vec(7, 4, 3));
    build();
    assert_true(warned("water.boxes[0]", "no room"));
}

static void faces_without_area_are_told(void **state)
{
    (void)state;
    char path[] = "/tmp/shorebreak-model-XXXXXX.obj";
    int made = mkstemps(path, 4);
    static const char text[] = "v 3 2 0\nv 6 2 0\nv 3 4 0\nv 3 2 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 2\n";
    assert_true(made >= 0 && write(made, text, sizeof text - 1) == (ssize_t)sizeof text - 1);
    close(made);
    sb_body *body = &bodies[scene.body_count++];
    *body = (sb_body){.name = "rock", .shape = SB_SHAPE_MESH, .file = path, .up = 'z', .scale = 1, .color = {-1}};
    build();
    assert_true(warned("\"rock\"", "1 faces without area"));
    unlink(path);
}

/* A plant has dozens of them: one line, the thinnest first. */
static void thin_bodies_share_a_line(void **state)
{
    (void)state;
    add_box("wall", sb_vec(3, 1, 0), sb_vec(3.6, 5, 4));
    build();
    assert_true(warned("body \"wall\" is about 0.6", "pushes water on the other"));
    assert_false(warned("likewise", ""));
    add_box("plate", sb_vec(5, 1, 0), sb_vec(5.4, 5, 4));
    add_box("hall", sb_vec(7, 1, 0), sb_vec(7.8, 5, 4));
    build();
    assert_int_equal(model.warning_count, 1);
    assert_true(warned("body \"plate\" is about 0.4", "; likewise \"wall\" 0.61 m, \"hall\" 0.8"));
}

static void thin_bodies_beyond_a_line_are_counted(void **state)
{
    (void)state;
    const int count = sizeof bodies / sizeof *bodies;
    for (int i = 0; i < count; i++) {
        char name[SB_NAME_MAX];
        snprintf(name, sizeof name, "a-name-that-leaves-no-room-for-many-others-in-a-line-%d", i);
        add_box(name, sb_vec(3, 0.37 * i, 0), sb_vec(9, 0.37 * i + 0.3, 4));
    }
    build();
    assert_int_equal(model.warning_count, 1);
    assert_true(warned("-0\" is about 0.3", " more"));
    int named = 0;
    for (const char *at = model.warnings[0]; (at = strstr(at, "a-name")) != NULL; at++) named++;
    int more = atoi(strstr(model.warnings[0], " and ") + 5);
    assert_true(named > 1 && more > 0);
    assert_int_equal(named + more, count);
}

/* The scene has one body more: it is refused by name, with its thickness. */
static void check_leaks(const char *name, const char *thickness)
{
    sb_model_free(&model);
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, name));
    if (!strstr(error.text, thickness)) fail_msg("%s", error.text);
    assert_null(model.bodies);
    scene.body_count--;
}

static void plates_that_water_passes_are_refused(void **state)
{
    (void)state;
    add_box("sheet", sb_vec(5, 1, 0), sb_vec(5.24, 5, 4));
    check_leaks("\"sheet\"", "about 0.24 m");
    add_box("board", sb_vec(5, 1, 1), sb_vec(8, 5, 1.05));
    check_leaks("\"board\"", "about 0.05 m");
    sb_body *leaning = add_box("leaning", sb_vec(-0.1, -2, 0), sb_vec(0.1, 2, 4));
    leaning->rotate = sb_vec(0, 20, 30);
    leaning->translate = sb_vec(5, 3, 0);
    check_leaks("\"leaning\"", "about 0.2 m");
    scene.dimensions = 2;
    scene.domain.min.y = scene.domain.max.y = 0;
    scene.sea.seed.y = 0;
    bodies[0] = (sb_body){.name = ""};
    add_box("slice", sb_vec(5, -1, 0), sb_vec(5.2, 1, 4));
    check_leaks("\"slice\"", "about 0.2 m");
}

static void plates_that_hold_are_not_refused(void **state)
{
    (void)state;
    add_box("half", sb_vec(5, 1, 0), sb_vec(5.25, 5, 4));
    build();
    assert_true(warned("\"half\"", "thick"));
    bodies[0].max.x = 5.24;
    /* A pavement, a lining of the wall, a plate out of the domain: water comes to one side at most. */
    add_box("ground", sb_vec(4, 0, -1), sb_vec(9, 6, 1));
    bodies[0].min = sb_vec(4, 1, 0.9);
    bodies[0].max = sb_vec(9, 5, 1.1);
    build();
    bodies[0].min = sb_vec(9.9, 1, 0);
    bodies[0].max = sb_vec(10.1, 5, 4);
    build();
    bodies[0].min = sb_vec(12, 1, 0);
    bodies[0].max = sb_vec(12.1, 5, 4);
    build();
}

/* Water goes around them. */
static void slender_columns_are_not_refused(void **state)
{
    (void)state;
    add_box("pile", sb_vec(5, 2, 0), sb_vec(5.2, 2.2, 4));
    sb_body *pole = add_box("pole", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    pole->shape = SB_SHAPE_CYLINDER;
    pole->center = sb_vec(7, 3, 0);
    pole->radius = 0.1;
    pole->height = 4;
    build();
    assert_true(warned("\"pile\"", "thick"));
    assert_true(warned("\"pole\"", "thick"));
}

/* A body is more than its fins. */
static void thin_parts_are_only_warned_of(void **state)
{
    (void)state;
    char path[] = SB_BINARY_DIR "/test_model_fin.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    /* A block from (5, 2, 0) to (7, 4, 4), and a fin of 2 m by 2 m by 0.1 m behind it. */
    static const double boxes[2][6] = {{5, 2, 0, 7, 4, 4}, {7, 2.9, 1, 9, 3, 3}};
    for (int b = 0; b < 2; b++)
        for (int v = 0; v < 8; v++)
            fprintf(file, "v %g %g %g\n", boxes[b][v & 1 ? 3 : 0], boxes[b][v & 2 ? 4 : 1], boxes[b][v & 4 ? 5 : 2]);
    static const int faces[6][4] = {{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}};
    for (int b = 0; b < 2; b++)
        for (int f = 0; f < 6; f++)
            fprintf(file, "f %d %d %d %d\n", faces[f][0] + 8 * b, faces[f][1] + 8 * b, faces[f][2] + 8 * b,
                    faces[f][3] + 8 * b);
    fclose(file);
    sb_body *body = add_box("finned", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    body->shape = SB_SHAPE_MESH;
    body->file = path;
    body->up = 'z';
    body->scale = 1;
    build();
    assert_true(warned("\"finned\"", "thick"));
    remove(path);
}

static void holes_in_a_mesh_are_named(void **state)
{
    (void)state;
    char path[] = SB_BINARY_DIR "/test_model_open.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    /* A box from (5, 2, 0) to (7, 4, 4) without its lid. */
    fputs("v 5 2 0\nv 7 2 0\nv 7 4 0\nv 5 4 0\nv 5 2 4\nv 7 2 4\nv 7 4 4\nv 5 4 4\n"
          "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
          file);
    fclose(file);
    sb_body *body = add_box("lidless", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    body->shape = SB_SHAPE_MESH;
    body->file = path;
    body->up = 'z';
    body->scale = 1;
    build();
    assert_true(warned("\"lidless\" is not watertight: 4 open edges", ", 4)"));
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        assert_false(p.x > 5 && p.x < 7 && p.y > 2 && p.y < 4);
    }
    remove(path);
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
    /* Two into the block, one of them by less than the tolerance. */
    const float deep[3] = {9, 2, 0}, shallow[3] = {8.05F, 2, 0};
    memcpy(at + 3 * 17, shallow, sizeof shallow);
    memcpy(at + 3 * 40, deep, sizeof deep);
    assert_int_equal(sb_model_first_inside(&model, at, n, origin, NULL, 0.1, &report, &error), SB_OK);
    assert_int_equal(report.count, 1);
    assert_int_equal(report.first, 40);
    assert_int_equal(report.body, 0);
    assert_true(fabs(report.depth - 1) < 1e-5);
    /* The block moved 1.5 m ahead holds other points. */
    sb_vec3 moved[2] = {{1.5, 0, 0}, {0, 0, 0}};
    assert_int_equal(sb_model_first_inside(&model, at, n, origin, moved, 0.1, &report, &error), SB_OK);
    assert_int_equal(report.count, 3 * 4 * 6);
    sb_free(at);
}

/* A sheet has a front and a back, and neither beyond its rim. */
static void beside_a_sheet_is_not_within(void **state)
{
    (void)state;
    sb_body *slope = add_box("slope", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    slope->shape = SB_SHAPE_PLANE;
    slope->center = sb_vec(5, 3, 2);
    slope->normal = sb_vec(-1, 0, 0);
    slope->width = 2;
    slope->length = 2;
    build();
    /* Behind its middle, behind near an edge, before it; then beyond an edge and a corner, each a metre on. */
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

static void a_start_is_forgotten_unless_it_moves(void **state)
{
    (void)state;
    build();
    const size_t n = model.fluid_count;
    assert_non_null(model.fluid_velocity);
    model.fluid_velocity[n - 1].x = -1e-3;
    sb_model_forget_start(&model);
    assert_null(model.fluid_position);
    assert_null(model.fluid_pressure);
    assert_non_null(model.fluid_velocity);
    model.fluid_velocity[n - 1].x = 0;
    sb_model_forget_start(&model);
    assert_null(model.fluid_velocity);
    sb_model_forget_start(&model);
    assert_int_equal(model.fluid_count, n);
    const size_t walls = model.wall_count;
    assert_non_null(model.wall_position);
    sb_model_forget_particles(&model);
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
    /* Its sides and top; below it are floor and block no more than where its sides end. */
    assert_int_equal(model.bodies[0].count, 2 * 10 + 18);
    size_t count = model.bodies[1].count;
    assert_int_equal(count, 102 - 18 + 2 * 50);
    for (size_t i = 0; i < model.wall_count; ++i)
        for (size_t j = i + 1; j < model.wall_count; ++j)
            assert_true(sb_norm(sb_sub(model.wall_position[i], model.wall_position[j])) > 0.07);
    /* A turned block, measured along its outline half a spacing within. */
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
            /* The n-th allocation may be one that can be done without: a mesh's diagnosis. */
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
#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CASE(bodies_and_their_particles),
        CASE(names_are_unique),
        CASE(a_wavemaker_needs_its_body),
        CASE(open_sides_have_no_wall),
        CASE(a_moving_face_in_a_walls_plane_is_there),
        CASE(warnings_say_what_is_too_coarse),
        CASE(faces_without_area_are_told),
        CASE(waves_are_held_against_the_water_there),
        CASE(boxes_that_get_no_water_of_their_own_are_told),
        CASE(thin_bodies_share_a_line),
        CASE(thin_bodies_beyond_a_line_are_counted),
        CASE(holes_in_a_mesh_are_named),
        CASE(plates_that_water_passes_are_refused),
        CASE(plates_that_hold_are_not_refused),
        CASE(slender_columns_are_not_refused),
        CASE(thin_parts_are_only_warned_of),
        CASE(points_inside_are_found),
        CASE(beside_a_sheet_is_not_within),
        CASE(a_start_is_forgotten_unless_it_moves),
        CASE(two_dimensions_have_no_side_walls),
        CASE(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

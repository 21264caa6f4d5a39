/* Tests the warnings and refusals of a model: too coarse, too thin, or probably not as intended. */
#include "small_model.h"

static void too_coarse_scenes_give_warnings(void **state)
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
    assert_true(warned("1.5 m deep", "3 times the particle spacing"));
    assert_true(warned("initial wave", "a wave height of 0.6 m is 1.2 times the particle spacing"));
    scene.sea.present = false;
    build();
    assert_true(warned("the scene has no water", ""));
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

static void depths_of_waves_are_compared_with_the_water(void **state)
{
    (void)state;
    /* The sea is 3 m deep below a lid at 5 m. */
    static const struct {
        double height, depth, position;
        const char *expected;
    } cases[] = {{1, 3, 30, NULL},
                 {1, 1.5, 30, "its depth is 1.5 m, but the water there is about 3 m deep"},
                 {1, 3, 140, "at its crest: no water is there"},
                 {2.2, 3, 30, "above the domain's top, 5 m"}};
    scene.domain.max.x = 60;
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
    scene.domain.max.x = 10;
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

static void paddles_with_their_water_behind_are_refused(void **state)
{
    (void)state;
    add_box("paddle", sb_vec(-1, -1, -1), sb_vec(1, 7, 6));
    scene.wavemaker_count = 1;
    snprintf(wavemaker.name, sizeof wavemaker.name, "taker");
    snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
    wavemaker.law = (sb_wavemaker_parameters){.kind = sb_wavemaker_find("absorber"),
                                              .depth = 3,
                                              .period = 4,
                                              .gravity = 9.81,
                                              .ramp = 8,
                                              .lasts = (double)INFINITY,
                                              .absorb = true,
                                              .reach = 1};
    wavemaker.direction = sb_vec(1, 0, 0);
    build();
    assert_false(warned("\"taker\"", "no water"));
    sb_model_free(&model);
    wavemaker.direction = sb_vec(-1, 0, 0);
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "the scene: wavemakers[0].direction: the water of taker is on the other side"));
    assert_non_null(strstr(error.text, "[1, 0, 0]"));
    /* A law that only moves a body may pull. */
    wavemaker.law = (sb_wavemaker_parameters){.kind = sb_wavemaker_find("stroke"), .stroke = 0.1, .speed = 0.1};
    build();
}

/* Long waves in the 3 m of water have 5.42 m/s. */
static void slow_sound_is_reported(void **state)
{
    (void)state;
    scene.numerics.solver = SB_SOLVER_WCSPH;
    for (int fast = 0; fast < 2; fast++) {
        scene.numerics.sound_speed = fast ? 55 : 20;
        build();
        assert_int_equal(warned("numerics.sound_speed: with 20 m/s", "compressed by about 7.4 %"), !fast);
    }
    sb_model_free(&model);
    scene.numerics.sound_speed = 10;
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "numerics.sound_speed: 10 m/s is less than twice the speed of waves"));
    assert_non_null(strstr(error.text, "expected 54.2 m/s"));
    /* Other solvers have it in the artificial viscosity only. */
    scene.numerics.solver = SB_SOLVER_CG;
    build();
    assert_false(warned("sound_speed", ""));
}

static void strokes_into_other_bodies_are_reported(void **state)
{
    (void)state;
    static const struct {
        double back, stroke,
            wall; /* m: the paddle's rear face, its stroke, and the face of a block in front of its front at 3 m */
        const char *expected;
    } cases[] = {{1, 1.5, 5, NULL},
                 {1, 4, 5, "runs into \"block\""},
                 {1, 9, 50, "runs into \"domain\""},
                 {1, -2, 50, "runs into \"domain\""},
                 {-1, -2, 50, NULL}};
    sb_body *paddle = add_box("paddle", sb_vec(1, -1, -1), sb_vec(3, 7, 6));
    sb_body *block = add_box("block", sb_vec(5, 2, 0), sb_vec(6, 5, 4));
    scene.wavemaker_count = 1;
    scene.sea.seed = sb_vec(3.6, 1, 2);
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
    wavemaker.law.depth = 3;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        paddle->min.x = cases[k].back;
        wavemaker.direction = sb_vec(cases[k].stroke < 0 ? -1 : 1, 0, 0);
        wavemaker.law.stroke = fabs(cases[k].stroke);
        block->min.x = cases[k].wall;
        block->max.x = cases[k].wall + 1;
        build();
        assert_int_equal(warned("\"paddle\"", "runs into"), cases[k].expected != NULL);
        if (cases[k].expected) assert_true(warned("\"paddle\"", cases[k].expected));
    }
    /* A run that ends before the stroke reaches the block. */
    wavemaker.direction.x = 1;
    wavemaker.law.stroke = 9;
    scene.duration = 1;
    build();
    assert_false(warned("\"paddle\"", "runs into"));
}

static void boxes_without_water_of_their_own_are_reported(void **state)
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

static void faces_without_area_are_reported(void **state)
{
    (void)state;
    char path[] = "/tmp/shorebreak-model-XXXXXX.obj";
    int made = mkstemps(path, 4);
    static const char text[] = "v 3 2 0\nv 6 2 0\nv 3 4 0\nv 3 2 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 2\n";
    assert_true(made >= 0 && write(made, text, sizeof text - 1) == (ssize_t)sizeof text - 1);
    close(made);
    add_file("rock", path);
    build();
    assert_true(warned("\"rock\"", "1 faces without area"));
    unlink(path);
}

/* A plant has dozens of thin bodies. They share one warning, the thinnest first. */
static void thin_bodies_share_a_line(void **state)
{
    (void)state;
    add_box("wall", sb_vec(3, 1, 0), sb_vec(3.6, 5, 4));
    build();
    assert_true(warned("body \"wall\" is about 0.6", "exerts forces on water on the other side"));
    assert_false(warned("likewise", ""));
    add_box("plate", sb_vec(5, 1, 0), sb_vec(5.4, 5, 4));
    add_box("hall", sb_vec(7, 1, 0), sb_vec(7.8, 5, 4));
    build();
    assert_int_equal(model.warning_count, 1);
    assert_true(warned("body \"plate\" is about 0.4", "; likewise \"wall\" 0.61 m, \"hall\" 0.8"));
}

static void thin_bodies_that_are_not_named_are_counted(void **state)
{
    (void)state;
    const int count = sizeof bodies / sizeof *bodies;
    for (int i = 0; i < count; i++) {
        char name[SB_NAME_MAX];
        snprintf(name, sizeof name, "a-name-that-leaves-no-room-for-many-others-in-a-line-%d", i);
        add_box(name, sb_vec(3, 0.3 * i, 0), sb_vec(9, 0.3 * (i + 1), 4)); /* no gaps between them */
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

/* Expects that the model with the body added last is refused with its name and thickness, and removes that body. */
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
    /* A pavement, a lining of the wall, and a plate outside of the domain: water can be on one side at most. */
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

/* Water flows around slender columns. */
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

/* The fins are a small part of the body. */
static void thin_parts_give_a_warning_only(void **state)
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
    add_file("finned", path);
    build();
    assert_true(warned("\"finned\"", "thick"));
    remove(path);
}

/* Adds a box of 2 m by 2 m by 4 m from a file in which it begins at x and its part has the given name. The body has
   it at (5, 2, 0). */
static sb_body *add_file_box(char *path, const char *part, double x)
{
    static const int faces[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "o %s\n", part);
    for (int z = 0; z < 5; z += 4)
        fprintf(file, "v %.9g 2 %d\nv %.9g 2 %d\nv %.9g 4 %d\nv %.9g 4 %d\n", x, z, x + 2, z, x + 2, z, x, z);
    for (int f = 0; f < 6; f++) fprintf(file, "f %d %d %d %d\n", faces[f][0], faces[f][1], faces[f][2], faces[f][3]);
    fclose(file);
    sb_body *body = add_file("house", path);
    body->translate = sb_vec(5 - x, 0, 0);
    return body;
}

/* Importers store coordinates in single precision, which rounds by 0.03 m at 500 km and 0.25 m at 4150 km. */
static void meshes_far_from_zero_are_reported_or_refused(void **state)
{
    (void)state;
    static char path[] = SB_BINARY_DIR "/test_model_far.obj";
    static const double from[] = {5, 5e3, 500000.125, 4150000};
    for (size_t k = 0; k < sizeof from / sizeof *from; k++) {
        scene.body_count = 0;
        add_file_box(path, "house", from[k]);
        sb_model_free(&model);
        sb_status status = sb_model_build(&scene, &model, &error);
        assert_int_equal(status, k == 3 ? SB_BAD_INPUT : SB_OK);
        if (k == 3)
            assert_non_null(strstr(error.text, "test_model_far.obj: its coordinates are so far from 0"));
        else
            assert_int_equal(warned("\"house\"", "so far from 0"), k == 2);
    }
    remove(path);
}

static void parts_named_as_other_bodies_are_refused(void **state)
{
    (void)state;
    static char path[] = SB_BINARY_DIR "/test_model_part.obj";
    for (int same = 0; same < 2; same++) {
        scene.body_count = 0;
        add_file_box(path, same ? "pillar" : "wing", 5)->split = true;
        add_box("pillar", sb_vec(8, 2, 0), sb_vec(9, 4, 4));
        sb_model_free(&model);
        assert_int_equal(sb_model_build(&scene, &model, &error), same ? SB_BAD_INPUT : SB_OK);
    }
    assert_non_null(strstr(error.text, "has a part named \"pillar\", which is also the name of another body"));
    remove(path);
}

static void holes_in_a_mesh_are_reported(void **state)
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
    add_file("lidless", path);
    build();
    assert_true(warned("\"lidless\" is not watertight: 4 open edges", ", 4)"));
    for (size_t i = 0; i < model.fluid_count; ++i) {
        sb_vec3 p = model.fluid_position[i];
        assert_false(p.x > 5 && p.x < 7 && p.y > 2 && p.y < 4);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(too_coarse_scenes_give_warnings),
        CASE(faces_without_area_are_reported),
        CASE(depths_of_waves_are_compared_with_the_water),
        CASE(paddles_with_their_water_behind_are_refused),
        CASE(slow_sound_is_reported),
        CASE(strokes_into_other_bodies_are_reported),
        CASE(boxes_without_water_of_their_own_are_reported),
        CASE(thin_bodies_share_a_line),
        CASE(thin_bodies_that_are_not_named_are_counted),
        CASE(meshes_far_from_zero_are_reported_or_refused),
        CASE(parts_named_as_other_bodies_are_refused),
        CASE(holes_in_a_mesh_are_reported),
        CASE(plates_that_water_passes_are_refused),
        CASE(plates_that_hold_are_not_refused),
        CASE(slender_columns_are_not_refused),
        CASE(thin_parts_give_a_warning_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

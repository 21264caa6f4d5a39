/* Tests the warnings of scenes that could run but are probably not as intended. The corrected scene has no warning. */
#include "small_model.h"

/* Returns the warning that contains both texts, and fails if there is none. */
static const char *warning(const char *first, const char *second)
{
    for (size_t i = 0; i < model.warning_count; ++i)
        if (strstr(model.warnings[i], first) && strstr(model.warnings[i], second)) return model.warnings[i];
    for (size_t i = 0; i < model.warning_count; ++i) print_message("%s\n", model.warnings[i]);
    fail_msg("no warning with \"%s\" and \"%s\"", first, second);
    return "";
}

static double number_after(const char *text, const char *mark)
{
    const char *at = strstr(text, mark);
    if (!at) fail_msg("no \"%s\" in %s", mark, text);
    return strtod(at + strlen(mark), NULL);
}

/* Makes a flume 60 m by 3 m with water 3 m deep. 99 % of a wave of 1 m are within 18 m of its crest. */
static void make_flume(void)
{
    scene.domain.max = sb_vec(60, 3, 5);
    scene.sea.seed = sb_vec(30, 1.5, 2);
    scene.wave =
        (sb_initial_wave){.kind = SB_INITIAL_SOLITARY, .height = 1, .depth = 3, .position = 30, .direction = 1};
}

static void waves_that_are_cut_off_are_reported(void **state)
{
    (void)state;
    make_flume();
    static const struct {
        double position, percent;
        const char *advice;
    } sides[] = {{0, 50, " m or more"}, {60, 50, " m or less"}, {-100, 100, " m or more"}};
    for (int dimensions = 2; dimensions <= 3; ++dimensions)
        for (int kind = SB_SIDE_WALL; kind <= SB_SIDE_PERIODIC; kind += SB_SIDE_PERIODIC - SB_SIDE_WALL) {
            scene.dimensions = dimensions;
            scene.sea.seed.y = dimensions == 2 ? 0 : 1.5;
            scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = (sb_side_kind)kind;
            for (size_t k = 0; k < sizeof sides / sizeof *sides; ++k) {
                scene.wave.position = sides[k].position;
                build();
                const char *line = warning("water.wave: ", "cut off");
                assert_true(fabs(number_after(line, "water.wave: ") - sides[k].percent) <= 1);
                assert_non_null(strstr(line, sides[k].advice));
                /* The recommended position is sufficient, and three metres less are not. */
                scene.wave.position = number_after(line, "expected water.wave.position ");
                build();
                assert_false(warned("water.wave", "cut off"));
                scene.wave.position += scene.wave.position < 30 ? -3 : 3;
                build();
                assert_true(warned("water.wave", "cut off"));
            }
        }
}

static void waves_cut_by_bodies_and_land_are_reported(void **state)
{
    (void)state;
    make_flume();
    /* Ground that slopes down from the left side to the floor at x = 30 m: its shore is at x = 19.1 m. */
    char path[] = SB_BINARY_DIR "/test_meant_shore.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("v -90 -9 33\nv 30 -9 0\nv 90 -9 0\nv -90 12 33\nv 30 12 0\nv 90 12 0\nf 1 2 5 4\nf 2 3 6 5\n", file);
    fclose(file);
    add_file("shore", path)->role = SB_ROLE_TERRAIN;
    scene.wave.position = 40;
    build();
    assert_false(warned("water.wave", "cut off"));
    scene.wave.position = 24;
    build();
    const char *line = warning("water.wave", "cut off");
    assert_true(fabs(number_after(line, "the water extends from x = ") - 19.5) <= 0.5);
    scene.body_count = 0;
    bodies[0] = (sb_body){.role = SB_ROLE_SOLID};
    /* A pillar at the crest with half the width and a tenth of the wave's length, and a pier beside the water. */
    scene.wave.position = 30;
    scene.sea.seed.x = 20;
    add_box("pillar", sb_vec(28.5, 0.75, -1), sb_vec(31.5, 2.25, 6));
    build();
    assert_non_null(strstr(warning("water.wave", "cut off"), "nothing but water"));
    bodies[0].min = sb_vec(-1, -1, -1);
    bodies[0].max = sb_vec(61, 1.5, 6);
    scene.sea.seed.y = 2.5;
    build();
    assert_false(warned("water.wave", "cut off"));
    /* The water is too short for any position. */
    scene.domain.max.x = 20;
    scene.body_count = 0;
    scene.sea.seed = sb_vec(10, 1, 1);
    scene.wave.position = 10;
    build();
    assert_non_null(strstr(warning("water.wave", "cut off"), "longer water"));
    remove(path);
}

/* Water also exerts a force on a surface behind a face, up to the support radius: here to a depth of 0.5 m. */
static void surfaces_close_behind_others_are_reported(void **state)
{
    (void)state;
    static const struct {
        sb_vec3 min, max;
        bool shared;
    } cores[] = {
        {{7.3, -1, -1}, {11, 7, 6}, true},    /* behind the whole face */
        {{7.4, 2, -1}, {9, 4, 2}, true},      /* behind a part of it */
        {{7.6, -1, -1}, {11, 7, 6}, false},   /* deeper */
        {{6.7, 2, -1}, {9, 4, 2}, true},      /* in front of it: then the core is the cladding */
        {{7, 4.5, -1}, {9, 7, 6}, false},     /* beside it */
        {{7.3, 4.5, -1}, {9, 7, 6}, false},   /* beside it and further back */
        {{7.3, -1, 3.4}, {9, 4.5, 6}, false}, /* on it */
    };
    for (int dimensions = 2; dimensions <= 3; ++dimensions)
        for (size_t k = 0; k < sizeof cores / sizeof *cores; ++k) {
            if (dimensions == 2 && (k == 4 || k == 5)) continue;
            scene.dimensions = dimensions;
            scene.sea.seed.y = dimensions == 2 ? 0 : 3;
            scene.body_count = 0;
            add_box("front", sb_vec(7, -1, -1), sb_vec(9, k > 3 ? 4.5 : 7, k > 5 ? 3.4 : 6))->report = true;
            add_box("core", cores[k].min, cores[k].max);
            if (dimensions == 2) bodies[1].min.y = -1;
            build();
            assert_int_equal(warned("the sum of their forces", ""), cores[k].shared);
            if (!cores[k].shared) continue;
            const char *line = warning("\"front\"", "\"core\"");
            assert_true(fabs(number_after(line, "lies about ") - fabs(cores[k].min.x - 7)) < 0.01);
            assert_int_equal(strstr(line, "\"core\"") > strstr(line, "\"front\""), cores[k].min.x > 7);
            bodies[0].report = false; /* these forces are not reported */
            build();
            assert_false(warned("the sum of their forces", ""));
        }
}

/* All pairs share one warning, and the count includes those that are not named. */
static void many_surfaces_behind_others_share_a_line(void **state)
{
    (void)state;
    scene.domain.max.y = 24;
    add_box("front", sb_vec(7, -1, -1), sb_vec(9, 25, 6))->report = true;
    for (int k = 0; k < 12; k++) {
        char name[SB_NAME_MAX];
        snprintf(name, sizeof name, "a-name-that-leaves-no-room-for-all-others-in-a-line-%d", k);
        add_box(name, sb_vec(7.4, 2 * k, -1), sb_vec(9, 2 * k + 1, 6));
    }
    build();
    const char *line = warning("the sum of their forces", "; likewise");
    int named = 0;
    for (const char *at = line; (at = strstr(at, "a-name")) != NULL; at++) named++;
    assert_true(named > 1 && named < 12);
    assert_int_equal(named + (int)number_after(strstr(line, "; likewise"), " and "), 12);
}

/* Adds a grid of 6 by 4 nodes, 2 m apart, whose heights are 0 except at two of them. */
static sb_body *add_grid(char *path, const char *nodata, const char *first, const char *second)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols 6\nnrows 4\nxllcenter 0\nyllcenter 0\ncellsize 2\n%s", nodata);
    for (int node = 0; node < 24; node++)
        fprintf(file, "%s%c", node == 8 ? first : node == 15 ? second : "0.1", node % 6 == 5 ? '\n' : ' ');
    fclose(file);
    sb_body *body = add_file("ground", path);
    body->shape = SB_SHAPE_GRID;
    body->role = SB_ROLE_TERRAIN;
    return body;
}

static void unmarked_missing_heights_are_reported(void **state)
{
    (void)state;
    static char path[] = SB_BINARY_DIR "/test_meant_nodata.asc";
    static const struct {
        const char *nodata, *first, *second, *expected;
    } cases[] = {
        {"", "0.2", "0.3", NULL},
        {"", "-4", "7", NULL}, /* a pit and a hill */
        {"", "-9999", "-9999", NULL},
        {"NODATA_value -32768\n", "-32767", "0.3",
         "1 of its grid's nodes within the domain is at z = -32766 m, far below"},
        {"", "-32768", "-32767", "2 of its grid's nodes within the domain are at z = -32767 m and more, far below"},
        {"NODATA_value -1\n", "-999", "0.3", "1 of its grid's nodes"},
        {"", "9999", "0.3", "1 of its grid's nodes within the domain is at z = 10000 m, far above"},
        {"", "9999", "-99999", "2 of its grid's nodes"},
    };
    scene.domain.min.z = -5;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        scene.body_count = 0;
        add_grid(path, cases[k].nodata, cases[k].first, cases[k].second)->datum = 1;
        build();
        assert_int_equal(warned("\"ground\"", "NODATA_value"), cases[k].expected != NULL);
        if (cases[k].expected) assert_non_null(strstr(warning("\"ground\"", "1.1 to "), cases[k].expected));
        /* A missing height is not also reported as the ground's lowest height. */
        assert_false(warned("domain's floor is", ""));
    }
    /* The same two places outside of the domain, at (4, 4) and (6, 2). */
    scene.domain.min.x = 8.1;
    scene.sea.seed.x = 9;
    build();
    assert_false(warned("\"ground\"", "NODATA_value"));
    scene.domain.min.x = 0;
    scene.sea.seed.x = 2;
    scene.body_count = 0;
    add_grid(path, "", "1e30", "0.3");
    sb_model_free(&model);
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "nodata"));
    remove(path);
}

static void ground_below_the_floor_is_reported(void **state)
{
    (void)state;
    static char path[] = SB_BINARY_DIR "/test_meant_floor.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    /* The ground slopes from 2 m at the left side to -10 m at x = 6 m and is level from there on. */
    fputs("v 0 -9 2\nv 6 -9 -10\nv 20 -9 -10\nv 0 12 2\nv 6 12 -10\nv 20 12 -10\nf 1 2 5 4\nf 2 3 6 5\n", file);
    fclose(file);
    add_file("bed", path)->role = SB_ROLE_TERRAIN;
    scene.sea.seed.x = 8;
    scene.domain.min.z = -5;
    scene.sea.seed.z = -2;
    for (scene.dimensions = 2; scene.dimensions <= 3; ++scene.dimensions) {
        scene.sea.seed.y = scene.dimensions == 2 ? 0 : 3;
        scene.domain.min.z = -5;
        build();
        assert_true(fabs(model.still_depth - 8) < 1e-9); /* for 13 m */
        const char *line = warning("\"bed\"", "the domain's floor is at -5 m");
        assert_true(fabs(number_after(line, "as low as z = ") + 10) < 0.01);
        assert_true(fabs(number_after(line, "stands on that floor and is ") - 5) < 0.01);
        scene.domain.min.z = -10;
        build();
        assert_true(fabs(model.still_depth - 13) < 1e-9);
        assert_false(warned("\"bed\"", "domain's floor"));
    }
    /* The ground is below the floor only behind a dam, where there is no water. */
    scene.dimensions = 3;
    scene.domain.min.z = -5;
    add_box("dam", sb_vec(3, -1, -12), sb_vec(30, 7, 6));
    scene.sea.seed = sb_vec(2, 3, 2);
    build();
    assert_false(warned("\"bed\"", "domain's floor"));
    /* All ground is below the floor. Taken for feet it would lie above, but its size is that of the domain. */
    file = fopen(path, "w");
    assert_non_null(file);
    fputs("v 0 -8 -10\nv 20 -8 -10\nv 0 9 -10\nv 20 9 -10\nf 1 2 4 3\n", file);
    fclose(file);
    scene.body_count = 0;
    add_file("bed", path)->role = SB_ROLE_TERRAIN;
    build();
    warning("\"bed\"", "the domain's floor is at -5 m");
    assert_false(warned("\"bed\"", "expected scale"));
    remove(path);
}

static void water_at_an_open_side_is_reported(void **state)
{
    (void)state;
    sb_fluid_box box = {.min = {0, 0, 0}, .max = {10, 6, 2}, .level = 2};
    scene.boxes = &box;
    scene.box_count = 1;
    scene.sea.present = false;
    add_box("dam", sb_vec(90, -1, -1), sb_vec(92, 7, 6));
    for (scene.dimensions = 2; scene.dimensions <= 3; ++scene.dimensions)
        for (int side = SB_X_MIN; side < SB_Z_MAX; ++side) {
            if (scene.dimensions == 2 && (side == SB_Y_MIN || side == SB_Y_MAX)) continue;
            scene.domain.side[side] = SB_SIDE_OPEN;
            build();
            assert_non_null(strstr(warning("water.boxes[0]", "open side"), sb_side_names[side]));
            scene.domain.side[side] = SB_SIDE_WALL;
            build();
            assert_false(warned("open side", ""));
        }
    /* Water held by a dam, or a metre away from the side, from where it flows as intended. */
    scene.dimensions = 3;
    scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    bodies[0].min.x = 9;
    bodies[0].max.x = 11;
    build();
    assert_false(warned("open side", ""));
    bodies[0].min.x = 90;
    bodies[0].max.x = 91;
    box.max.x = 9;
    build();
    assert_false(warned("open side", ""));
    /* A sea that a sill holds, and a wave that is higher than the sill, which cuts it off. */
    scene.box_count = 0;
    scene.sea.present = true;
    scene.domain.max.x = 60;
    bodies[0].min = sb_vec(57, -1, -1);
    bodies[0].max = sb_vec(61, 7, 3);
    build();
    assert_false(warned("open side", ""));
    scene.wave =
        (sb_initial_wave){.kind = SB_INITIAL_SOLITARY, .height = 1, .depth = 3, .position = 52, .direction = 1};
    build();
    assert_true(warned("water.wave", "cut off"));
    assert_false(warned("open side", ""));
}

/* Adds a house of 2 m by 2 m by 4 m in the unit of its file, at (5, 2, 0) in metres. */
static sb_body *add_house(char *path, double unit)
{
    static const int faces[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
    static const double corners[4][2] = {{5, 2}, {7, 2}, {7, 4}, {5, 4}};
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int v = 0; v < 8; v++)
        fprintf(file, "v %.9g %.9g %.9g\n", corners[v % 4][0] / unit, corners[v % 4][1] / unit, (v < 4 ? 0 : 4) / unit);
    for (int f = 0; f < 6; f++) fprintf(file, "f %d %d %d %d\n", faces[f][0], faces[f][1], faces[f][2], faces[f][3]);
    fclose(file);
    sb_body *body = add_file("house", path);
    body->report = true;
    return body;
}

static void bodies_that_no_water_reaches_are_reported(void **state)
{
    (void)state;
    static char path[] = SB_BINARY_DIR "/test_meant_house.obj";
    static const double units[] = {1e-3, 1e-2, 1e3};
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k) {
        scene.body_count = 0;
        sb_body *house = add_house(path, units[k]);
        build();
        const char *line = warning("\"house\"", "expected scale ");
        char size[80];
        snprintf(size, sizeof size, "it is %g x %g x %g m", 2 / units[k], 2 / units[k], 4 / units[k]);
        assert_non_null(strstr(line, size));
        assert_true(fabs(number_after(line, "expected scale ") - units[k]) < 1e-9);
        house->scale = units[k];
        build();
        assert_false(warned("\"house\"", "scale"));
        assert_false(warned("\"house\"", "no surface"));
        assert_int_equal(model.bodies[0].source, 0);
    }
    /* In the right unit, but elsewhere: no scale helps. */
    scene.body_count = 0;
    add_house(path, 1)->translate.x = 90;
    build();
    const char *line = warning("\"house\"", "outside of the domain");
    assert_non_null(strstr(line, "2 x 2 x 4 m, from (95, 2, 0) to (97, 4, 4)"));
    assert_null(strstr(line, "scale"));
    /* Inside another body. */
    bodies[0].translate.x = 0;
    add_box("hill", sb_vec(4, 1, -1), sb_vec(8, 5, 5));
    build();
    warning("\"house\" has no surface", "within other bodies");
    assert_false(warned("\"hill\"", "no surface"));
    remove(path);
}

static void gauges_over_thin_water_are_reported(void **state)
{
    (void)state;
    /* A step over which the water is `depth` spacings deep, with a gauge 3 m behind its edge, and a gauge over deep
       water. */
    static const struct {
        double depth;
        bool thin;
    } cases[] = {{0.2, true}, {0.45, true}, {1, false}, {2, false}, {-1, false}, {0.01, false}};
    static const sb_gauge gauges[] = {{"deep", 2, 3, 0}, {"shelf", 8, 3, 0}, {"end", 9.2, 3, 0}};
    scene.measure.gauges = (sb_gauge *)gauges;
    scene.measure.gauge_count = 2;
    for (scene.dimensions = 2; scene.dimensions <= 3; ++scene.dimensions)
        for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
            scene.sea.seed.y = scene.dimensions == 2 ? 0 : 3;
            scene.body_count = 0;
            add_box("step", sb_vec(5, -1, -1), sb_vec(11, 7, 3 - 0.5 * cases[k].depth));
            build();
            assert_false(model.shallow[0]);
            assert_int_equal(model.shallow[1], cases[k].thin);
            assert_int_equal(warned("gauge \"shelf\"", "stay empty"), cases[k].thin);
            assert_false(warned("\"deep\"", ""));
            if (!cases[k].thin) continue;
            const char *line = warning("gauge \"shelf\"", "expected a resolution of ");
            assert_true(fabs(number_after(line, "still water there is ") / (0.5 * cases[k].depth) - 1) < 0.05);
            assert_true(fabs(number_after(line, "expected a resolution of ") / (0.5 * cases[k].depth) - 1) < 0.05);
            assert_null(strstr(line, "likewise"));
        }
    scene.dimensions = 3;
    bodies[0].max.z = 2.9;
    scene.measure.gauge_count = 3;
    build();
    assert_non_null(strstr(warning("gauge \"shelf\"", "stay empty"), "; likewise \"end\" 0.1 m"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(waves_that_are_cut_off_are_reported),       CASE(waves_cut_by_bodies_and_land_are_reported),
        CASE(surfaces_close_behind_others_are_reported), CASE(many_surfaces_behind_others_share_a_line),
        CASE(unmarked_missing_heights_are_reported),     CASE(ground_below_the_floor_is_reported),
        CASE(water_at_an_open_side_is_reported),         CASE(bodies_that_no_water_reaches_are_reported),
        CASE(gauges_over_thin_water_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Scenes that could run, but most likely not as their writer meant them: each has a line that says so, and the same
   scene as it was meant has none. */
#include "small_model.h"

/* The warning that holds both texts; fails without one. */
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

/* 60 m by 3 m, 3 m deep: 99 % of a wave of 1 m are within 18 m of its crest. */
static void make_flume(void)
{
    scene.domain.max = sb_vec(60, 3, 5);
    scene.sea.seed = sb_vec(30, 1.5, 2);
    scene.wave = (sb_initial_wave){.kind = SB_INITIAL_SOLITARY, .height = 1, .depth = 3, .position = 30, .direction = 1};
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
                /* What is advised is enough, and three metres less are not. */
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
    /* Ground that falls from the left side to the floor at x = 30 m: its shore is at x = 19.1 m. */
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
    assert_true(fabs(number_after(line, "the water is from x = ") - 19.5) <= 0.5);
    scene.body_count = 0;
    bodies[0] = (sb_body){.role = SB_ROLE_SOLID};
    /* A pillar at the crest, of half the width and a tenth of the wave's length; and a pier beside the water. */
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
    /* Too short for any place. */
    scene.domain.max.x = 20;
    scene.body_count = 0;
    scene.sea.seed = sb_vec(10, 1, 1);
    scene.wave.position = 10;
    build();
    assert_non_null(strstr(warning("water.wave", "cut off"), "longer water"));
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(waves_that_are_cut_off_are_reported),
        CASE(waves_cut_by_bodies_and_land_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

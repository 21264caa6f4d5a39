/* Tests the warnings of gaps that are too narrow for the walls, and the flags of the bodies beside them. The spacing is
   0.5 m; boundary particles resolve gaps from 0.75 m on, images from 0.5 m on. */
#include "small_model.h"

static const sb_model_body *body(const char *name)
{
    for (size_t b = 0; b < model.body_count; b++)
        if (strcmp(model.bodies[b].name, name) == 0) return &model.bodies[b];
    return NULL;
}

/* The gap of a body as flagged is that between two surfaces, to within the ray's skin. */
static bool is_flagged(const char *name, double width)
{
    return fabs(body(name)->gap - width) < 1e-3;
}

/* Two blocks with a gap along x. */
static void place_blocks(double width)
{
    scene.body_count = 0;
    scene.sea.seed = sb_vec(1, 1, 2);
    add_box("left", sb_vec(2, 2, -1), sb_vec(4, 4, 6));
    add_box("right", sb_vec(4 + width, 2, -1), sb_vec(6 + width, 4, 6));
}

static void gaps_below_the_limit_of_the_walls_are_named(void **state)
{
    (void)state;
    static const struct {
        double width;
        int walls;
        bool narrow;
    } cases[] = {
        {0.5, SB_WALLS_PARTICLES, true}, {0.74, SB_WALLS_PARTICLES, true}, {0.75, SB_WALLS_PARTICLES, false},
        {0.1, SB_WALLS_PARTICLES, true}, {0.3, SB_WALLS_IMAGES, true},     {0.49, SB_WALLS_IMAGES, true},
        {0.5, SB_WALLS_IMAGES, false},   {0, SB_WALLS_IMAGES, false},      {0, SB_WALLS_PARTICLES, false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[80];
        place_blocks(cases[k].width);
        scene.numerics.walls = cases[k].walls;
        build();
        snprintf(text, sizeof text, "across a gap of about %.2g m near (%.4g, ", cases[k].width,
                 4 + 0.5 * cases[k].width);
        assert_int_equal(warned("bodies \"left\" and \"right\" face each other", text), cases[k].narrow);
        assert_int_equal(warned("face each other", ""), cases[k].narrow);
        assert_true(is_flagged("left", cases[k].narrow ? cases[k].width : 0));
        assert_true(is_flagged("right", cases[k].narrow ? cases[k].width : 0));
        assert_true(body("domain")->gap == 0);
    }
}

static void other_gaps_are_named(void **state)
{
    (void)state;
    /* Beside a wall of the domain; over its floor. */
    scene.sea.seed = sb_vec(1, 1, 2);
    add_box("block", sb_vec(9, 2, -1), sb_vec(9.6, 4, 6));
    build();
    assert_true(warned("bodies \"block\" and \"domain\"", "about 0.4 m near (9.8, "));
    assert_true(is_flagged("block", 0.4) && is_flagged("domain", 0.4));
    scene.body_count = 0;
    add_box("deck", sb_vec(2, 2, 0.4), sb_vec(4, 4, 6));
    build();
    assert_true(warned("bodies \"deck\" and \"domain\"", ", 0.2)"));
    /* Above and beside a step that stands on the floor. */
    scene.body_count = 0;
    add_box("step", sb_vec(2, 2, -1), sb_vec(4, 4, 1));
    add_box("roof", sb_vec(2, 2, 1.3), sb_vec(4, 4, 3));
    build();
    assert_true(warned("bodies \"step\" and \"roof\"", ", 1.15)"));
    /* What fills the gap closes it, and bodies that overlap have none. */
    add_box("filler", sb_vec(2, 2, 0.9), sb_vec(4, 4, 1.4));
    build();
    assert_false(warned("face each other", ""));
}

/* The two arms of a fork are the same body. */
static void a_slot_of_one_body_is_named(void **state)
{
    (void)state;
    static const double x[] = {2, 4, 4.4, 6.4};
    char path[] = SB_BINARY_DIR "/test_gaps_fork.obj";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int arm = 0; arm < 2; arm++) { /* two boxes in one mesh */
        for (int z = 0; z < 2; z++)
            fprintf(file, "v %g 2 %d\nv %g 2 %d\nv %g 4 %d\nv %g 4 %d\n", x[2 * arm], 6 * z - 1, x[2 * arm + 1],
                    6 * z - 1, x[2 * arm + 1], 6 * z - 1, x[2 * arm], 6 * z - 1);
        const int v = 8 * arm;
        fprintf(file, "f %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\nf %d %d %d %d\n",
                v + 4, v + 3, v + 2, v + 1, v + 5, v + 6, v + 7, v + 8, v + 1, v + 2, v + 6, v + 5, v + 2, v + 3, v + 7,
                v + 6, v + 3, v + 4, v + 8, v + 7, v + 4, v + 1, v + 5, v + 8);
    }
    fclose(file);
    add_file("fork", path);
    scene.sea.seed = sb_vec(1, 1, 2);
    build();
    remove(path);
    assert_true(warned("body \"fork\": two of its surfaces face each other", "about 0.4 m near (4.2, "));
    assert_true(is_flagged("fork", 0.4));
}

static void gaps_across_periodic_sides_and_in_sections_are_named(void **state)
{
    (void)state;
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_PERIODIC;
    add_box("near", sb_vec(0.2, 2, -1), sb_vec(2, 4, 6));
    add_box("far", sb_vec(8, 2, -1), sb_vec(9.9, 4, 6));
    build();
    assert_true(warned("bodies \"near\" and \"far\"", "about 0.3 m near"));
    bodies[0].min.x = 0.1; /* the middle of the gap is on the side */
    build();
    assert_true(warned("bodies \"near\" and \"far\"", "about 0.2 m near"));
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_WALL;
    scene.dimensions = 2;
    scene.domain.min.y = scene.domain.max.y = scene.sea.seed.y = 0;
    scene.body_count = 0;
    add_box("left", sb_vec(2, -1, -1), sb_vec(4, 1, 6));
    add_box("right", sb_vec(4.4, -1, -1), sb_vec(6, 1, 6));
    scene.sea.seed.x = 1;
    build();
    assert_true(warned("bodies \"left\" and \"right\"", "about 0.4 m near (4.2, 0, "));
}

/* The gap behind a paddle changes with its stroke; that below it does not. */
static void gaps_that_a_stroke_changes_are_not_named(void **state)
{
    (void)state;
    add_box("paddle", sb_vec(0.3, 0, 0), sb_vec(1.5, 6, 5));
    scene.wavemaker_count = 1;
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
    wavemaker.direction = sb_vec(1, 0, 0);
    scene.sea.seed = sb_vec(5, 3, 2);
    build();
    assert_false(warned("face each other", ""));
    bodies[0].min.z = 0.3;
    build();
    assert_true(warned("bodies \"paddle\" and \"domain\"", ", 0.15)"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(gaps_below_the_limit_of_the_walls_are_named),
        CASE(other_gaps_are_named),
        CASE(a_slot_of_one_body_is_named),
        CASE(gaps_across_periodic_sides_and_in_sections_are_named),
        CASE(gaps_that_a_stroke_changes_are_not_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Models of several ranks: each has a part of the fluid particles, which together are those of a model of one rank, bit
   for bit. All else but the walls (test_model_walls.c) is the same in all of them: warnings, hash, and what is known of
   all particles. */
#include "team.h"

#include "base/hash.h"
#include "check.h"

static void check_part(const sb_model *part, size_t at)
{
    const size_t here = sb_model_fluid_here(part);
    assert_int_equal(part->part.from, at);
    assert_true(at + here <= model.fluid_count);
    assert_memory_equal(part->fluid_position, model.fluid_position + at, here * sizeof(sb_vec3));
    assert_memory_equal(part->fluid_velocity, model.fluid_velocity + at, here * sizeof(sb_vec3));
    assert_memory_equal(part->fluid_pressure, model.fluid_pressure + at, here * sizeof(double));
}

static void check_rest(const sb_model *part)
{
    sb_vec3 low, high, all_low, all_high;
    assert_int_equal(part->fluid_count, model.fluid_count);
    assert_true(part->still_depth == model.still_depth);
    assert_int_equal(part->warning_count, model.warning_count);
    for (size_t w = 0; w < model.warning_count; w++) assert_string_equal(part->warnings[w], model.warnings[w]);
    assert_true(sb_model_hash(part) == sb_model_hash(&model));
    assert_true(sb_model_extent(part, &low, &high) && sb_model_extent(&model, &all_low, &all_high));
    assert_memory_equal(&low, &all_low, sizeof low);
    assert_memory_equal(&high, &all_high, sizeof high);
    assert_true(sb_model_start_speed(part) == sb_model_start_speed(&model));
    for (size_t g = 0; g < scene.measure.gauge_count; g++) assert_int_equal(part->shallow[g], model.shallow[g]);
}

/* Builds the model of each of so many ranks, and compares it with that of one. */
static void check_ranks(int ranks)
{
    size_t at = 0;
    team t = {.ranks = ranks};
    team_build(&t);
    for (int r = 0; r < ranks; r++) {
        assert_int_equal(t.status[r], SB_OK);
        assert_true(t.part[r].part.divided);
        check_part(&t.part[r], at);
        check_rest(&t.part[r]);
        at += sb_model_fluid_here(&t.part[r]);
    }
    team_free(&t);
    assert_int_equal(at, model.fluid_count);
}

static void a_sea_is_placed_in_parts(void **state)
{
    (void)state;
    static sb_gauge gauges[2];
    gauges[0] = (sb_gauge){.name = "ledge", .x = 6, .y = 3};
    gauges[1] = (sb_gauge){.name = "deep", .x = 2, .y = 3};
    scene.measure.gauges = gauges;
    scene.measure.gauge_count = 2;
    add_box("ledge", sb_vec(4, 0, -1), sb_vec(8, 6, 2.8));
    add_box("pillar", sb_vec(1.2, 1.1, -1), sb_vec(2.3, 2.7, 9));
    scene.sea.seed = sb_vec(3, 5, 2);
    scene.numerics.jitter = 0.1;
    scene.numerics.seed = 5;
    scene.wave =
        (sb_initial_wave){.kind = SB_INITIAL_SOLITARY, .height = 1, .depth = 1.5, .position = 3, .direction = 1};
    build();
    assert_true(warned("water.wave", "its depth is 1.5 m, but the water there is about"));
    assert_true(warned("gauge \"ledge\"", "0.2 m deep"));
    assert_true(sb_model_start_speed(&model) > 0);
    check_ranks(2);
    check_ranks(7);
}

static void a_box_is_placed_in_parts(void **state)
{
    (void)state;
    static sb_fluid_box box;
    box = (sb_fluid_box){{0, 0, 0}, {5, 6, 2}, 2, {0, 0, 0}};
    scene.sea.present = false;
    scene.boxes = &box;
    scene.box_count = 1;
    scene.domain.side[SB_X_MIN] = SB_SIDE_OPEN;
    add_box("ground", sb_vec(-1, -1, -6), sb_vec(11, 7, -2))->role = SB_ROLE_TERRAIN;
    build();
    assert_true(warned("open side x_min", ""));
    assert_true(warned("body \"ground\"", "ground below the water is as low as z = -2 m"));
    check_ranks(3);
}

/* What several waters have is known only when all are placed. */
static void several_waters_are_placed_whole(void **state)
{
    (void)state;
    static sb_fluid_box box;
    box = (sb_fluid_box){{0, 0, 2}, {5, 6, 4}, 4, {0, 0, 0}};
    scene.boxes = &box;
    scene.box_count = 1;
    build();
    team t = {.ranks = 3};
    assert_false(sb_model_divides(&scene));
    team_build(&t);
    assert_int_equal(t.status[1], SB_OK);
    assert_false(t.part[1].part.divided);
    check_part(&t.part[1], 0);
    check_rest(&t.part[1]);
    team_free(&t);
}

/* Words that are added in pieces have the hash that they have at once. */
static void hashes_of_pieces_are_those_of_all(void **state)
{
    (void)state;
    uint64_t words[10];
    for (uint64_t k = 0; k < 10; k++) words[k] = k * k + 1;
    uint64_t hash = sb_hash_begin(7, sizeof words);
    hash = sb_hash_words(hash, words, 3);
    hash = sb_hash_words(hash, words + 3, 7);
    assert_true(sb_hash_end(hash, 0) == sb_hash(7, words, sizeof words));
    assert_true(sb_hash(7, words, sizeof words) != sb_hash(7, words, sizeof words - 8));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(a_sea_is_placed_in_parts),
        CASE(a_box_is_placed_in_parts),
        CASE(several_waters_are_placed_whole),
        CASE(hashes_of_pieces_are_those_of_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

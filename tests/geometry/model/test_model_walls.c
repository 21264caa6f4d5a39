/* Boundary particles of models that several ranks build: the own ones of all ranks are those of a model of one rank,
   bit for bit and in order; each rank has all of them near its own, near places and near moving bodies; and what a rank
   says of all of them is what one rank says. */
#include "team.h"

#include "check.h"

/* The last one is in the second scene. */
static const sb_model_place places[] = {{{40, 0.5, 0}, {40, 0.5, 0}, 0.4, true},
                                        {{25, 4, 2}, {25, 4, 2}, 2, false},
                                        {{12, 1, 0}, {12, 5, 0}, 0.4, true},
                                        {{0.3, 29, 2}, {0.3, 29, 2}, 1.5, false}};
enum { PLACES = sizeof places / sizeof *places };

/* A flume of seven slabs with a paddle before a wall, a clad wall and a narrow alley that cross borders of slabs. */
static void flume(void)
{
    scene.domain.max = sb_vec(60, 6, 5);
    scene.sea.seed = sb_vec(6, 3, 2);
    add_box("paddle", sb_vec(1, -1, -1), sb_vec(3, 7, 6));
    add_box("rear", sb_vec(1.5, 1, -1), sb_vec(2.8, 5, 6));
    add_box("front", sb_vec(14, 4, -1), sb_vec(50, 5, 6))->report = true;
    add_box("core", sb_vec(13, 4.3, -1), sb_vec(53, 7, 6))->report = true;
    add_box("left", sb_vec(30, 0.9, -1), sb_vec(48, 1.6, 4.5))->report = true;
    add_box("right", sb_vec(30, 2, -1), sb_vec(48, 2.7, 4.5))->report = true;
    add_box("cube", sb_vec(8, 2, 1), sb_vec(9, 3, 1.8));
    add_box("far", sb_vec(200, 0, 0), sb_vec(201, 1, 1));
    scene.wavemaker_count = 1;
    snprintf(wavemaker.name, sizeof wavemaker.name, "push");
    snprintf(wavemaker.body, sizeof wavemaker.body, "paddle");
    wavemaker.direction = sb_vec(1, 0, 0);
    wavemaker.law.depth = 3;
}

static bool same(const sb_model *a, size_t i, const sb_model *b, size_t k)
{
    return memcmp(&a->wall_position[i], &b->wall_position[k], sizeof(sb_vec3)) == 0 &&
           memcmp(&a->wall_normal[i], &b->wall_normal[k], sizeof(sb_vec3)) == 0;
}

/* The own particles of all ranks, one rank after another, are those of the body. */
static void check_own(const team *t, size_t b)
{
    const sb_model_body *whole = &model.bodies[b];
    size_t at = whole->begin;
    for (int r = 0; r < t->ranks; r++) {
        const sb_model *part = &t->part[r];
        const sb_model_body *body = &part->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            if (part->walls.of[i] != SB_WALL_OWN) continue;
            assert_true(at < whole->begin + whole->count && same(part, i, &model, at));
            at++;
        }
        if (whole->wavemaker >= 0 && r + 1 < t->ranks) at = whole->begin; /* each rank has all of them */
    }
    assert_int_equal(at, whole->begin + whole->count);
}

static bool is_near_place(sb_vec3 at)
{
    for (size_t k = 0; k < PLACES; k++) {
        const double y = fmin(fmax(at.y, places[k].at.y), places[k].to.y); /* places lie along y */
        const double x = at.x - places[k].at.x;
        const bool wraps = !places[k].column && sb_scene_repeats(&scene, 0);
        const double flat = hypot(wraps ? remainder(x, scene.domain.max.x) : x, at.y - y);
        if ((places[k].column ? flat : hypot(flat, at.z - places[k].at.z)) < places[k].range) return true;
    }
    return false;
}

/* The place along the axis of the slabs, m. */
static double along(sb_vec3 at)
{
    return scene.domain.max.y > scene.domain.max.x ? at.y : at.x;
}

/* The particles of a body that a rank has are some of all, in order, among them those that it must have. Returns the
   number of those that are neither own nor beside them. */
static size_t check_here(const sb_model *part, size_t b)
{
    const sb_model_body *whole = &model.bodies[b], *body = &part->bodies[b];
    double low = (double)INFINITY, high = -low;
    size_t i = body->begin, guests = 0;
    for (size_t k = 0; k < part->bodies[part->body_count - 1].count; k++) {
        const size_t domain = part->bodies[part->body_count - 1].begin + k;
        if (part->walls.of[domain] != SB_WALL_OWN) continue;
        low = fmin(low, along(part->wall_position[domain]));
        high = fmax(high, along(part->wall_position[domain]));
    }
    for (size_t k = whole->begin; k < whole->begin + whole->count; k++) {
        const bool here = i < body->begin + body->count && same(part, i, &model, k);
        const sb_vec3 at = model.wall_position[k];
        /* Within 3 m of the particles of the domain that are the rank's own; a slab is more than 6 m. */
        if (is_near_place(at) || (along(at) > low - 3 && along(at) < high + 3)) assert_true(here);
        guests += here && part->walls.of[i] == SB_WALL_GUEST;
        i += here;
    }
    assert_int_equal(i, body->begin + body->count);
    return guests;
}

static void check_facts(const sb_model *part)
{
    assert_int_equal(part->wall_count, model.wall_count);
    assert_true(sb_model_hash(part) == sb_model_hash(&model));
    assert_int_equal(part->warning_count, model.warning_count);
    for (size_t w = 0; w < model.warning_count; w++) assert_string_equal(part->warnings[w], model.warnings[w]);
    for (size_t b = 0; b < model.body_count; b++) {
        const sb_model_body *whole = &model.bodies[b], *body = &part->bodies[b];
        assert_int_equal(sb_model_body_walls(part, b), whole->count);
        assert_true(body->gap == whole->gap && body->thin == whole->thin);
        if (whole->count == 0) continue;
        sb_vec3 low = model.wall_position[whole->begin], high = low;
        for (size_t i = whole->begin; i < whole->begin + whole->count; i++) {
            low = sb_min(low, model.wall_position[i]);
            high = sb_max(high, model.wall_position[i]);
        }
        assert_memory_equal(&body->low, &low, sizeof low);
        assert_memory_equal(&body->high, &high, sizeof high);
    }
}

/* Builds with so many ranks. Returns the most particles that a rank has. */
static size_t check_ranks(int ranks)
{
    team t = {.ranks = ranks, .places = places, .place_count = PLACES};
    size_t most = 0, guests = 0;
    team_build(&t);
    for (int r = 0; r < ranks; r++) {
        if (t.status[r] != SB_OK) fail_msg("rank %d: %s", r, t.error[r].text);
        assert_true(t.part[r].walls.divided);
        most = t.part[r].walls.here > most ? t.part[r].walls.here : most;
        for (size_t b = 0; b < model.body_count; b++) guests += check_here(&t.part[r], b);
        check_facts(&t.part[r]);
    }
    for (size_t b = 0; b < model.body_count; b++) check_own(&t, b);
    print_message("%d ranks: at most %zu of %zu boundary particles, %zu guests\n", ranks, most, model.wall_count,
                  guests);
    assert_true(scene.dimensions == 2 || guests > 0);
    team_free(&t);
    return most;
}

static void walls_are_sampled_in_parts(void **state)
{
    (void)state;
    flume();
    build();
    assert_true(warned("\"paddle\" moves, and near", "\"rear\""));
    assert_true(warned("the sum of their forces", "\"front\""));
    assert_true(warned("bodies \"left\" and \"right\" face each other", ""));
    assert_true(warned("body \"far\" has no surface", ""));
    check_ranks(2);
    check_ranks(3);
    assert_true(check_ranks(7) < 3 * model.wall_count / 4); /* three slabs, the paddle and guests */
    check_ranks(9);                                         /* there are fewer slabs */
}

/* Another axis, another spacing and images instead of particles; periodic across the slabs; two dimensions. */
static void other_flumes_too(void **state)
{
    (void)state;
    scene.domain.max = sb_vec(6, 40, 5);
    scene.numerics.walls = SB_WALLS_IMAGES;
    scene.numerics.wall_spacing = 0.8;
    scene.sea.seed = sb_vec(3, 1, 2);
    sb_body *ground = add_box("ground", sb_vec(-1, 10, -1), sb_vec(7, 30.3, 1.1));
    ground->role = SB_ROLE_TERRAIN;
    add_box("tower", sb_vec(2, 20, 0), sb_vec(3.1, 21.3, 9))->report = true;
    build();
    check_ranks(3);
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_PERIODIC;
    build();
    check_ranks(3);
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_WALL;
    scene.dimensions = 2;
    scene.domain.max = sb_vec(60, 0, 5);
    scene.sea.seed = sb_vec(3, 0, 2);
    scene.body_count = 0;
    add_box("step", sb_vec(20, -1, -1), sb_vec(41, 1, 1))->report = true;
    build();
    check_ranks(4);
}

/* Foam and dynamic boundary particles need all of them, and so do images beyond the ends of slabs' axis. */
static void some_scenes_keep_them_whole(void **state)
{
    (void)state;
    flume();
    assert_true(sb_model_divides_walls(&scene));
    scene.foam.enabled = true;
    assert_false(sb_model_divides_walls(&scene));
    scene.foam.enabled = false;
    scene.numerics.walls = SB_WALLS_DYNAMIC;
    assert_false(sb_model_divides_walls(&scene));
    scene.numerics.walls = SB_WALLS_PARTICLES;
    scene.domain.side[SB_Y_MIN] = scene.domain.side[SB_Y_MAX] = SB_SIDE_PERIODIC;
    assert_true(sb_model_divides_walls(&scene));
    scene.domain.side[SB_X_MIN] = scene.domain.side[SB_X_MAX] = SB_SIDE_PERIODIC;
    assert_false(sb_model_divides_walls(&scene));
    scene.body_count = 0;
    scene.wavemaker_count = 0;
    build();
    team t = {.ranks = 3};
    team_build(&t);
    assert_int_equal(t.status[2], SB_OK);
    assert_false(t.part[2].walls.divided);
    assert_int_equal(t.part[2].wall_count, model.wall_count);
    assert_true(sb_model_hash(&t.part[2]) == sb_model_hash(&model));
    team_free(&t);
}

/* A rank whose mesh is another one is found before the ranks exchange anything that depends on it. */
static void unequal_bodies_are_refused(void **state)
{
    (void)state;
    flume();
    sb_scene other = scene;
    sb_body others[16];
    memcpy(others, bodies, sizeof others);
    others[3].max.x += 0.01;
    other.bodies = others;
    team t = {.ranks = 3, .other = &other};
    team_build(&t);
    for (int r = 0; r < 3; r++) {
        assert_int_equal(t.status[r], SB_BAD_INPUT);
        assert_non_null(strstr(t.error[r].text, "another model than that of rank 0"));
    }
    team_free(&t);
}

static double much(const sb_scene *of, const sb_model *bodies_of)
{
    (void)of;
    (void)bodies_of;
    return 1e18;
}

/* What fails in one rank, before or within the sampling, fails in all with its reason. */
static void a_failure_is_that_of_all(void **state)
{
    (void)state;
    flume();
    team t = {.ranks = 3, .need = much};
    team_build(&t);
    for (int r = 0; r < 3; r++) {
        assert_int_equal(t.status[r], SB_BAD_INPUT);
        assert_non_null(strstr(t.error[r].text, "GB of memory"));
    }
    team_free(&t);
    sb_scene other = scene;
    other.numerics.time_step_rule = SB_TIME_STEP_DEPTH; /* refused by a check after the sampling, in rank 1 only */
    other.numerics.time_step_factor = 1;
    t = (team){.ranks = 2, .other = &other};
    team_build(&t);
    assert_int_equal(t.status[1], SB_BAD_INPUT);
    assert_non_null(strstr(t.error[1].text, "time_step_factor"));
    team_free(&t);
}

/* An allocation that fails in one rank, wherever it is, ends the building with its reason, and makes no rank wait for
   ever. The step is a prime, so that all parts of the building are met in turn. */
static void a_failed_allocation_ends_all(void **state)
{
    (void)state;
    flume();
    size_t failures = 0, common = 0;
    for (long n = 1;; n += 101) {
        team t = {.ranks = 3, .fail_at = n};
        team_build(&t);
        const bool pending = sb_memory_fail_pending();
        sb_memory_fail_at(0);
        int failed = 0;
        for (int r = 0; r < 3; r++) {
            failed += t.status[r] != SB_OK;
            if (t.status[r] != SB_OK) assert_non_null(strstr(t.error[r].text, "memory"));
        }
        team_free(&t);
        if (pending) {
            assert_int_equal(failed, 0);
            break;
        }
        assert_in_range(failed, 1, 3);
        failures++;
        common += failed == 3;
    }
    printf("%zu failures, %zu of all ranks\n", failures, common);
    assert_in_range(failures, 10, 10000);
    assert_true(common > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(walls_are_sampled_in_parts), CASE(other_flumes_too),         CASE(some_scenes_keep_them_whole),
        CASE(unequal_bodies_are_refused), CASE(a_failure_is_that_of_all), CASE(a_failed_allocation_ends_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

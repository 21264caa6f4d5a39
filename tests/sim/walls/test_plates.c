/* Push-plates: waves across a basin, which a paddle that is one cannot take, die out before plates that absorb on their
   own. Their row of columns covers the water, the forces on them are those on one body, the balances close, the state
   is saved and does not depend on threads. */
#include "../../check.h"
#include "base/archive.h"
#include "sim/tank.h"
#include "sim/walls/absorber.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Water in a basin of 0.8 x 1.6 m that is 0.06 m higher in one half: the lowest mode across it sloshes. */
static const char text[] = "resolution: 0.1\nduration: 30\n"
                           "domain: {min: [-0.6, 0, 0], max: [0.8, 1.6, 1.2]%s}\n"
                           "water:\n  boxes:\n"
                           "    - {min: [0, 0, 0], max: [0.8, 0.8, 1.2], level: 0.63}\n"
                           "    - {min: [0, 0.8, 0], max: [0.8, 1.6, 1.2], level: 0.57}\n"
                           "bodies:\n"
                           "  - {name: paddle, shape: box, %s}\n"
                           "wavemakers:\n"
                           "  - {name: taker, body: paddle, kind: absorber, depth: 0.6, period: 1.5%s}\n"
                           "numerics: {settle_steps: 60, walls: %s}\n";

static const char whole_box[] = "min: [-0.5, 0, 0], max: [0, 1.6, 1.2]";
static const char *box = whole_box;

typedef struct basin {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
} basin;

static sb_status read_scene(const char *sides, const char *plates, const char *walls, sb_scene *scene, sb_error *error)
{
    const char *path = SB_BINARY_DIR "/plates.yaml";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, text, sides, box, plates, walls);
    assert_int_equal(fclose(file), 0);
    return sb_scene_read(path, NULL, NULL, 0, scene, error);
}

static void make(basin *b, const char *sides, const char *plates, const char *walls)
{
    sb_error error = {0};
    *b = (basin){0};
    if (read_scene(sides, plates, walls, &b->scene, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_model_build(&b->scene, &b->model, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_create(&b->scene, &b->model, NULL, &b->sim, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_settle(b->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

static void open_scene(basin *b, const char *path)
{
    sb_error error = {0};
    *b = (basin){0};
    if (sb_scene_read(path, NULL, NULL, 0, &b->scene, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_model_build(&b->scene, &b->model, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_create(&b->scene, &b->model, NULL, &b->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

static void free_basin(basin *b)
{
    sb_sim_destroy(b->sim);
    sb_model_free(&b->model);
    sb_scene_free(&b->scene);
}

/* Root mean square over a time of the distance of the water's centre from the basin's middle across it, m: that of the
   lowest mode. *imbalance: the largest of momentum. */
static double slosh_until(basin *b, double from, double to, double *imbalance)
{
    double sum = 0;
    int count = 0;
    while (sb_sim_report(b->sim)->time < to) {
        double y = 0;
        assert_int_equal(tank_steps(b->sim, 1), 0);
        *imbalance = fmax(*imbalance, sb_sim_report(b->sim)->momentum_imbalance);
        if (sb_sim_report(b->sim)->time < from) continue;
        for (size_t i = 0; i < b->sim->state.n; i++)
            y += sb_space_position(&b->sim->space, b->sim->state.position[i]).y / (double)b->sim->state.n;
        sum += (y - 0.8) * (y - 0.8);
        count++;
    }
    return sqrt(sum / count);
}

static const char *const plates_of[] = {"", ", plates: {width: 0.4}"};

static void plates_take_waves_across(void **state)
{
    (void)state;
    for (int particles = 0; particles <= 1; particles++) {
        double last[2];
        for (int plates = 0; plates <= 1; plates++) {
            basin b;
            double imbalance = 0;
            make(&b, "", plates_of[plates], particles ? "particles, density: summed, stress_correction: 0" : "images");
            const double first = slosh_until(&b, 0, 1.5, &imbalance);
            last[plates] = slosh_until(&b, 5, 6.6, &imbalance);
            const sb_absorption one = sb_sim_absorption(b.sim, 0);
            printf("walls of %s, plates %llu: slosh %.4g, then %.4g m; farthest %.3g m, apart %.3g m; lost %llu; "
                   "momentum %.2g\n",
                   particles ? "particles" : "images", (unsigned long long)one.plates, first, last[plates],
                   one.farthest, one.apart, (unsigned long long)sb_sim_report(b.sim)->lost, imbalance);
            assert_true(one.plates == (plates ? 4u : 0u));
            assert_true(sb_sim_report(b.sim)->lost == 0 && one.limited == 0);
            assert_true(imbalance < 1e-5);
            sb_frame *frame = sb_sim_snapshot(b.sim);
            assert_non_null(frame);
            sb_vec3 moved[8] = {{0}};
            for (size_t k = 0; k < frame->body_count; k++) moved[k] = frame->bodies[k].displacement;
            sb_inside_report inside;
            sb_error error = {0};
            assert_int_equal(sb_model_first_inside(&b.model, frame->position, frame->count, frame->origin, moved, 0.05,
                                                   &inside, &error),
                             SB_OK);
            assert_true(inside.count == 0);
            sb_frame_release(frame);
            free_basin(&b);
        }
        assert_true(last[1] < (particles ? 0.6 : 0.4) * last[0]);
    }
}

/* The mean over all plates of the depths before them is the volume before the row over its width, and the forces on the
   plates are on the first. */
static void plates_are_one_body(void **state)
{
    (void)state;
    const char *const sides[] = {"", ", sides: {y_min: periodic, y_max: periodic}"};
    for (int k = 0; k < 2; k++) {
        basin b;
        make(&b, sides[k], plates_of[1], "images");
        assert_int_equal(b.model.body_count, 5);
        assert_true(b.model.bodies[0].report && strcmp(b.model.bodies[0].name, "paddle") == 0);
        assert_int_equal(tank_steps(b.sim, 20), 0);
        double sum = 0, whole = 0;
        for (size_t p = 0; p < 4; p++) sum += b.sim->walls.moving[p].absorber->depth;
        for (size_t i = 0; i < b.sim->state.n; i++) {
            const sb_vec3 at = sb_space_position(&b.sim->space, b.sim->state.position[i]);
            whole += sb_column_weight((at.x - 0.3) / 0.15) / 0.15 * 0.001 / 1.6;
        }
        printf("depth %.6g m, by plates %.6g m\n", whole, sum / 4);
        /* The particles have moved by one step since, and the plates by less than 1 mm. */
        assert_true(fabs(sum / 4 - whole) < 2e-3 * whole);
        const sb_vec3 force = sb_sim_impulse(b.sim, 0)->pressure;
        const double weight = 0.5 * 1000 * 9.81 * 0.6 * 0.6 * 1.6 * sb_sim_report(b.sim)->time;
        printf("impulse %.4g N s, of still water %.4g N s\n", -force.x, weight);
        assert_true(fabs(-force.x - weight) < 0.1 * weight);
        for (size_t p = 1; p < 4; p++) {
            assert_true(sb_norm(sb_sim_impulse(b.sim, p)->pressure) == 0);
            assert_false(b.model.bodies[p].report || sb_sim_absorption(b.sim, p).absorbs);
        }
        free_basin(&b);
    }
}

/* A paddle that is one reads the depth of its water: also if its box is wider than the basin, thinner than a spacing,
   or ends at periodic sides. */
static void a_paddle_reads_its_depth(void **state)
{
    (void)state;
    static const struct {
        const char *sides, *box;
    } cases[] = {
        {"", "min: [-0.5, 0, 0], max: [0, 1.6, 1.2]"},
        {"", "min: [-0.5, -1, 0], max: [0, 2.4, 1.2]"},
        {"", "min: [-0.06, -0.3, 0], max: [0, 1.6, 1.2]"},
        {", sides: {y_min: periodic, y_max: periodic}", "min: [-0.5, 0, 0], max: [0, 1.6, 1.2]"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        basin b;
        box = cases[k].box;
        make(&b, cases[k].sides, "", "images");
        assert_int_equal(tank_steps(b.sim, 1), 0);
        const sb_absorber *a = b.sim->walls.moving[0].absorber;
        printf("face at %.4g m, from %.4g to %.4g m: depth %.4g m\n", a->face, a->from[0], a->from[1], a->depth);
        assert_near(a->face, 0, 1e-6);
        assert_near(a->from[1] - a->from[0], 1.6, 1e-6);
        assert_near(a->depth, 0.6, 0.006);
        free_basin(&b);
    }
    box = whole_box;
}

/* A row of two repeats as well: each plate is the other's neighbour on both sides. */
static void two_plates_repeat(void **state)
{
    (void)state;
    const char *const sides[] = {"", ", sides: {y_min: periodic, y_max: periodic}"};
    double apart[2];
    for (int k = 0; k < 2; k++) {
        basin b;
        make(&b, sides[k], ", plates: {width: 0.8}", "images");
        assert_int_equal(b.sim->walls.moving[0].absorber->plates, 2);
        assert_int_equal(tank_steps(b.sim, 1), 0);
        const double one = b.sim->walls.moving[0].absorber->depth, other = b.sim->walls.moving[1].absorber->depth;
        assert_near(0.5 * (one + other), 0.6, 0.006);
        apart[k] = one - other;
        free_basin(&b);
    }
    /* The window is a B-spline two plates wide, of which 1/24 is beyond each end of its plate. */
    printf("depths apart by %.4g m between walls, %.4g m between periodic sides\n", apart[0], apart[1]);
    assert_near(apart[1] / apart[0], (1 - 4.0 / 24) / (1 - 2.0 / 24), 0.02);
}

/* The initial wave is no wave that has come in: a paddle at the crest of a standing wave lets the water rest at its
   level, with one face and in plates. */
static void initial_waves_are_known(void **state)
{
    (void)state;
    const char *const plates[] = {"", ", plates: {width: 0.4}"};
    for (int k = 0; k < 2; k++) {
        const char *path = SB_BINARY_DIR "/crest.yaml";
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "resolution: 0.04\nduration: 3\ndomain: {min: [-0.7, 0, 0], max: [2, 0.8, 1]}\n"
                "water: {level: 0.5, seed: [0.5, 0.3, 0.2], wave: {kind: standing, height: 0.05, wavelength: 4, depth: "
                "0.5, position: 0}}\n"
                "bodies:\n  - {name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 0.8, 0.9]}\n"
                "wavemakers:\n  - {name: taker, body: paddle, kind: absorber, depth: 0.5, period: 2%s}\n",
                plates[k]);
        assert_int_equal(fclose(file), 0);
        basin b;
        open_scene(&b, path);
        assert_int_equal(tank_steps(b.sim, 2), 0);
        const sb_absorber *a = b.sim->walls.moving[0].absorber;
        printf("depth at the crest %.4g m, at rest %.4g m\n", a->depth, a->still);
        assert_true(a->depth > 0.53);
        assert_near(a->still, 0.5, 0.006);
        free_basin(&b);
    }
}

/* A body of the scene with the name of a plate would take its place in the tables. */
static void plates_have_their_names_alone(void **state)
{
    (void)state;
    const char *path = SB_BINARY_DIR "/names.yaml";
    for (int second = 2; second <= 3; second++) {
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "resolution: 0.1\nduration: 3\ndomain: {min: [-0.7, 0, 0], max: [3, 0.8, 1]}\n"
                "water: {level: 0.5, seed: [0.5, 0.3, 0.2]}\nbodies:\n"
                "  - {name: paddle-%d, shape: box, min: [2.5, 0, 0], max: [3, 0.8, 0.9]}\n"
                "  - {name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 0.8, 0.9]}\n"
                "wavemakers:\n  - {name: taker, body: paddle, kind: absorber, depth: 0.5, period: 2, plates: {width: "
                "0.4}}\n"
                "  - {name: other, body: paddle-%d, kind: absorber, depth: 0.5, period: 2, direction: [-1, 0, 0]}\n",
                second, second);
        assert_int_equal(fclose(file), 0);
        sb_scene scene;
        sb_model model = {0};
        sb_error error = {0};
        if (sb_scene_read(path, NULL, NULL, 0, &scene, &error) != SB_OK) fail_msg("%s", error.text);
        const sb_status status = sb_model_build(&scene, &model, &error);
        if (second == 2) {
            assert_int_equal(status, SB_BAD_INPUT);
            if (!strstr(error.text, "names.yaml: body \"paddle-2\": part 2 of the paddle \"paddle\" has this name"))
                fail_msg("%s", error.text);
        } else { /* the paddle has two plates */
            if (status != SB_OK) fail_msg("%s", error.text);
            sb_vec3 low = {0}, high = {0};
            assert_int_equal(model.bodies[0].wavemaker, 1);
            assert_int_equal(model.bodies[2].wavemaker, 0);
            assert_true(sb_model_box(&model, 1, &low, &high)); /* the whole paddle */
            assert_near(low.y, 0, 1e-9);
            assert_near(high.y, 0.8, 1e-9);
            assert_true(sb_model_box(&model, 2, &low, &high)); /* its second plate */
            assert_near(low.y, 0.4, 1e-9);
        }
        sb_model_free(&model);
        sb_scene_free(&scene);
    }
}

/* A row that does not end at the periodic sides has ends: the first and the last plate are no neighbours. */
static void a_short_row_does_not_repeat(void **state)
{
    (void)state;
    const char *const periodic = ", sides: {y_min: periodic, y_max: periodic}";
    basin b;
    make(&b, periodic, plates_of[1], "images");
    assert_true(sb_absorber_repeats(&b.scene, b.sim->walls.moving[0].absorber));
    free_basin(&b);
    box = "min: [-0.5, 0.2, 0], max: [0, 1.4, 1.2]";
    make(&b, periodic, plates_of[1], "images");
    assert_false(sb_absorber_repeats(&b.scene, b.sim->walls.moving[0].absorber));
    free_basin(&b);
    box = whole_box;
}

/* Still water stays still where the bed is not even along the row: half of the plates face a quay, two of them a step
   of half of the depth. */
static void plates_rest_before_an_uneven_bed(void **state)
{
    (void)state;
    const char *const kinds[] = {"kind: absorber", "kind: regular, height: 0.06, absorb: true"};
    for (int makes = 0; makes < 2; makes++) {
        const char *path = SB_BINARY_DIR "/uneven.yaml";
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "resolution: 0.1\nduration: 3\ndomain: {min: [-0.7, 0, 0], max: [2, 2.4, 1]}\n"
                "water: {level: 0.6, seed: [0.5, 0.3, 0.2]}\nbodies:\n"
                "  - {name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 2.4, 0.9]}\n"
                "  - {name: quay, shape: box, min: [0.2, 1.6, 0], max: [2, 2.4, 0.9]}\n"
                "  - {name: step, shape: box, min: [0, 0.8, 0], max: [2, 1.6, 0.3]}\n"
                "wavemakers:\n  - {name: taker, body: paddle, %s, depth: 0.6, period: 2, plates: {width: "
                "0.4}}\n",
                kinds[makes]);
        assert_int_equal(fclose(file), 0);
        basin b;
        sb_error error = {0};
        open_scene(&b, path);
        if (sb_sim_settle(b.sim, &error) != SB_OK) fail_msg("%s", error.text);
        while (sb_sim_report(b.sim)->time < 1) assert_int_equal(tank_steps(b.sim, 1), 0);
        const sb_absorption one = sb_sim_absorption(b.sim, 0);
        printf("plates %zu: farthest %.3g m, apart %.3g m after 1 s\n", one.plates, one.farthest, one.apart);
        for (size_t p = 0; p < one.plates; p++) {
            const sb_absorber *a = b.sim->walls.moving[p].absorber;
            printf("  plate %zu: still %.3g m, offset %.3g m\n", p, a->still, a->state.offset);
        }
        /* A hundredth of the depth; by the row's mean depth 0.15 m. */
        assert_true(makes || one.farthest < 0.006);
        for (size_t p = 4; p < 6; p++) {
            const sb_absorber *a = b.sim->walls.moving[p].absorber;
            assert_true(a->still == 0 && a->state.offset == 0);
        }
        free_basin(&b);
    }
}

/* No plate is narrower than three spacings, though their number is a whole one. */
static void plates_are_three_spacings_wide(void **state)
{
    (void)state;
    static const struct {
        const char *box;
        size_t count;
    } cases[] = {{"min: [-0.5, 0, 0], max: [0, 1.1, 1.2]", 3},
                 {"min: [-0.5, 0, 0], max: [0, 0.46, 1.2]", 1},
                 {"min: [-0.5, 0, 0], max: [0, 1.6, 1.2]", 5}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sb_scene scene;
        sb_plate_row row;
        sb_error error = {0};
        box = cases[k].box;
        if (read_scene("", ", plates: {width: 0.3}", "images", &scene, &error) != SB_OK) fail_msg("%s", error.text);
        assert_int_equal(sb_scene_plates(&scene, &scene.wavemakers[0], &row), cases[k].count);
        sb_scene_free(&scene);
    }
    box = whole_box;
}

/* A height divides a plate into plates that move as one: the water is that without it, bit for bit. */
static void plates_above_each_other_move_as_one(void **state)
{
    (void)state;
    basin divided, whole;
    sb_plate_row row;
    make(&divided, "", ", plates: {width: 0.4, height: 0.4}", "images");
    make(&whole, "", plates_of[1], "images");
    assert_int_equal(sb_scene_plates(&whole.scene, &whole.scene.wavemakers[0], &row), 4);
    assert_int_equal(row.levels, 1);
    assert_int_equal(sb_scene_plates(&divided.scene, &divided.scene.wavemakers[0], &row), 4);
    assert_int_equal(row.levels, 3);
    assert_int_equal(tank_steps(divided.sim, 20), 0);
    assert_int_equal(tank_steps(whole.sim, 20), 0);
    assert_true(sb_sim_hash(divided.sim) == sb_sim_hash(whole.sim));
    free_basin(&divided);
    free_basin(&whole);
}

static uint64_t run(basin *b, int threads, int steps)
{
    omp_set_num_threads(threads);
    assert_int_equal(tank_steps(b->sim, steps), 0);
    return sb_sim_hash(b->sim);
}

static void state_is_saved_and_independent_of_threads(void **state)
{
    (void)state;
    const int before = omp_get_max_threads();
    basin a, b;
    make(&a, "", plates_of[1], "images");
    make(&b, "", plates_of[1], "images");
    run(&a, 1, 30);
    sb_archive_out out = {0};
    tank_save(a.sim, &out);
    const uint64_t whole = run(&a, 1, 20);
    assert_true(run(&b, 3, 50) == whole);
    sb_error error = {0};
    if (tank_load(b.sim, &out, &error) != SB_OK) fail_msg("%s", error.text);
    assert_true(run(&b, 2, 20) == whole);
    omp_set_num_threads(before);
    sb_archive_out_free(&out);
    free_basin(&a);
    free_basin(&b);
}

static void unfit_plates_are_refused(void **state)
{
    (void)state;
    const struct {
        const char *plates, *expected;
    } cases[] = {
        {", plates: {width: 0.2}", "at least 3 spacings"},
        {", plates: {width: 0.4}, direction: [1, 1, 0]", "is oblique"},
        {", plates: {width: 0.4, height: 0.2}", "0.2 m high, expected at least 3 spacings"},
        {", plates: {height: 0.4}", "height without a width"},
        {", plates: {width: -1}", "expected"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sb_scene scene;
        sb_error error = {0};
        assert_int_equal(read_scene("", cases[k].plates, "images", &scene, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[k].expected)) fail_msg("%s: %s", cases[k].plates, error.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates_take_waves_across),
        cmocka_unit_test(plates_are_one_body),
        cmocka_unit_test(plates_above_each_other_move_as_one),
        cmocka_unit_test(a_paddle_reads_its_depth),
        cmocka_unit_test(a_short_row_does_not_repeat),
        cmocka_unit_test(plates_are_three_spacings_wide),
        cmocka_unit_test(state_is_saved_and_independent_of_threads),
        cmocka_unit_test(two_plates_repeat),
        cmocka_unit_test(initial_waves_are_known),
        cmocka_unit_test(plates_have_their_names_alone),
        cmocka_unit_test(unfit_plates_are_refused),
        cmocka_unit_test(plates_rest_before_an_uneven_bed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

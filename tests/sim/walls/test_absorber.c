/* Paddles that absorb: a wave group between two of them dies out, one between paddles that do not stays. The state is
   saved, and does not depend on threads. */
#include "../../check.h"
#include "base/archive.h"
#include "sim/tank.h"
#include "sim/walls/absorber.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>

static const char text[] = "dimensions: 2\nresolution: 0.1\nduration: 30\n"
                           "domain: {min: [-1, 0], max: [9.3, 2]}\n"
                           "water: {level: 1.0, seed: [2, 0.5]}\n"
                           "bodies:\n"
                           "  - {name: near, shape: box, min: [-0.4, 0], max: [0, 1.8]}\n"
                           "  - {name: far, shape: box, min: [8.3, 0], max: [8.7, 1.8]}\n"
                           "wavemakers:\n"
                           "  - {name: waves, body: near, kind: regular, height: 0.15, depth: 1, period: 2.3, lasts: 7,"
                           " ramp: 2.3, absorb: true}\n"
                           "  - {name: taker, body: far, kind: absorber, depth: 1, period: 2.3, direction: [-1, 0]}\n";

typedef struct flume {
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    double sum, elapsed, mean; /* of the near paddle's displacement from its law: integral, time, mean of ten periods */
} flume;

static const double TEN_PERIODS = 23;

static void make(flume *f, bool absorb)
{
    const char *path = SB_BINARY_DIR "/absorber.yaml";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
    sb_error error = {0};
    *f = (flume){0};
    if (sb_scene_read(path, NULL, NULL, 0, &f->scene, &error) != SB_OK) fail_msg("%s", error.text);
    if (!absorb)
        for (size_t w = 0; w < f->scene.wavemaker_count; w++) f->scene.wavemakers[w].law.absorb = false;
    if (!absorb) f->scene.wavemakers[1].law = f->scene.wavemakers[0].law;
    if (!absorb) f->scene.wavemakers[1].law.start = 1e6;
    if (sb_model_build(&f->scene, &f->model, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_create(&f->scene, &f->model, NULL, &f->sim, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_settle(f->sim, &error) != SB_OK) fail_msg("%s", error.text);
}

static void free_flume(flume *f)
{
    sb_sim_destroy(f->sim);
    sb_model_free(&f->model);
    sb_scene_free(&f->scene);
}

/* Mean kinetic energy over a time, J/m. */
static double kinetic_until(flume *f, double from, double to)
{
    double sum = 0;
    int count = 0;
    while (sb_sim_report(f->sim)->time < to) {
        assert_int_equal(tank_steps(f->sim, 1), 0);
        const double dt = f->sim->state.time_step;
        f->sum += sb_sim_absorption(f->sim, 0).offset * dt;
        f->elapsed += dt;
        if (f->elapsed - dt < TEN_PERIODS) f->mean = f->sum / f->elapsed; /* up to the step that ends them */
        if (sb_sim_report(f->sim)->time < from) continue;
        sum += sb_sim_energy(f->sim).kinetic;
        count++;
    }
    return sum / count;
}

static void waves_between_absorbers_die_out(void **state)
{
    (void)state;
    double share[2];
    for (int absorb = 0; absorb <= 1; absorb++) {
        flume f;
        make(&f, absorb);
        const double first = kinetic_until(&f, 4, 6), last = kinetic_until(&f, 19, 23);
        const sb_absorption one = sb_sim_absorption(f.sim, 0), other = sb_sim_absorption(f.sim, 1);
        share[absorb] = last / first;
        printf("absorb %d: kinetic energy %.4g, then %.4g J/m; farthest %.3g and %.3g m, at the end %.3g and %.3g m\n",
               absorb, first, last, one.farthest, other.farthest, one.offset, other.offset);
        assert_int_equal(one.absorbs, absorb);
        if (absorb) printf("drift %.4g m, by the test %.4g m\n", one.drift, f.mean);
        if (absorb) assert_true(fabs(one.drift - f.mean) < 1e-9 && fabs(one.drift_most - fabs(one.drift)) < 1e-9);
        if (absorb) assert_true(fmax(one.farthest, other.farthest) > 0.01 && one.limited == 0 && other.limited == 0);
        free_flume(&f);
    }
    assert_true(share[0] > 0.3);
    assert_true(share[1] < 0.03);
}

/* The waves come back with more than the 3 cm that the far paddle has behind it. */
static void the_domain_stops_a_paddle(void **state)
{
    (void)state;
    flume f;
    make(&f, true);
    sb_absorber *far = f.sim->walls.moving[f.sim->walls.moving_of_body[1]].absorber;
    assert_near(far->behind, 9.3 - 8.7, 1e-6);
    assert_near(far->ahead, 8.3 + 1, 1e-6);
    far->behind = 0.03;
    double least = 0;
    while (sb_sim_report(f.sim)->time < 14) {
        assert_int_equal(tank_steps(f.sim, 1), 0);
        least = fmin(least, sb_sim_absorption(f.sim, 1).offset);
    }
    const uint64_t limited = sb_sim_absorption(f.sim, 1).limited;
    printf("stopped %.4g m behind its law, in %llu steps\n", -least, (unsigned long long)limited);
    assert_near(least, -0.03, 1e-9);
    assert_true(limited > 0);
    free_flume(&f);
}

static uint64_t run(flume *f, int threads, int steps)
{
    omp_set_num_threads(threads);
    assert_int_equal(tank_steps(f->sim, steps), 0);
    return sb_sim_hash(f->sim);
}

static void state_is_saved_and_independent_of_threads(void **state)
{
    (void)state;
    const int before = omp_get_max_threads();
    flume f, g;
    make(&f, true);
    make(&g, true);
    run(&f, 1, 150);
    sb_archive_out out = {0};
    tank_save(f.sim, &out);
    const uint64_t whole = run(&f, 1, 100);
    assert_true(run(&g, 3, 250) == whole);
    sb_error error = {0};
    if (tank_load(g.sim, &out, &error) != SB_OK) fail_msg("%s", error.text);
    assert_true(run(&g, 2, 100) == whole);
    omp_set_num_threads(before);
    sb_archive_out_free(&out);
    free_flume(&f);
    free_flume(&g);
}

/* A run frees the model's boundary particles once it has a simulation, and then looks for crowded facets. */
static void crowding_is_found_without_boundary_particles(void **state)
{
    (void)state;
    flume f;
    sb_crowding found;
    sb_error error = {0};
    make(&f, true);
    sb_model_free_walls(&f.model);
    assert_true(f.model.facets.count > 0);
    assert_int_equal(sb_sim_find_crowding(&f.scene, &f.model, &found, &error), SB_OK);
    assert_int_equal(found.places, 0);
    assert_int_equal(tank_steps(f.sim, 1), 0);
    free_flume(&f);
}

/* Rows of particles one spacing apart have the same depth wherever they lie before the face. */
static void the_window_does_not_see_rows(void **state)
{
    (void)state;
    for (double first = 0; first < 1; first += 0.0625) {
        double sum = 0;
        for (int k = -5; k <= 5; k++) sum += sb_column_window(first + k);
        assert_true(fabs(sum - 1) < 1e-12);
    }
    assert_true(sb_column_window(3) == 0 && sb_column_window(2.9) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_window_does_not_see_rows),
        cmocka_unit_test(crowding_is_found_without_boundary_particles),
        cmocka_unit_test(waves_between_absorbers_die_out),
        cmocka_unit_test(the_domain_stops_a_paddle),
        cmocka_unit_test(state_is_saved_and_independent_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

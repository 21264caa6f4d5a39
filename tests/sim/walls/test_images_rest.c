/* Walls that reflect water: loads of still water on blocks, and a bed that is too fine. */
#include "base/random.h"
#include "check.h"
#include "sim/walls/basin.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The force on a block that stands on the floor is 0. So is the mean force on two blocks one spacing apart; the water
   between them oscillates. */
static void check_blocks(const char *bodies, const char *max, double most)
{
    basin b;
    basin_fill(&b, 3, "0.075", max, "{level: 0.45, seed: [0.1, 0.1, 0.1]}", bodies, "completed");
    basin_settle(&b);
    const double face = 0.5 * 9810 * 0.45 * 0.45 * 0.3, weight = 9810 * 0.3 * 0.3 * 0.45;
    assert_int_equal(tank_steps(b.sim, 100), 0);
    for (size_t body = 0; body + 1 < b.model.body_count; body++) {
        const sb_vec3 f = sb_scale(sb_sim_impulse(b.sim, body)->pressure, 1 / sb_sim_report(b.sim)->time);
        printf("%s: force %.2g, %.2g of a face's load, %.2g of the displaced weight\n", b.model.bodies[body].name,
               f.x / face, f.y / face, f.z / weight);
        assert_true(fabs(f.x) < most * face && fabs(f.y) < most * face);
        assert_true(fabs(f.z) < 1e-4 * weight);
    }
    basin_free(&b);
}

static void still_water_exerts_no_force_on_blocks(void **state)
{
    (void)state;
    check_blocks("[{name: a, shape: box, min: [0.4, 0.3, 0], max: [0.7, 0.6, 0.8]}]", "[1.05, 0.9, 0.8]", 0.02);
    check_blocks("[{name: a, shape: box, min: [0.225, 0.3, -0.2], max: [0.525, 0.6, 0.8]},"
                 " {name: b, shape: box, min: [0.6, 0.3, -0.2], max: [0.9, 0.6, 0.8]}]",
                 "[1.125, 0.9, 0.8]", 0.05);
}

/* Mean square of the speed over gD after 200 steps from rest, in water three spacings deep before a pier. */
static double motion_before_pier(const char *back)
{
    basin b;
    char bodies[512];
    snprintf(bodies, sizeof bodies,
             "[{name: quay, shape: box, min: [0.9, -0.1, -0.2], max: [1.3, 1.3, 0.8]},"
             " {name: pier, shape: box, min: [0.6, 0.525, -0.2], max: [0.9, 0.675, 0.8]}%s]",
             back);
    basin_fill(&b, 3, "0.075", "[1.2, 1.2, 0.8]", "{level: 0.225, seed: [0.1, 0.1, 0.1]}", bodies, "completed");
    basin_settle(&b);
    assert_int_equal(tank_steps(b.sim, 200), 0);
    double square = 0;
    for (size_t i = 0; i < b.sim->state.n; i++) {
        const sb_f4 v = b.sim->state.velocity[i];
        square += (double)sb_sum3(v * v) / (double)b.sim->state.n;
    }
    basin_free(&b);
    return square / (9.81 * 0.225);
}

/* Water before a pier of two spacings does not see the back of the recess behind it, whose plane cuts this water. */
static void a_pier_hides_the_recess_behind_it(void **state)
{
    (void)state;
    const double alone = motion_before_pier("");
    const double recess =
        motion_before_pier(", {name: back, shape: box, min: [0.75, 0.675, -0.2], max: [0.9, 1.3, 0.8]}");
    printf("speed: %.2g of sqrt(gD), with a recess behind the pier %.2g\n", sqrt(alone), sqrt(recess));
    assert_true(sqrt(alone) < 0.01 && sqrt(recess) < 0.01);
}

/* Water over a gentle slope that stands on the domain's own floor: the floor behind the slope reflects nothing. */
static void the_floor_ends_at_the_foot_of_a_slope(void **state)
{
    (void)state;
    basin b;
    basin_fill(&b, 2, "0.05", "[4, 1]", "{level: 0.5, seed: [0.2, 0.2]}",
               "[{name: slope, shape: box, min: [0, -2], max: [4, 0], rotate: [0, -10, 0], translate: [1.2, 0, 0]}]",
               "completed");
    basin_settle(&b);
    assert_int_equal(tank_steps(b.sim, 400), 0);
    double square = 0;
    for (size_t i = 0; i < b.sim->state.n; i++) {
        const sb_f4 v = b.sim->state.velocity[i];
        square += (double)sb_sum3(v * v) / (double)b.sim->state.n;
    }
    printf("speed over a slope on the floor: %.2g of sqrt(gD)\n", sqrt(square / (9.81 * 0.5)));
    assert_true(sqrt(square / (9.81 * 0.5)) < 0.01);
    basin_free(&b);
}

/* A bed of 40 x 40 squares of 0.3 spacings, whose corners are at random heights up to `high` (m). Returns the
   key "bodies". */
static const char *fine_bed(double high, char path[256], char bodies[512])
{
    enum { COLUMNS = 40 };
    snprintf(path, 256, "%s/images-fine-%d.obj", SB_BINARY_DIR, (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int y = 0; y <= COLUMNS; y++)
        for (int x = 0; x <= COLUMNS; x++) {
            const double share = sb_random(3, (uint64_t)(100 * x + y));
            fprintf(file, "v %g %g %g\n", -0.1 + 0.03 * x, -0.1 + 0.03 * y, 0.1 + high * share);
        }
    for (int y = 0; y < COLUMNS; y++)
        for (int x = 0; x < COLUMNS; x++) {
            const int at = y * (COLUMNS + 1) + x + 1, above = at + COLUMNS + 1;
            fprintf(file, "f %d %d %d\nf %d %d %d\n", at, at + 1, above, at + 1, above + 1, above);
        }
    assert_int_equal(fclose(file), 0);
    snprintf(bodies, 512, "[{name: bed, shape: mesh, role: terrain, file: %s}]", path);
    return bodies;
}

/* A bed whose facets are finer than the particles, but less than 0.1 spacings high, is simplified. */
static void a_bed_of_fine_facets_is_simplified(void **state)
{
    (void)state;
    char path[256], bodies[512];
    basin b;
    sb_crowding found;
    sb_error error = {0};
    basin_fill(&b, 3, "0.1", "[1, 1, 0.8]", "{level: 0.5, seed: [0.5, 0.5, 0.3]}", fine_bed(0.008, path, bodies),
               "completed");
    remove(path);
    printf("%zu facets of 3200 triangles\n", b.model.facets.count);
    assert_true(b.model.facets.count < 600);
    assert_int_equal(sb_sim_find_crowding(&b.scene, &b.model, &found, &error), SB_OK);
    assert_int_equal(found.places, 0);
    assert_int_equal(tank_steps(b.sim, 1), 0);
    basin_free(&b);
}

/* A bed that is finer and rougher than the particles can see is refused in one line that names the remedy. */
static void a_bed_of_too_fine_facets_is_refused(void **state)
{
    (void)state;
    char path[256], bodies[512];
    basin b;
    basin_fill(&b, 3, "0.2", "[1, 1, 0.8]", "{level: 0.5, seed: [0.5, 0.5, 0.35]}", fine_bed(0.1, path, bodies),
               "completed");
    remove(path);
    sb_error error = {0};
    sb_crowding found;
    assert_int_equal(sb_sim_find_crowding(&b.scene, &b.model, &found, &error), SB_OK);
    printf("%zu facets, %zu crowded places, the first at z = %g\n", b.model.facets.count, found.places, found.first.z);
    assert_true(found.places > 0 && found.first.z < 0.8); /* known before the run */
    assert_int_equal(sb_sim_step(b.sim, &error), SB_FAILED);
    printf("%s\n", error.text);
    assert_non_null(strstr(error.text, "too many facets of walls"));
    assert_non_null(strstr(error.text, "numerics.preset: paper"));
    basin_free(&b);
}

/* Ten layers of water over a bar, 4 spacings wide and 1.5 high, at rest. Forces at its edges that are not those of a
   potential would drive a pair of vortices above it. */
static void water_over_a_bar_rests(void **state)
{
    (void)state;
    basin b;
    basin_fill(&b, 2, "0.1", "[4, 1.3]", "{level: 1, seed: [0.2, 0.5]}",
               "[{name: bar, shape: box, min: [1.8, -1], max: [2.2, 0.15]}]", "completed");
    basin_settle(&b);
    double square = 0;
    assert_int_equal(tank_steps(b.sim, 400), 0); /* 9 s */
    for (int part = 0; part < 10; part++) {      /* 5 s */
        assert_int_equal(tank_steps(b.sim, 20), 0);
        for (size_t i = 0; i < b.sim->state.n; i++) {
            const sb_f4 v = b.sim->state.velocity[i];
            square += (double)sb_sum3(v * v) / (10 * (double)b.sim->state.n);
        }
    }
    printf("water over a bar: speed %.3f %% of sqrt(gD)\n", 100 * sqrt(square / 9.81));
    assert_true(sqrt(square / 9.81) < 0.003);
    basin_free(&b);
}

/* Five layers of water at rest between a wall and the tank, whose floor is another body than the wall. Of the images by
   both the floor takes the push of those below it: the wall has the load of still water. */
static void a_wall_on_another_bodys_floor(void **state)
{
    (void)state;
    basin b;
    basin_fill(&b, 2, "0.1", "[3, 1]", "{level: 0.5, seed: [2, 0.2]}",
               "[{name: wall, shape: box, min: [-1, -1], max: [1, 2]}]", "completed");
    basin_settle(&b);
    assert_int_equal(tank_steps(b.sim, 400), 0);
    const double time = sb_sim_report(b.sim)->time, load = 0.5 * 9810 * 0.5 * 0.5;
    const double force = sb_sim_impulse(b.sim, 0)->pressure.x / time;
    printf("wall of body %s: %.4f of the load of still water\n", b.model.bodies[0].name, -force / load);
    assert_string_equal(b.model.bodies[0].name, "wall");
    assert_true(fabs(-force / load - 1) < 0.007);
    basin_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_water_exerts_no_force_on_blocks), cmocka_unit_test(a_pier_hides_the_recess_behind_it),
        cmocka_unit_test(the_floor_ends_at_the_foot_of_a_slope), cmocka_unit_test(a_bed_of_fine_facets_is_simplified),
        cmocka_unit_test(a_bed_of_too_fine_facets_is_refused),   cmocka_unit_test(water_over_a_bar_rests),
        cmocka_unit_test(a_wall_on_another_bodys_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

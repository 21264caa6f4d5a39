/* Probes are exact for linear fields, also at walls and free surfaces. */
#include "fake_sim.h"

#include "base/memory.h"
#include "measure/patch.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static sb_vec3 flow(sb_vec3 p)
{
    return sb_vec(1 + 0.3 * p.x - 0.2 * p.z, 0.5 * p.y, -0.1 + 0.25 * p.z + 0.05 * p.x);
}

static void set_flow(sb_sim *sim)
{
    for (size_t i = 0; i < sim->report.fluid_count; i++) sim->samples[i].velocity = flow(sim->samples[i].position);
}

static void read_probe(fake_world *world, sb_vec3 at, double radius, sb_vec3 *velocity, double *p)
{
    sb_measure_view view = fake_view(world);
    sb_probe probe = {"p", at, radius};
    sb_patch *patch;
    *p = (double)NAN; /* no mean of an interval */
    assert_int_equal(sb_patch_create(&world->scene, &world->model, &probe, &patch, NULL), SB_OK);
    assert_int_equal(sb_probe_read(&view, &probe, patch, velocity, p, NULL), SB_OK);
    sb_patch_destroy(patch);
}

static void check_linear(int dimensions, double jitter)
{
    fake_world world;
    fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 8, 6), 0, 0, jitter, 7);
    set_flow(&world.sim);
    double y = dimensions == 2 ? 0 : 4.03;
    const sb_vec3 places[] = {{4.1, y, 3.3}, {0, y, 3}, {3.1, y, 0}, {5, y, 5.9}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        sb_vec3 v, expected = flow(places[i]);
        double p;
        read_probe(&world, places[i], i == 0 ? 1.3 : 0, &v, &p);
        assert_true(sb_norm(sb_sub(v, expected)) < 1e-9);
        double depth = 6 - places[i].z;
        /* Pressure is 0 above the surface, so the field is linear only below it. */
        assert_true(fabs(p - 9810 * depth) < (i == 3 ? 0.1 * 9810 : 1e-6 * 9810));
    }
    fake_world_free(&world);
}

static void linear_fields_are_exact(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check_linear(dimensions, 0);
        check_linear(dimensions, 0.1);
    }
}

static void one_layer_falls_back_to_the_mean(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    for (double x = 0.5; x < 8; x++)
        for (double y = 0.5; y < 8; y++) fake_add(&world.sim, sb_vec(x, y, 0.5), sb_vec(2, 0, 0), 0.5 * 9810);
    sb_vec3 v;
    double p;
    read_probe(&world, sb_vec(4, 4, 0), 0, &v, &p);
    assert_true(fabs(v.x - 2) < 1e-12 && fabs(v.y) < 1e-12);
    assert_true(fabs(p - 9810) < 1e-6); /* extrapolated down by half a spacing with rho g */
    fake_world_free(&world);
}

static void dry_is_nan(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(12, 12, 12));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(12, 12, 6), 0, 0, 0, 1);
    sb_vec3 v;
    double p;
    read_probe(&world, sb_vec(6, 6, 7.7), 0, &v, &p);
    assert_true(isnan(p) && isnan(v.x) && isnan(v.y) && isnan(v.z));
    fake_add(&world.sim, sb_vec(6, 6, 10), sb_vec(1, 1, 1), 0);
    read_probe(&world, sb_vec(6, 6, 10), 0, &v, &p); /* one drop */
    assert_true(isnan(p));
    fake_world_free(&world);
}

/* A floor under [0, size] x [0, size], with boundary particles 0.75 spacings behind its surface and its edges. */
static void add_floor(fake_world *world, double size, sb_model_body *body)
{
    const double s = world->scene.resolution, behind = 0.75 * s, step = 0.8 * s;
    const bool flat = world->scene.dimensions == 2;
    const size_t n = (size_t)ceil((size - 2 * behind) / step) + 1, rows = flat ? 1 : n;
    sb_model *model = &world->model;
    model->wall_count = n * rows;
    model->wall_position = sb_alloc(n * rows, sizeof(sb_vec3));
    model->wall_normal = sb_alloc(n * rows, sizeof(sb_vec3));
    for (size_t i = 0; i < n * rows; i++) {
        const double apart = (size - 2 * behind) / (double)(n - 1), y = behind + (double)(i / n) * apart;
        model->wall_position[i] = sb_vec(behind + (double)(i % n) * apart, flat ? 0 : y, -behind);
        model->wall_normal[i] = sb_vec(0, 0, 1);
    }
    *body = (sb_model_body){.count = n * rows, .wavemaker = -1};
    model->bodies = body;
    model->body_count = 1;
    world->scene.numerics.wall_offset = 0.75;
    world->scene.numerics.wall_spacing = 0.8;
}

static void free_floor(fake_world *world)
{
    sb_free(world->model.wall_position);
    sb_free(world->model.wall_normal);
    fake_world_free(world);
}

/* A force by way of a facet. */
static sb_wall_push push_of(size_t body, sb_vec3 at, sb_vec3 force, sb_vec3 normal)
{
    return (sb_wall_push){body, at, force, normal, at};
}

static sb_patch *make_patch(const fake_world *world, sb_vec3 at, double radius)
{
    const sb_probe probe = {"p", at, radius};
    sb_patch *patch;
    assert_int_equal(sb_patch_create(&world->scene, &world->model, &probe, &patch, NULL), SB_OK);
    assert_true(sb_patch_on_wall(patch));
    return patch;
}

/* Pressure at a probe on the floor under a force of 2000 Pa per area on each quarter of a spacing. */
static double under_uniform_pressure(const fake_world *world, sb_vec3 at, double radius)
{
    const double size = 8, cell = 0.25 * world->scene.resolution;
    const bool flat = world->scene.dimensions == 2;
    const int n = (int)lround(size / cell), rows = flat ? 1 : n;
    double sum = 0;
    sb_patch *patch = make_patch(world, at, radius);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < n; i++) {
            const sb_vec3 place = sb_vec((i + 0.5) * cell, flat ? 0 : (j + 0.5) * cell, 0.3);
            const sb_vec3 force = sb_vec(0, 0, -2000 * (flat ? cell : cell * cell));
            const sb_wall_push push = push_of(0, place, force, sb_vec(0, 0, i % 2));
            sum += sb_patch_share(patch, &push);
        }
    sb_patch_destroy(patch);
    return sum;
}

static void uniform_pressure_is_read_also_at_edges(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        sb_model_body body;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
        add_floor(&world, 8, &body);
        const double y = dimensions == 2 ? 0 : 4;
        for (double x = 4; x < 4.5; x += 0.17) {
            assert_true(fabs(under_uniform_pressure(&world, sb_vec(x, y, 0), 0) / 2000 - 1) < 0.01);
            assert_true(fabs(under_uniform_pressure(&world, sb_vec(x, y, 0.1), 1.7) / 2000 - 1) < 0.01);
        }
        for (double x = 0; x < 2; x += 0.11) {
            assert_true(fabs(under_uniform_pressure(&world, sb_vec(x, y, 0), 0) / 2000 - 1) < 0.06);
            if (dimensions == 3 && x >= 0.4) /* along the diagonal into the corner */
                assert_true(fabs(under_uniform_pressure(&world, sb_vec(x, x, 0), 0) / 2000 - 1) < 0.1);
        }
        free_floor(&world);
    }
}

/* Whatever the place of a force, within the face or beyond its edge, the probes on the face share all of it. */
static void probes_all_over_a_face_share_each_force(void **state)
{
    (void)state;
    enum { SIDE = 16 };
    static sb_patch *patches[SIDE * SIDE];
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        sb_model_body body;
        const int rows = dimensions == 2 ? 1 : SIDE;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
        add_floor(&world, 8, &body);
        for (int k = 0; k < SIDE * rows; k++)
            patches[k] =
                make_patch(&world, sb_vec((k % SIDE + 0.5) * 0.5, rows == 1 ? 0 : (k / SIDE + 0.5) * 0.5, 0), 0);
        for (double x = -0.6; x < 5; x += 0.37) {
            const sb_vec3 place = sb_vec(x, rows == 1 ? 0 : 3.3, 0.4), force = sb_vec(5, 0, -70);
            const sb_wall_push push = push_of(0, place, force, sb_vec(0, 0, 0));
            double sum = 0;
            for (int k = 0; k < SIDE * rows; k++) sum += sb_patch_share(patches[k], &push) * pow(0.5, dimensions - 1);
            assert_true(fabs(sum / 70 - 1) < (x < 1 ? 0.05 : 0.02));
        }
        /* Forces on other bodies, on other walls of the body, and of water too far away have no share. */
        const double y = rows == 1 ? 0 : 4;
        const sb_vec3 at = sb_vec(4, y, 0.4), down = sb_vec(0, 0, -70);
        sb_wall_push others[] = {
            push_of(1, at, down, sb_vec(0, 0, 0)), push_of(0, at, sb_vec(-40, 0, -40), sb_vec(0.707, 0, 0.707)),
            push_of(0, sb_vec(4, y, 1.1), down, sb_vec(0, 0, 0)), push_of(0, at, down, sb_vec(0, 0, 0))};
        others[3].from = sb_vec(4.4, y, 0.2); /* a boundary particle in front of the face */
        for (size_t k = 0; k < sizeof others / sizeof *others; k++)
            for (int p = 0; p < SIDE * rows; p++) assert_true(sb_patch_share(patches[p], &others[k]) == 0);
        for (int k = 0; k < SIDE * rows; k++) sb_patch_destroy(patches[k]);
        free_floor(&world);
    }
}

/* A wall that is wet in one step of the interval has a pressure, the mean over the interval; without force and water it
   is dry. */
static void pressure_on_a_wall_is_the_mean_of_the_interval(void **state)
{
    (void)state;
    fake_world world;
    sb_model_body body;
    sb_probe probe = {"p", {4, 0, 0}, 0};
    sb_measure *measure;
    const sb_wall_push push = push_of(0, sb_vec(4, 0, 0.2), sb_vec(0, 0, -60), sb_vec(0, 0, 1));
    fake_world_make(&world, 2, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    add_floor(&world, 8, &body);
    world.scene.measure.probes = &probe;
    world.scene.measure.probe_count = 1;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    assert_int_equal(world.sim.place_count, 1);
    sb_patch *patch = make_patch(&world, probe.at, 0);
    const double share = sb_patch_share(patch, &push);
    assert_true(share > 0);
    world.sim.pushes = &push;
    for (int step = 1; step <= 8; step++) { /* two rows of four steps */
        world.sim.push_count = step == 2;
        fake_step(&world.sim, 0.025);
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
        const sb_measure_records *now = sb_measure_latest(measure);
        assert_int_equal(now->probe_count, step % 4 == 0);
        if (step == 4) assert_true(fabs(now->probes[0].pressure - share / 4) < 1e-9 * share);
        if (step == 8) assert_true(isnan(now->probes[0].pressure));
    }
    sb_patch_destroy(patch);
    sb_measure_destroy(measure);
    free_floor(&world);
}

/* The first layer above the floor, whose pressure is too high, is ignored. */
static void near_a_wall_the_first_layer_is_ignored(void **state)
{
    (void)state;
    fake_world world;
    sb_model_body body;
    fake_world_make(&world, 3, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 8, 6), 0, 0, 0, 1);
    for (size_t i = 0; i < world.sim.report.fluid_count; i++)
        if (world.sim.samples[i].position.z < 0.5) world.sim.samples[i].pressure *= 2;
    add_floor(&world, 8, &body);
    sb_vec3 v;
    double p;
    read_probe(&world, sb_vec(4.1, 4.2, 0.7), 0, &v, &p);
    assert_true(fabs(p - 9810 * 5.3) < 1e-6 * 9810);
    free_floor(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_fields_are_exact),
        cmocka_unit_test(one_layer_falls_back_to_the_mean),
        cmocka_unit_test(dry_is_nan),
        cmocka_unit_test(uniform_pressure_is_read_also_at_edges),
        cmocka_unit_test(probes_all_over_a_face_share_each_force),
        cmocka_unit_test(pressure_on_a_wall_is_the_mean_of_the_interval),
        cmocka_unit_test(near_a_wall_the_first_layer_is_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

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

/* A floor of boundary particles half a spacing below z = 0, under [0, size] x [0, size]. */
static void add_floor(fake_world *world, double size, sb_model_body *body)
{
    double s = world->scene.resolution;
    bool flat = world->scene.dimensions == 2;
    size_t n = (size_t)lround(size / s), rows = flat ? 1 : n;
    sb_model *model = &world->model;
    model->wall_count = n * rows;
    model->wall_position = sb_alloc(n * rows, sizeof(sb_vec3));
    model->wall_normal = sb_alloc(n * rows, sizeof(sb_vec3));
    for (size_t i = 0; i < n * rows; i++) {
        double y = flat ? 0 : ((double)(i / n) + 0.5) * s;
        model->wall_position[i] = sb_vec(((double)(i % n) + 0.5) * s, y, -s / 2);
        model->wall_normal[i] = sb_vec(0, 0, 1);
    }
    *body = (sb_model_body){.count = n * rows, .wavemaker = -1};
    model->bodies = body;
    model->body_count = 1;
    world->scene.numerics.wall_gamma = 0.7;
    world->scene.numerics.wall_offset = 0.5;
    world->scene.numerics.wall_spacing = 1;
}

/* Force per area of a lattice with one pressure on an endless floor, by the formula. */
static double floor_load(const fake_world *world, double pressure)
{
    const sb_scene *scene = &world->scene;
    const sb_kernel *kernel = scene->numerics.kernel;
    int d = scene->dimensions, across = d == 2 ? 0 : 3;
    double s = scene->resolution, h = 2 * s, sum = 0, load = 0;
    for (int j = -across; j <= across; j++)
        for (int i = -3; i <= 3; i++) {
            sum += sb_kernel_value(kernel, d, h, s * hypot(i, j));
            for (int k = 1; k <= 2; k++) {
                double r = s * sqrt(i * i + j * j + k * k);
                load -= sb_kernel_slope(kernel, d, h, r) * k * s / r;
            }
        }
    double mass = 1000 * pow(s, d), psi = 0.7 * 1000 / sum;
    return mass * psi * load * pressure / 1e6 / pow(s, d - 1);
}

static void wall_pressure_is_force_over_area(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        fake_world world;
        sb_model_body body;
        fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
        fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 8, 3), 0, 0, 0, 1);
        for (size_t i = 0; i < world.sim.report.fluid_count; i++) world.sim.samples[i].push = 2000 / 1e6;
        add_floor(&world, 8, &body);
        double expected = floor_load(&world, 2000), p;
        sb_vec3 v;
        for (double x = 4; x < 4.5; x += 0.07) {
            double y = dimensions == 2 ? 0 : x - 0.1;
            read_probe(&world, sb_vec(x, y, 0), 0, &v, &p);
            assert_true(fabs(p / expected - 1) < 0.02);
            read_probe(&world, sb_vec(x, y, 0.1), 1.7, &v, &p);
            assert_true(fabs(p / expected - 1) < 0.02);
        }
        /* At the floor's end only half the disk counts. */
        read_probe(&world, sb_vec(0.1, dimensions == 2 ? 0 : 4, 0), 0, &v, &p);
        assert_true(fabs(p / expected - 1) < 0.25);
        sb_free(world.model.wall_position);
        sb_free(world.model.wall_normal);
        fake_world_free(&world);
    }
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
    sb_free(world.model.wall_position);
    sb_free(world.model.wall_normal);
    fake_world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_fields_are_exact),
        cmocka_unit_test(one_layer_falls_back_to_the_mean),
        cmocka_unit_test(dry_is_nan),
        cmocka_unit_test(wall_pressure_is_force_over_area),
        cmocka_unit_test(near_a_wall_the_first_layer_is_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

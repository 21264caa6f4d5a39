/* The density correction: determined on the initial lattice, kept with the particle, returned to the bulk's value in
   the bulk. With it, water at rest keeps its level. */
#include "check.h"
#include "sim/state/lattice.h"
#include "sim/tank.h"
#include "sim/terms/density_correction.h"

#include <math.h>

static const double DEPTH = 0.6;

static sb_sim *water_in(tank *t, int dimensions, sb_density_form form, double jitter)
{
    const sb_vec3 size = dimensions == 2 ? sb_vec(1, 0, 1) : sb_vec(0.6, 0.5, 1);
    tank_make(t, dimensions, 0.05, size, size.x, DEPTH, jitter);
    t->scene.numerics.kernel = sb_kernel_find("wendland-c2");
    t->scene.numerics.support = 3;
    t->scene.numerics.density = form;
    t->scene.numerics.source_relaxation = 0.2;
    t->scene.numerics.warm_start = 0.7;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

static void lattice_is_at_rest_density(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        sb_sim *sim = water_in(&t, dimensions, SB_DENSITY_COMPLETED, 0);
        sb_error error = {0};
        float least = INFINITY;
        assert_int_equal(tank_prepare(sim, 1e-3), 0);
        for (size_t i = 0; i < sim->state.n; i++) least = fminf(least, sim->work.density[i]);
        assert_true(least < 0.8f * sim->constant.rest_density); /* the sums at the surface */
        assert_int_equal(sb_stage_density_correction(sim, &error), SB_OK);
        for (size_t i = 0; i < sim->state.n; i++)
            assert_true(fabsf(sim->work.density[i] / sim->constant.rest_density - 1) < 1e-6f);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* Determining it again in a later step would hide a deficit that has appeared since the start. */
static void it_is_determined_once(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = water_in(&t, 2, SB_DENSITY_COMPLETED, 0);
    assert_int_equal(tank_steps(sim, 1), 0);
    for (size_t i = 0; i < sim->state.n; i++)
        sim->state.position[i][2] += (uint32_t)(0.01 / sim->space.quantum); /* off the floor, otherwise unchanged */
    sb_error error = {0};
    assert_int_equal(tank_prepare(sim, 1e-3), 0);
    assert_int_equal(sb_stage_density_correction(sim, &error), SB_OK);
    float least = INFINITY;
    for (size_t i = 0; i < sim->state.n; i++) least = fminf(least, sim->work.density[i]);
    assert_true(least < 0.97f * sim->constant.rest_density);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* The correction of the particle with that id. */
static float *correction_of(sb_sim *sim, uint32_t id)
{
    for (size_t i = 0; i < sim->state.n; i++)
        if (sim->state.id[i] == id) return &sim->state.density_correction[i];
    fail_msg("no particle %u", id);
    return NULL;
}

/* A particle in the bulk with the correction of a surface, or with an excess, returns to the bounds of the bulk. A
   particle at the surface keeps its correction, if it does not follow the strain that these two particles cause. */
static void it_returns_to_the_bulk_value(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = water_in(&t, 2, SB_DENSITY_COMPLETED, 0);
    sim->needs.packing_strain = false;
    assert_int_equal(tank_steps(sim, 1), 0);
    uint32_t bulk[2] = {UINT32_MAX, UINT32_MAX}, surface = UINT32_MAX;
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        if (fabs(at.x - 0.325) < 0.02 && fabs(at.z - 0.325) < 0.02) bulk[0] = sim->state.id[i];
        if (fabs(at.x - 0.675) < 0.02 && fabs(at.z - 0.325) < 0.02) bulk[1] = sim->state.id[i];
        if (fabs(at.x - 0.525) < 0.02 && fabs(at.z - DEPTH) < 0.04) surface = sim->state.id[i];
    }
    assert_true(bulk[0] < sim->state.n && bulk[1] < sim->state.n && surface < sim->state.n);
    const float rest = sim->constant.rest_density, kept = *correction_of(sim, surface);
    assert_true(kept > 0.2f * rest);
    *correction_of(sim, bulk[0]) = 0.2f * rest;
    *correction_of(sim, bulk[1]) = -0.2f * rest;
    assert_int_equal(tank_steps(sim, 120), 0);
    assert_true(*correction_of(sim, bulk[0]) < 0.005f * rest);
    assert_true(*correction_of(sim, bulk[1]) > -0.012f * rest);
    assert_true(*correction_of(sim, surface) == kept);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Change of the mean height of the water by settling, in spacings. */
static double rise_by_settling(void)
{
    tank t;
    sb_error error = {0};
    sb_sim_destroy(water_in(&t, 2, SB_DENSITY_COMPLETED, 0.02));
    t.scene.numerics.settle_steps = 300;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    const double mass = sb_sim_energy(sim).mass * (double)sim->constant.gravity;
    const double before = sb_sim_energy(sim).potential / mass;
    if (sb_sim_settle(sim, &error) != SB_OK) fail_msg("%s", error.text);
    const double after = sb_sim_energy(sim).potential / mass;
    sb_sim_destroy(sim);
    tank_free(&t);
    return (after - before) / 0.05;
}

static void settling_keeps_the_level(void **state)
{
    (void)state;
    const double rise = rise_by_settling();
    print_message("by settling the level rises by %.3f spacings\n", rise);
    assert_true(fabs(rise) < 0.1);
}

static void it_costs_nothing_when_off(void **state)
{
    (void)state;
    for (int on = 0; on < 2; on++) {
        tank t;
        sb_sim *sim = water_in(&t, 2, on ? SB_DENSITY_COMPLETED : SB_DENSITY_SUMMED, 0);
        assert_int_equal(tank_steps(sim, 1), 0);
        assert_true((sim->state.density_correction != NULL) == on && tank_has_stage(sim, "density_correction") == on);
        assert_true(tank_skips(sim, "density correction") == !on);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* Compared with a half space by quadrature. With a support of four spacings sums are within a tenth of integrals. */
static void truncation_is_that_of_a_half_space(void **state)
{
    (void)state;
    sb_scene scene = {.dimensions = 2, .resolution = 1};
    scene.numerics.kernel = sb_kernel_find("wendland-c2");
    scene.numerics.support = 4;
    double density = 0, slope = 0, full = 0;
    const double step = 0.01, h = 4;
    for (double x = -h + step / 2; x < h; x += step)
        for (double z = -h + step / 2; z < h; z += step) {
            const double r = sqrt(x * x + z * z), w = sb_kernel_value(scene.numerics.kernel, 2, h, r) * step * step;
            full += w;
            if (z > 0.5) continue;
            density += w;
            slope += h * sb_kernel_slope(scene.numerics.kernel, 2, h, r) * z / r * step * step;
        }
    assert_near(sb_lattice_density(&scene), full, 0.005);
    const double expected = (full - density) / (slope * slope);
    assert_near(sb_lattice_truncation(&scene), expected, 0.1 * expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_is_at_rest_density),   cmocka_unit_test(it_is_determined_once),
        cmocka_unit_test(it_returns_to_the_bulk_value), cmocka_unit_test(settling_keeps_the_level),
        cmocka_unit_test(it_costs_nothing_when_off),    cmocka_unit_test(truncation_is_that_of_a_half_space),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

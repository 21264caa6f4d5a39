/* The Chebyshev solver assumes a bound of the eigenvalues (sb_pressure_spectrum). Settled water beside walls must stay
   below it for every kernel and support radius. */
#include "base/memory.h"
#include "check.h"
#include "sim/pressure/pressure.h"
#include "sim/tank.h"

#include <math.h>
#include <stdio.h>

/* Largest eigenvalue of D^-1 A by power iteration. */
static double largest(sb_sim *sim)
{
    float *v = sb_alloc(sim->state.n, sizeof *v), *product = sb_alloc(sim->state.n, sizeof *product);
    assert_true(v && product);
    for (size_t i = 0; i < sim->state.n; i++) v[i] = (float)((double)(i * 7919 % 1000) / 500 - 1);
    double value = 0;
    for (int round = 0; round < 200; round++) {
        double before = 0, after = 0;
        sb_pressure_load(sim, v);
        sb_pressure_product(sim, product);
        for (size_t i = 0; i < sim->state.n; i++) {
            const float next = sim->work.diagonal[i] > 0 ? -product[i] / sim->work.diagonal[i] : 0;
            before += (double)v[i] * (double)v[i];
            after += (double)next * (double)next;
            v[i] = next;
        }
        value = sqrt(after / before);
        for (size_t i = 0; i < sim->state.n; i++) v[i] /= (float)sqrt(after);
    }
    sb_free(v);
    sb_free(product);
    return value;
}

static void check(int dimensions, const char *kernel, double support)
{
    tank t;
    const sb_vec3 size = dimensions == 2 ? sb_vec(1, 0, 1) : sb_vec(0.6, 0.5, 1);
    sb_error error = {0};
    tank_make(&t, dimensions, 0.05, size, size.x, 0.6, 0.1);
    t.scene.numerics.kernel = sb_kernel_find(kernel);
    t.scene.numerics.support = support;
    t.scene.numerics.settle_steps = 150;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    if (sb_sim_settle(sim, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(tank_steps(sim, 1), 0);
    const double found = largest(sim), lattice = sim->constant.spectrum;
    printf("%dD %s %g: %.3f, lattice %.3f, ratio %.3f\n", dimensions, kernel, support, found, lattice, found / lattice);
    assert_true(found < sb_pressure_spectrum(sim)); /* the bound that the solver uses */
    assert_true(found > 0.9 * lattice);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void narrow_kernels(void **state)
{
    (void)state;
    check(2, "cubic", 2);
    check(3, "cubic", 2);
}

static void wider_kernels(void **state)
{
    (void)state;
    check(2, "cubic", 2.5);
    check(3, "cubic", 2.5);
    check(2, "wendland-c2", 3);
}

/* Settles a tank, and makes steps with a solver that assumes `share` of the lattice's largest eigenvalue. */
static void check_convergence(int solver, double support, double relaxation, double share)
{
    tank t;
    sb_error error = {0};
    tank_make(&t, 3, 0.05, sb_vec(0.6, 0.5, 1), 0.6, 0.6, 0.1);
    t.scene.numerics.support = support;
    t.scene.numerics.solver = solver;
    t.scene.numerics.relaxation = relaxation;
    t.scene.numerics.settle_steps = 60;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    if (sb_sim_settle(sim, &error) != SB_OK) fail_msg("%s", error.text);
    sim->constant.spectrum *= share;
    assert_int_equal(tank_steps(sim, 5), 0);
    const sb_step_report *report = sb_sim_report(sim);
    printf("%d sweeps, error %.2e, tolerance %.2e\n", report->iterations, report->error_mean, report->tolerance);
    assert_false(report->capped);
    assert_true(report->error_mean <= report->tolerance);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* With the factor 0.5, which is stable for a support of two spacings, sweeps would add to the error here. */
static void jacobi_factor_follows_the_support(void **state)
{
    (void)state;
    check_convergence(SB_SOLVER_JACOBI, 2.5, 0.5, 1);
}

/* Where water moves violently, eigenvalues are larger than those of a lattice. */
static void sweeps_become_smaller_when_the_error_grows(void **state)
{
    (void)state;
    check_convergence(SB_SOLVER_JACOBI, 2.75, 1, 0.3);
    check_convergence(SB_SOLVER_CHEBYSHEV, 2.75, 0.5, 0.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(narrow_kernels),
        cmocka_unit_test(wider_kernels),
        cmocka_unit_test(jacobi_factor_follows_the_support),
        cmocka_unit_test(sweeps_become_smaller_when_the_error_grows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

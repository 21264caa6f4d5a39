/* The pressure solvers compared with the reference's solution. */
#include "check.h"
#include "sim/pressure/pressure.h"
#include "sim/pressure/pressure_problem.h"
#include "sim/step/stages.h"

#include <stdio.h>
#include <string.h>

/* The errors of q, computed by the reference's operator. */
static sb_pressure_error true_error(problem *s, const double *q)
{
    sb_pressure_error error = {0};
    sb_reference_apply(&s->twin.reference, q, s->acceleration, s->product);
    for (size_t i = 0; i < s->n; i++) {
        if (s->sim->work.diagonal[i] == 0) continue;
        double e = s->product[i] - s->source[i];
        error.mean += fmax(0, e) / ((double)s->n * 1000);
        error.max = fmax(error.max, e / 1000);
        error.residual += fabs(fmin((double)s->sim->work.diagonal[i] * q[i], -e)) / ((double)s->n * 1000);
    }
    return error;
}

/* One solve by the preset's rule from `share` of the reference's solution; q in s->x. The tolerance is that of the
   error relative to the rest density, which the rule `pressure` scales by a Courant number. */
static void solve(problem *s, sb_solver solver, double tolerance, int most, double share)
{
    sb_numerics *n = &s->tank.scene.numerics;
    const sb_constants *c = &s->sim->constant;
    const double courant = s->sim->state.time_step * (double)c->wave_speed / (double)c->spacing;
    n->solver = solver;
    n->tolerance = n->tolerance_rule == SB_TOLERANCE_PRESSURE ? tolerance / (courant * courant) : tolerance;
    n->max_iterations = most;
    n->warm_start = 1;
    for (size_t i = 0; i < s->n; i++) {
        double rho = (double)s->sim->work.density[i];
        s->sim->state.velocity[i][3] = (float)(share * s->solution[i] * rho * rho);
        s->sim->work.diagonal[i] = (float)s->diagonal[i];
    }
    sb_error error = {0};
    assert_int_equal(sb_stage_pressure(s->sim, &error), SB_OK);
    assert_near(s->sim->work.solve.tolerance, tolerance, 1e-12 * tolerance);
    for (size_t i = 0; i < s->n; i++) s->x[i] = (double)s->sim->work.unknown[i];
}

/* The error that the preset's rule judges. */
static double judged(const problem *s)
{
    const sb_step_report *r = &s->sim->report;
    return s->tank.scene.numerics.tolerance_rule == SB_TOLERANCE_PRESSURE ? r->error_residual : r->error_mean;
}

static const char *name_of(sb_solver solver)
{
    return sb_pressure_solvers[solver]->name;
}

static double gap_to_solution(const problem *s)
{
    twin_gap gap = {0};
    for (size_t i = 0; i < s->n; i++) twin_compare(&gap, i, s->x[i], s->solution[i]);
    return twin_relative(&gap);
}

/* Checks that the reported errors are correct to `relative` and to the round-off of the float operator. The solver cg
   adds each product to its residual, hundreds of times, and with them their round-off: about 4e-9 in the residual. */
static void check_report(problem *s, double relative)
{
    const double share = s->tank.scene.numerics.solver == SB_SOLVER_CG ? 2 : 1;
    const sb_step_report *r = &s->sim->report;
    sb_pressure_error e = true_error(s, s->x);
    assert_near(r->error_mean, e.mean, relative * e.mean + share * 2e-9);
    assert_near(r->error_residual, e.residual, relative * e.residual + share * 4e-9);
    assert_near(r->error_max, e.max, relative * e.max + 4e-7);
}

/* Checks that the solve leaves the acceleration G q, that q >= 0, and that q = 0 for an isolated particle. */
static void check_outcome(problem *s)
{
    twin_gap push = {0};
    sb_reference_pressure_acceleration(&s->twin.reference, s->x, s->acceleration);
    for (size_t i = 0; i < s->n; i++) {
        sb_f4 a = s->sim->work.acceleration[i];
        assert_true(s->x[i] >= 0);
        assert_true(s->sim->work.diagonal[i] > 0 || s->x[i] == 0);
        twin_compare(&push, i, (double)a[0], s->acceleration[i].x);
        twin_compare(&push, i, (double)a[2], s->acceleration[i].z);
    }
    if (!(push.scale > 1 && twin_relative(&push) < 1e-5)) fail_msg("acceleration: %g of %g", push.worst, push.scale);
}

/* Runs a solver from q = 0 to residuals just above the round-off of the float operator, which is about 2e-9. `most`:
   largest difference of q from the solution, over the largest q, in units of the residual. */
static void check_solver(problem *s, sb_solver solver, double most)
{
    const double tolerances[] = {1e-4, 1e-6, 1e-8};
    for (size_t t = 0; t < sizeof tolerances / sizeof *tolerances; t++) {
        double tolerance = tolerances[t];
        solve(s, solver, tolerance, 10000, 0);
        const sb_step_report *r = &s->sim->report;
        const double gap = gap_to_solution(s);
        printf("%-9s to %.0e: %4d iterations, q within %.2g; mean %.2e, residual %.2e, max %.2e\n", name_of(solver),
               tolerance, s->sim->work.solve.iterations, gap, r->error_mean, r->error_residual, r->error_max);
        assert_false(r->capped);
        assert_true(judged(s) <= tolerance);
        check_report(s, 1e-3);
        check_outcome(s);
        assert_true(gap < most * r->error_residual);
    }
    /* From the solution itself it takes the smallest number of iterations and keeps the solution. */
    solve(s, solver, 1e-6, 10000, 1);
    assert_int_equal(s->sim->work.solve.iterations, s->tank.scene.numerics.min_iterations);
    assert_true(gap_to_solution(s) < 1e-6);
    /* The limit of iterations is respected and reported. */
    solve(s, solver, 1e-9, 7, 0);
    assert_true(s->sim->work.solve.capped && judged(s) > 1e-9);
    assert_in_range(s->sim->work.solve.iterations, 7, 8);
    check_report(s, 1e-3);
    check_outcome(s);
}

/* `most` of check_solver: the condition of the problem. A wider support has smoother modes, which the divergence hardly
   sees. All solvers leave such differences, of up to 9e4 and 1.2e4 residuals. */
static const double condition[] = {[SB_PRESET_DEFAULT] = 1e5, [SB_PRESET_PAPER] = 1.5e4};

static void check_solvers(int dimensions)
{
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++) {
        problem s;
        problem_begin(&s, dimensions, preset);
        const long products = sb_reference_solve(&s.twin.reference, s.source, 1e-12, 20000, s.solution);
        size_t pressed = 0;
        for (size_t i = 0; i < s.n; i++) pressed += s.solution[i] > 0;
        printf("%dD, %s, reference: %ld products, %zu of %zu particles under pressure\n", dimensions,
               tank_preset_names[preset], products, pressed, s.n);
        assert_true(products > 0 && pressed > s.n / 10 && pressed < s.n);
        for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++)
            check_solver(&s, solver, condition[preset]);
        problem_end(&s);
    }
}

static void a_flat_dam_break(void **state)
{
    (void)state;
    check_solvers(2);
}

static void a_dam_break(void **state)
{
    (void)state;
    check_solvers(3);
}

/* The rule `pressure` judges the natural residual: it must be below the tolerance, and below an eightieth of it or
   three tenths of the initial guess's. The rule `density` judges the excess density alone. */
static void where_a_solve_ends(void **state)
{
    (void)state;
    static const struct {
        sb_tolerance_rule rule;
        int iterations;
        double mean, residual, first; /* in tolerances */
        bool done;
    } cases[] = {
        {SB_TOLERANCE_PRESSURE, 8, 0, 0.9, 4, true},     {SB_TOLERANCE_PRESSURE, 8, 0, 1.1, 4, false},
        {SB_TOLERANCE_PRESSURE, 8, 0, 0.9, 2, false},    {SB_TOLERANCE_PRESSURE, 8, 0, 0.5, 2, true},
        {SB_TOLERANCE_PRESSURE, 8, 0, 0.01, 0.02, true}, {SB_TOLERANCE_PRESSURE, 8, 0, 0.02, 0.04, false},
        {SB_TOLERANCE_PRESSURE, 8, 5, 0.01, 0.1, true},  {SB_TOLERANCE_PRESSURE, 1, 0, 0, 1, false},
        {SB_TOLERANCE_DENSITY, 8, 0.9, 5, 5, true},      {SB_TOLERANCE_DENSITY, 8, 1.1, 0, 5, false},
        {SB_TOLERANCE_DENSITY, 1, 0.1, 0, 5, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 1, 0.5, 0);
        t.scene.numerics.min_iterations = 2;
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        const sb_pressure_error error = {.mean = 1e-4 * cases[i].mean, .residual = 1e-4 * cases[i].residual};
        t.scene.numerics.tolerance_rule = cases[i].rule;
        sim->work.solve =
            (sb_solve){.tolerance = 1e-4, .iterations = cases[i].iterations, .first = 1e-4 * cases[i].first};
        assert_int_equal(sb_pressure_done(sim, &error), cases[i].done);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_dam_break),
        cmocka_unit_test(a_dam_break),
        cmocka_unit_test(where_a_solve_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

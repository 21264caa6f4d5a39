/* The pressure problem in float compared with the double-precision reference: source, operator, errors. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/pressure/pressure_problem.h"

#include <stdio.h>
#include <string.h>

/* Random values that float holds exactly. */
static void fill_random(double *field, size_t n, uint64_t seed)
{
    for (size_t i = 0; i < n; i++) field[i] = (double)(float)sb_random(seed, i);
}

/* out = A argument by the simulation; leaves the acceleration in sim->work.acceleration. */
static void fast_product(problem *s, const double *argument, double *out)
{
    float *narrow = sb_alloc(s->n, sizeof *narrow), *result = sb_alloc(s->n, sizeof *result);
    assert_true(narrow && result);
    for (size_t i = 0; i < s->n; i++) narrow[i] = (float)argument[i];
    sb_pressure_load(s->sim, narrow);
    sb_pressure_product(s->sim, result);
    for (size_t i = 0; i < s->n; i++) out[i] = (double)result[i];
    sb_free(narrow);
    sb_free(result);
}

static double dot(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void check_source(problem *s)
{
    double *rho = s->x, *expected = s->y;
    sb_reference_density(&s->twin.reference, rho);
    const float *correction = s->sim->state.density_correction;
    for (size_t i = 0; i < s->n && correction; i++) rho[i] += (double)correction[i];
    sb_reference_source(&s->twin.reference, rho, s->twin.velocity, s->tank.scene.numerics.source_relaxation, expected);
    twin_gap gap = {0};
    for (size_t i = 0; i < s->n; i++) twin_compare(&gap, i, s->source[i], expected[i]);
    printf("source: worst %.2g of the rest density, which spans %.2g\n", gap.worst / 1000, gap.scale / 1000);
    assert_true(gap.scale > 1e-3 * 1000);
    assert_true(gap.worst < 1e-6 * 1000);
}

static void check_operator(problem *s)
{
    double *fast = s->solution;
    fill_random(s->x, s->n, 1);
    sb_reference_apply(&s->twin.reference, s->x, s->acceleration, s->product);
    fast_product(s, s->x, fast);
    twin_gap product = {0}, push = {0};
    for (size_t i = 0; i < s->n; i++) {
        sb_f4 a = s->sim->work.acceleration[i];
        twin_compare(&product, i, fast[i], s->product[i]);
        twin_compare(&push, i, (double)a[0], s->acceleration[i].x);
        twin_compare(&push, i, (double)a[1], s->acceleration[i].y);
        twin_compare(&push, i, (double)a[2], s->acceleration[i].z);
    }
    printf("G q: worst %.2g of the largest, A q: %.2g\n", twin_relative(&push), twin_relative(&product));
    assert_true(twin_relative(&push) < 1e-6 && twin_relative(&product) < 1e-6);
    /* x . A y = y . A x and x . A x < 0, in sums without cancellation. */
    double *y = s->y, *ax = fast, *ay = s->product;
    fill_random(y, s->n, 2);
    fast_product(s, y, ay);
    double xay = dot(s->x, ay, s->n), yax = dot(y, ax, s->n);
    double sizes = sqrt(dot(s->x, s->x, s->n) * dot(ay, ay, s->n));
    printf("x.Ay %.9g, y.Ax %.9g: differ by %.2g of |x||Ay|\n", xay, yax, fabs(xay - yax) / sizes);
    assert_true(fabs(xay - yax) < 1e-6 * sizes);
    assert_true(dot(s->x, ax, s->n) < 0);
}

/* (A e_i)_i is the diagonal of the neighbour pass and of the reference. */
static void check_diagonal(problem *s)
{
    double dt2 = s->sim->state.time_step * s->sim->state.time_step, worst = 0, formula = 0;
    sb_reference_diagonal(&s->twin.reference, s->y);
    size_t flying = 0;
    memset(s->x, 0, s->n * sizeof *s->x);
    for (size_t i = 0; i < s->n; i++) {
        s->x[i] = 1;
        fast_product(s, s->x, s->product);
        s->x[i] = 0;
        double stored = -(double)s->sim->work.diagonal[i] * dt2;
        if (stored == 0) {
            flying++;
            assert_true(fabs(s->product[i]) <= 1e-6 * (double)s->sim->constant.full_diagonal * dt2);
            continue;
        }
        worst = fmax(worst, fabs(s->product[i] / stored - 1));
        formula = fmax(formula, fabs(stored / s->y[i] - 1));
    }
    printf("diagonal: probed against stored %.2g of each, stored against reference %.2g; %zu isolated\n", worst,
           formula, flying);
    assert_int_equal(flying, 1);
    assert_true(worst < 1e-5 && formula < 1e-5);
}

static void source_operator_and_diagonal_agree(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            problem s;
            problem_begin(&s, dimensions, preset);
            printf("%dD, %s, %zu particles:\n", dimensions, tank_preset_names[preset], s.n);
            check_source(&s);
            check_operator(&s);
            check_diagonal(&s);
            problem_end(&s);
        }
}

/* Accelerations and their divergences by one implementation of the passes. */
static void by_form(problem *s, const sb_passes *form, sb_f4 *acceleration, float *divergence)
{
    form->accelerate(s->sim);
    form->diverge(s->sim, s->sim->work.acceleration, 0.5f, divergence);
    memcpy(acceleration, s->sim->work.acceleration, s->n * sizeof *acceleration);
}

/* The passes with vectors of 64 bytes give the same bits as those with 32 bytes. */
static void both_forms_of_the_passes_agree(void **state)
{
    (void)state;
    if (!sb_passes_cpu_wide()) skip();
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        problem s;
        problem_begin(&s, dimensions, SB_PRESET_DEFAULT);
        sb_f4 *a[2];
        float *d[2];
        for (int form = 0; form < 2; form++) {
            a[form] = sb_alloc(s.n, sizeof *a[form]);
            d[form] = sb_alloc(s.n, sizeof *d[form]);
            assert_true(a[form] && d[form]);
        }
        for (size_t i = 0; i < s.n; i++) s.sim->work.unknown[i] = (float)sb_random(9, i);
        sb_pressure_load(s.sim, s.sim->work.unknown);
        by_form(&s, &sb_passes_cpu, a[0], d[0]);
        by_form(&s, sb_passes_cpu_wide(), a[1], d[1]);
        assert_memory_equal(a[0], a[1], s.n * sizeof *a[0]);
        assert_memory_equal(d[0], d[1], s.n * sizeof *d[0]);
        for (int form = 0; form < 2; form++) {
            sb_free(a[form]);
            sb_free(d[form]);
        }
        problem_end(&s);
    }
}

/* Mean error, residual and largest error compared with a plain loop, also for a last group that is not full. The errors
   are multiples of 2^-20, so that the sums of errors are exact in any order. */
static void errors_are_those_of_a_plain_loop(void **state)
{
    (void)state;
    problem s;
    problem_begin(&s, 3, SB_PRESET_DEFAULT);
    const double rest = (double)s.sim->constant.rest_density;
    sb_group *last = &s.sim->groups.group[s.sim->groups.count - 1];
    const size_t fewest = s.n - 3 > last->first ? s.n - 3 : last->first;
    for (s.sim->state.n = fewest; s.sim->state.n <= s.n; s.sim->state.n++) {
        last->end = (uint32_t)s.sim->state.n;
        s.sim->work.everywhere = s.sim->state.n;
        double excess = 0, residual = 0, worst = 0;
        for (size_t i = 0; i < s.sim->state.n; i++) {
            s.sim->work.residual[i] = (float)(ldexp(floor(ldexp(sb_random(3, i), 20)), -20) - 0.5);
            s.sim->work.unknown[i] = i % 3 == 0 ? 0 : 1;
            if (i % 7 == 0) s.sim->work.diagonal[i] = 0;
            if (s.sim->work.diagonal[i] == 0) continue;
            const double e = (double)s.sim->work.residual[i];
            excess += e > 0 ? e : 0;
            worst = e > worst ? e : worst;
            const float press = s.sim->work.diagonal[i] * s.sim->work.unknown[i];
            residual += fabs(fmin((double)press, -e));
        }
        const sb_pressure_error error = sb_pressure_judge(s.sim);
        assert_true(error.mean == excess / ((double)s.sim->state.n * rest));
        assert_near(error.residual, residual / ((double)s.sim->state.n * rest), 1e-15);
        assert_true(error.max == worst / rest);
    }
    s.sim->state.n = s.n;
    problem_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(source_operator_and_diagonal_agree),
        cmocka_unit_test(both_forms_of_the_passes_agree),
        cmocka_unit_test(errors_are_those_of_a_plain_loop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

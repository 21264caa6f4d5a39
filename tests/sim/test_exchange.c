/* All that crosses the edge of a domain goes through the exchange: another implementation sees every refresh, sum,
   maximum and flag, and determines its result. */
#include "../check.h"
#include "sim/exchange/exchange.h"
#include "sim/tank.h"

#include <string.h>

static struct calls {
    int ghosts, refreshes, sums, counts, largest, flags;
} calls;
static bool other_fails;

static sb_status make_ghosts(sb_sim *sim, sb_error *error)
{
    calls.ghosts++;
    return sb_exchange_alone.make_ghosts(sim, error);
}

static void refresh(const sb_sim *sim, const sb_halo *halo)
{
    calls.refreshes++;
    sb_exchange_alone.refresh(sim, halo);
}

static void sum(const sb_sim *sim, sb_exact *values, size_t count)
{
    calls.sums++;
    sb_exchange_alone.sum(sim, values, count);
}

/* As if another domain had the same sums. */
static void sum_twice(const sb_sim *sim, sb_exact *values, size_t count)
{
    (void)sim;
    for (size_t k = 0; k < count; k++) {
        const sb_exact same = values[k];
        sb_exact_merge(&values[k], &same);
    }
}

static void count_twice(const sb_sim *sim, uint64_t *values, size_t count)
{
    (void)sim;
    for (size_t k = 0; k < count; k++) values[k] *= 2;
}

static void count(const sb_sim *sim, uint64_t *values, size_t many)
{
    calls.counts++;
    sb_exchange_alone.count(sim, values, many);
}

static double largest(const sb_sim *sim, double value)
{
    calls.largest++;
    return sb_exchange_alone.largest(sim, value);
}

static bool any(const sb_sim *sim, bool flag)
{
    (void)sim;
    calls.flags++;
    return flag || other_fails;
}

static const sb_exchange counting = {"counting", make_ghosts, refresh, sum, count, largest, any};

static sb_sim *make(tank *t)
{
    tank_make(t, 3, 0.1, sb_vec(0.8, 0.6, 0.8), 0.8, 0.5, 0.1);
    tank_add_terms(t);
    tank_repeat(t, 0);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

static void a_step_goes_through_the_exchange(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = make(&t);
    uint64_t hash[2];
    memset(&calls, 0, sizeof calls);
    other_fails = false;
    sim->exchange = &counting;
    assert_int_equal(tank_steps(sim, 3), 0);
    const int sweeps = sim->state.sweeps;
    assert_int_equal(calls.ghosts, 3);
    /* In each sweep the argument and the acceleration; in each step at least six fields more. */
    assert_true(calls.refreshes >= 3 * 6 + 2 * sweeps);
    assert_true(calls.sums > 3 * 4 && calls.largest > 3 * 4 && calls.counts >= 3 * 2 && calls.flags >= 3 * 10);
    hash[0] = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    tank_free(&t);
    sim = make(&t);
    assert_int_equal(tank_steps(sim, 3), 0);
    hash[1] = sb_sim_hash(sim);
    assert_true(hash[0] == hash[1]);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Sums of two equal domains: energy, momentum and mass are twice as large; means are the same. */
static void sums_are_those_of_all_domains(void **state)
{
    (void)state;
    sb_exchange two = sb_exchange_alone;
    sb_energy energy[2];
    double error[2], compression[2];
    two.sum = sum_twice;
    two.count = count_twice;
    for (int k = 0; k < 2; k++) {
        tank t;
        sb_sim *sim = make(&t);
        if (k) sim->exchange = &two;
        assert_int_equal(tank_steps(sim, 2), 0);
        energy[k] = sb_sim_energy(sim);
        error[k] = sb_sim_report(sim)->error_mean;
        compression[k] = sb_sim_report(sim)->compression;
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(energy[0].kinetic > 0 && error[0] > 0 && compression[0] > 0);
    assert_true(energy[1].kinetic == 2 * energy[0].kinetic && energy[1].mass == 2 * energy[0].mass);
    assert_true(energy[1].momentum.x == 2 * energy[0].momentum.x);
    assert_true(error[1] == error[0] && compression[1] == compression[0]);
}

static void a_failure_elsewhere_ends_the_step(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = make(&t);
    sb_error error = {0};
    other_fails = true;
    sim->exchange = &counting;
    assert_int_equal(sb_sim_step(sim, &error), SB_FAILED);
    assert_string_equal(error.text, "step 1: stage time_step failed in another part of the domain");
    other_fails = false;
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_goes_through_the_exchange),
        cmocka_unit_test(sums_are_those_of_all_domains),
        cmocka_unit_test(a_failure_elsewhere_ends_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* All that crosses the edge of a domain goes through the exchange: another implementation sees every refresh, sum,
   count, maximum and status, and determines its result. Alone, ghosts have the values of their originals. */
#include "base/memory.h"
#include "check.h"
#include "sim/exchange/exchange.h"
#include "sim/tank.h"

#include <string.h>

static struct calls {
    int ghosts, refreshes, sums, counts, largest, agreements;
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

static double sum_and_largest(const sb_sim *sim, sb_exact *values, size_t count, double value)
{
    calls.sums++;
    calls.largest++;
    return sb_exchange_alone.sum_and_largest(sim, values, count, value);
}

static double sum_twice_and_largest(const sb_sim *sim, sb_exact *values, size_t count, double value)
{
    sum_twice(sim, values, count);
    return value;
}

static sb_status agree(const sb_sim *sim, sb_status own, sb_error *error)
{
    (void)sim;
    calls.agreements++;
    return other_fails ? sb_fail(error, SB_FAILED, "%s", "the other domain has failed") : own;
}

static const sb_exchange counting = {.name = "counting",
                                     .make_ghosts = make_ghosts,
                                     .refresh = refresh,
                                     .sum = sum,
                                     .sum_and_largest = sum_and_largest,
                                     .count = count,
                                     .largest = largest,
                                     .agree = agree};

static sb_sim *make(tank *t)
{
    tank_make(t, 3, 0.1, sb_vec(0.8, 0.6, 0.8), 0.8, 0.5, 0.1);
    tank_add_terms(t);
    tank_repeat(t, 0);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

/* The particle that the ghost is an image of, by its position. */
static size_t original_of(const sb_sim *sim, size_t ghost)
{
    const sb_record home = sb_space_wrap(&sim->space, sim->state.position[sim->state.n + ghost]);
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_record own = sim->state.position[i];
        if (own[0] == home[0] && own[1] == home[1] && own[2] == home[2]) return i;
    }
    fail_msg("ghost %zu is the image of no particle", ghost);
    return 0;
}

/* After a refresh each ghost has the value of the particle that it is an image of, and nothing else has changed. */
static void ghosts_have_their_originals_values(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = make(&t);
    assert_int_equal(tank_prepare(sim, 0.001), 0);
    const size_t n = sim->state.n, ghosts = sim->ghosts.count, all = n + ghosts;
    assert_true(ghosts > 100);
    float *values = sb_alloc(all + 1, sizeof *values);
    sb_f4 *vectors = sb_alloc(all + 1, sizeof *vectors);
    sb_record *before = sb_alloc(ghosts, sizeof *before);
    assert_true(values && vectors && before);
    for (size_t i = 0; i <= all; i++) {
        values[i] = i < n ? (float)i : -1;
        vectors[i] = i < n ? (sb_f4){(float)i, 1, 2, (float)i} : (sb_f4){-1, -1, -1, -1};
    }
    memcpy(before, sim->state.position + n, ghosts * sizeof *before);
    sb_refresh_values(sim, values);
    sb_refresh(sim, vectors);
    sb_refresh_carried(sim, values);
    for (size_t i = 0; i < n; i++) assert_true(values[i] == (float)i && vectors[i][0] == (float)i);
    for (size_t g = 0; g < ghosts; g++) {
        const float expected = (float)original_of(sim, g);
        const sb_record at = sim->state.position[n + g];
        assert_true(values[n + g] == expected && sb_carried_value(at) == expected);
        assert_true(vectors[n + g][0] == expected && vectors[n + g][1] == 1 && vectors[n + g][3] == expected);
        assert_true(at[0] == before[g][0] && at[1] == before[g][1] && at[2] == before[g][2]);
    }
    assert_true(values[all] == -1 && vectors[all][0] == -1);
    sb_free(values);
    sb_free(vectors);
    sb_free(before);
    sb_sim_destroy(sim);
    tank_free(&t);
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
    assert_true(calls.sums > 3 * 4 && calls.largest > 3 * 4 && calls.counts >= 3 * 2 && calls.agreements >= 3 * 10);
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
    two.sum_and_largest = sum_twice_and_largest;
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
    assert_string_equal(error.text, "the other domain has failed");
    other_fails = false;
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ghosts_have_their_originals_values),
        cmocka_unit_test(a_step_goes_through_the_exchange),
        cmocka_unit_test(sums_are_those_of_all_domains),
        cmocka_unit_test(a_failure_elsewhere_ends_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

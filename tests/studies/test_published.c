/* Tests of the published tables against their printed percentages, and of the costs in the paper's terms. */
#include "check.h"

#include "cost.h"
#include "published.h"

/* Tables 3 and 10 print the shares of T_c, T_q, T_a and T_p in T, to a tenth of a per cent. */
static void test_times_have_the_printed_shares(void **state)
{
    (void)state;
    static const struct {
        int number;
        double shares[4];
    } printed[] = {{1, {5.4, 55.0, 17.5, 22.1}},  {2, {4.3, 37.5, 14.0, 44.3}},   {3, {3.3, 23.1, 10.7, 62.9}},
                   {4, {2.4, 17.1, 8.0, 72.5}},   {12, {10.1, 14.8, 10.9, 64.2}}, {13, {8.3, 18.8, 13.2, 59.7}},
                   {14, {7.2, 33.5, 12.1, 47.2}}, {15, {2.8, 44.0, 11.6, 41.6}}};
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++) {
        const sb_published *p = sb_published_find(printed[i].number);
        assert_non_null(p);
        const double parts[4] = {p->structure, p->query, p->advection, p->pressure};
        /* Times are rounded to 1 s. */
        for (int k = 0; k < 4; k++) assert_near(100 * parts[k] / p->total, printed[i].shares[k], 0.06 + 60 / p->total);
        assert_near(parts[0] + parts[1] + parts[2] + parts[3], p->total, 3);
    }
}

/* Within a set only its parameter differs; halving xi takes 1.73 times the sweeps. */
static void test_sets_vary_one_thing(void **state)
{
    (void)state;
    for (int set = 0; sb_published_sets[set].title; set++) {
        const sb_published *first = sb_published_find(sb_published_sets[set].numbers[0]), *p;
        for (const int *n = sb_published_sets[set].numbers; *n; n++) {
            assert_non_null(p = sb_published_find(*n));
            assert_true(set == SB_SET_LAMBDA || p->lambda == first->lambda);
            assert_true(set == SB_SET_TOLERANCE || p->tolerance == first->tolerance);
            assert_true(set == SB_SET_SPACING || p->spacing == first->spacing);
            assert_true(set == SB_SET_TABLE || set == SB_SET_SPACING || p->table == first->table);
        }
    }
    const int *xi = sb_published_sets[SB_SET_TOLERANCE].numbers;
    for (int k = 0; xi[k + 1]; k++)
        assert_near(sb_published_find(xi[k])->sweeps / sb_published_find(xi[k + 1])->sweeps, 1.73, 0.08);
}

static const char summary[] =
    "{\n  \"wall_s\": 12,\n  \"wall_settling_s\": 2,\n  \"simulated_s\": 2,\n  \"steps\": 40,\n  \"threads\": 2,\n"
    "  \"fluid_particles\": 1000,\n  \"boundary_particles\": 300,\n  \"mean_iterations\": 5,\n"
    "  \"stages\": [\n"
    "    {\n      \"name\": \"time_step\",\n      \"seconds\": 0.3125,\n      \"calls\": 50,\n      "
    "\"settling_seconds\": 0.0625\n    },\n"
    "    {\n      \"name\": \"sort\",\n      \"seconds\": 0.625,\n      \"calls\": 50,\n      \"settling_seconds\": "
    "0.125\n    },\n"
    "    {\n      \"name\": \"ghosts\",\n      \"seconds\": 0.1875,\n      \"calls\": 50,\n      \"settling_seconds\": "
    "0.0625\n    },\n"
    "    {\n      \"name\": \"neighbours\",\n      \"seconds\": 2.5,\n      \"calls\": 50,\n      "
    "\"settling_seconds\": 0.5\n    },\n"
    "    {\n      \"name\": \"pressure\",\n      \"seconds\": 5,\n      \"calls\": 50,\n      \"settling_seconds\": "
    "1\n    },\n"
    "    {\n      \"name\": \"impulse\",\n      \"seconds\": 1.25,\n      \"calls\": 50,\n      \"settling_seconds\": "
    "0.25\n    }\n  ]\n}\n";

static void test_stages_are_grouped_as_in_paper(void **state)
{
    (void)state;
    sb_cost c;
    assert_int_equal(sb_cost_read(summary, &c, NULL), SB_OK);
    assert_near(c.structure, 0.625, 0);
    assert_near(c.query, 2, 0);
    assert_near(c.pressure, 4, 0);
    assert_near(c.advection, 1.25, 0);
    assert_near(c.settling, 2, 0);
    assert_near(c.total, 7.875, 0);
    assert_near(c.other, 2.125, 0);
    assert_near(c.steps, 40, 0);
    assert_near(sb_cost_per_particle_step(c.total, c.fluid, c.steps), 196875, 1e-6);
    assert_int_equal(sb_cost_read("{\"wall_s\": 1}", &c, NULL), SB_BAD_INPUT);
}

/* 80 steps with twice the sweeps: other stages take twice as long, the solve four times. */
static void test_extrapolation_by_steps_and_sweeps(void **state)
{
    (void)state;
    sb_cost c;
    assert_int_equal(sb_cost_read(summary, &c, NULL), SB_OK);
    assert_near(sb_cost_extrapolate(&c, 80, 10).total, 2 * 3.875 + 4 * 4, 1e-12);
    assert_near(sb_cost_extrapolate(&c, c.steps, c.sweeps).total, 7.875, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_times_have_the_printed_shares),
        cmocka_unit_test(test_sets_vary_one_thing),
        cmocka_unit_test(test_stages_are_grouped_as_in_paper),
        cmocka_unit_test(test_extrapolation_by_steps_and_sweeps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

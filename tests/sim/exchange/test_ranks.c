/* Runs on several ranks have the bits of a run alone: the state's hash, the time and the energy, for any number of
   ranks and threads, and however messages are delayed and reordered. */
#include "check.h"
#include "sim/exchange/ranks_case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check_frames(const ranks_case *c, const sb_frame *a, const sb_frame *b)
{
    assert_true(a && b);
    if (a->count != b->count) fail_msg("%s: a frame of %zu particles, expected %zu", c->name, b->count, a->count);
    assert_memory_equal(a->position, b->position, 3 * a->count * sizeof(float));
    assert_memory_equal(a->velocity, b->velocity, 3 * a->count * sizeof(float));
    assert_memory_equal(a->pressure, b->pressure, a->count * sizeof(float));
    assert_memory_equal(a->id, b->id, a->count * sizeof *a->id);
    assert_int_equal(a->foam.count, b->foam.count);
    if (a->foam.count == 0) return;
    printf("  %zu particles of foam\n", a->foam.count);
    assert_memory_equal(a->foam.position, b->foam.position, 3 * a->foam.count * sizeof(float));
    assert_memory_equal(a->foam.id, b->foam.id, a->foam.count * sizeof *a->foam.id);
}

/* All that leaves the simulation, and the saved state. */
static void check_outputs(const ranks_case *c, const ranks_end *alone, const ranks_end *several)
{
    check_frames(c, alone->frame, several->frame);
    if (!ranks_same_samples(alone, several))
        fail_msg("%s: %zu samples, expected the same %zu", c->name, several->found, alone->found);
    assert_true(alone->found > 0 && alone->fluid == several->fluid);
    assert_memory_equal(&several->energy, &alone->energy, sizeof alone->energy);
    assert_int_equal(several->push_count, alone->push_count);
    assert_memory_equal(&several->push, &alone->push, sizeof alone->push);
    assert_memory_equal(&several->crossing, &alone->crossing, sizeof alone->crossing);
    assert_int_equal(several->departures.count, alone->departures.count);
    assert_memory_equal(several->departures.by_side, alone->departures.by_side, sizeof alone->departures.by_side);
    for (size_t d = 0; d < alone->departures.count; d++)
        assert_int_equal(several->departures.first[d].particle, alone->departures.first[d].particle);
    assert_int_equal(several->saved.used, alone->saved.used);
    assert_memory_equal(several->saved.bytes, alone->saved.bytes, alone->saved.used);
}

static void check_same(const ranks_case *c, const ranks_end *alone, const ranks_end *several, int ranks)
{
    if (several->error.status != SB_OK) fail_msg("%s, %d ranks: %s", c->name, ranks, several->error.text);
    if (several->differs) fail_msg("%s: the %d ranks differ", c->name, ranks);
    if (several->hash != alone->hash || several->time != alone->time)
        fail_msg("%s, %d ranks: state hash %016llx at t = %.17g s, expected %016llx at %.17g s", c->name, ranks,
                 (unsigned long long)several->hash, several->time, (unsigned long long)alone->hash, alone->time);
    printf("  %d ranks:", ranks);
    for (int r = 0; r < ranks; r++) printf(" %zu", several->particles[r]);
    printf("\n");
    check_outputs(c, alone, several);
}

/* The case has what it is to test. */
static void check_has(const ranks_case *c, const ranks_end *alone)
{
    const struct {
        ranks_has flag;
        bool has;
        const char *name;
    } kinds[] = {
        {RANKS_FOAM, alone->frame->foam.count > 0, "foam"},
        {RANKS_DEPARTURES, alone->departures.count > 0, "departures"},
        {RANKS_PUSHES, alone->push_count > 0, "recorded forces on walls"},
        {RANKS_INFLOW, alone->crossing.in > 0, "particles that come in"},
    };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if ((c->has & kinds[k].flag) && !kinds[k].has) fail_msg("%s: no %s", c->name, kinds[k].name);
}

/* The run alone, with which others are compared. */
static ranks_end run_alone(const ranks_case *c, const ranks_made *made, const ranks_way *way)
{
    const ranks_end alone = ranks_run(c, made, way);
    if (alone.error.status != SB_OK) fail_msg("%s: %s", c->name, alone.error.text);
    printf("%s: %zu particles, t = %g s; %zu recorded forces, %zu departures, %g came in\n", c->name, alone.fluid,
           alone.time, alone.push_count, alone.departures.count, (double)alone.crossing.in);
    check_has(c, &alone);
    return alone;
}

/* Runs a case alone, and in these ways. */
static void check_case(const ranks_case *c, const ranks_way *ways, size_t count)
{
    ranks_made made;
    ranks_make(c, &made);
    ranks_end alone = run_alone(c, &made, &(ranks_way){.ranks = 1, .threads = 2});
    for (size_t k = 0; k < count; k++) {
        ranks_end several = ranks_run(c, &made, &ways[k]);
        check_same(c, &alone, &several, ways[k].ranks);
        ranks_end_free(&several);
    }
    ranks_end_free(&alone);
    ranks_free(&made);
}

static void any_number_of_ranks(void **state)
{
    (void)state;
    static const ranks_way ways[] = {
        {.ranks = 2, .threads = 2}, {.ranks = 3, .threads = 1}, {.ranks = 4, .threads = 1}, {.ranks = 7, .threads = 1}};
    check_case(&ranks_column, ways, sizeof ways / sizeof *ways);
}

/* Each rank places a part of the water and samples a part of the walls: with its own model, none has all particles. */
static void each_rank_places_a_part(void **state)
{
    (void)state;
    static const ranks_way ways[] = {{.ranks = 2, .threads = 2, .divided = true, .water = true},
                                     {.ranks = 5, .threads = 1, .divided = true, .water = true}};
    check_case(&ranks_sea, ways, sizeof ways / sizeof *ways);
}

static void messages_in_any_order(void **state)
{
    (void)state;
    static const ranks_way ways[] = {{.ranks = 3, .threads = 1, .disturb = 1},
                                     {.ranks = 3, .threads = 1, .disturb = 2}};
    check_case(&ranks_column, ways, sizeof ways / sizeof *ways);
}

static void each_kind_of_scene(void **state)
{
    (void)state;
    const char *only = getenv("SB_RANKS_CASE");
    for (int k = 0; ranks_cases[k].name; k++) {
        const ranks_case *c = &ranks_cases[k];
        const int ranks = 2 + k % 3;
        const ranks_way ways[] = {{.ranks = ranks, .threads = 1, .divided = c->divided},
                                  {.ranks = ranks, .threads = 2, .disturb = 3, .divided = c->divided}};
        if (!only || strstr(c->name, only)) check_case(c, ways, c->disturbed ? 2 : 1);
    }
}

/* A state saved by `from` ranks, and continued by others, is that of a run that was not interrupted. */
static void saved_states_have_no_trace_of_ranks(void **state)
{
    (void)state;
    enum { BEFORE = 3, AFTER = 3 };
    ranks_made made;
    ranks_make(&ranks_column, &made);
    ranks_end alone = run_alone(&ranks_column, &made, &(ranks_way){.ranks = 1, .threads = 1, .steps = BEFORE});
    ranks_end whole =
        run_alone(&ranks_column, &made, &(ranks_way){.ranks = 1, .threads = 1, .from = &alone.saved, .steps = AFTER});
    ranks_end four = ranks_run(&ranks_column, &made, &(ranks_way){.ranks = 4, .threads = 1, .steps = BEFORE});
    for (int ranks = 1; ranks <= 3; ranks += 2) {
        ranks_end rest = ranks_run(&ranks_column, &made,
                                   &(ranks_way){.ranks = ranks, .threads = 1, .from = &four.saved, .steps = AFTER});
        check_same(&ranks_column, &whole, &rest, ranks);
        ranks_end_free(&rest);
    }
    ranks_end_free(&four);
    ranks_end_free(&whole);
    ranks_end_free(&alone);
    ranks_free(&made);
}

/* SB_RANKS_RUNS short runs, each with messages in another order (tools/ranks-test). */
static void many_runs_with_messages_in_any_order(void **state)
{
    (void)state;
    enum { STEPS = 2 };
    const int runs = atoi(getenv("SB_RANKS_RUNS"));
    ranks_made made;
    ranks_make(&ranks_column, &made);
    ranks_end alone = run_alone(&ranks_column, &made, &(ranks_way){.ranks = 1, .threads = 1, .steps = STEPS});
    assert_true(runs > 0);
    for (int k = 1; k <= runs; k++) {
        const ranks_way way = {.ranks = 2 + k % 4, .threads = 1 + k % 2, .disturb = (uint64_t)k, .steps = STEPS};
        ranks_end several = ranks_run(&ranks_column, &made, &way);
        check_same(&ranks_column, &alone, &several, way.ranks);
        ranks_end_free(&several);
    }
    ranks_end_free(&alone);
    ranks_free(&made);
}

int main(void)
{
    const struct CMUnitTest many[] = {cmocka_unit_test(many_runs_with_messages_in_any_order)};
    if (getenv("SB_RANKS_RUNS")) return cmocka_run_group_tests(many, NULL, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_ranks),
        cmocka_unit_test(each_rank_places_a_part),
        cmocka_unit_test(messages_in_any_order),
        cmocka_unit_test(each_kind_of_scene),
        cmocka_unit_test(saved_states_have_no_trace_of_ranks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

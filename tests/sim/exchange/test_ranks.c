/* Runs on several ranks have the bits of a run alone: the state's hash, the time and the energy, for any number of
   ranks and threads, and however messages are delayed and reordered. */
#include "check.h"
#include "sim/exchange/ranks_case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COLUMN "assets/validation/column/column.yaml"
#define FLUME "assets/scenes/solitary-flume.yaml"
#define TANK "tests/sim/tank.yaml"
#define BOTH_PERIODIC                                                                                                  \
    "domain={min: [0, 0, 0], max: [0.9, 0.7, 1], sides: {x_min: periodic, x_max: periodic, y_min: periodic, "          \
    "y_max: periodic}}",                                                                                               \
        "water={boxes: [{min: [0, 0, 0], max: [0.45, 0.7, 0.5]}]}"

static const ranks_case column = {"column", COLUMN, 6, {"resolution=0.05", "numerics.settle_steps=4"}};

static const ranks_case cases[] = {
    {"column with boundary particles",
     COLUMN,
     6,
     {"resolution=0.05", "numerics.settle_steps=4", "numerics.walls=particles"}},
    {"paper's numerics", COLUMN, 6, {"resolution=0.05", "numerics.settle_steps=4", "numerics.preset=paper"}},
    {"conjugate gradients", COLUMN, 6, {"resolution=0.05", "numerics.settle_steps=4", "numerics.solver=cg"}},
    {"jacobi", COLUMN, 6, {"resolution=0.05", "numerics.settle_steps=4", "numerics.solver=jacobi"}},
    {"turbulence",
     COLUMN,
     6,
     {"resolution=0.05", "numerics.settle_steps=4", "numerics.turbulence=sps", "fluid.viscosity=1e-3"}},
    {"solitary wave and paddle",
     FLUME,
     8,
     {"resolution=0.1", "domain.max=[12, 2]", "water.seed=[5, 0.5]", "measure={interval: 0.05}",
      "numerics.settle_steps=4"}},
    {"periodic along both axes", TANK, 8, {BOTH_PERIODIC}},
    {"periodic channel",
     TANK,
     8,
     {"domain={min: [0, 0, 0], max: [3, 0.5, 1], sides: {y_min: periodic, y_max: periodic}}",
      "water={boxes: [{min: [0, 0, 0], max: [1, 0.5, 0.6]}]}", "resolution=0.08"}},
    {"absorbing paddle in plates, and a sponge",
     TANK,
     10,
     {"domain={min: [-0.6, 0, 0], max: [2, 1.2, 1.2]}", "resolution=0.15",
      "water={boxes: [{min: [0, 0, 0], max: [2, 0.6, 1.2], level: 0.65}, {min: [0, 0.6, 0], max: [2, 1.2, 1.2], level: "
      "0.5}]}",
      "bodies=[{name: paddle, shape: box, min: [-0.5, 0, 0], max: [0, 1.2, 1.2]}]",
      "wavemakers=[{name: taker, body: paddle, kind: absorber, depth: 0.6, period: 1.5, plates: {width: 0.45}}]",
      "sponges=[{name: beach, side: x_max, length: 1, period: 1, depth: 0.6}]", "numerics.settle_steps=4"}},
    {"water leaves",
     TANK,
     25,
     {"domain={min: [0, 0, 0], max: [0.8, 0.6, 1], sides: {x_max: open}}",
      "water={boxes: [{min: [0, 0, 0], max: [0.7, 0.6, 0.7]}]}", "numerics.settle_steps=0"}},
    {"given sea at two sides of a flume",
     TANK,
     45,
     {"dimensions=2", "domain={min: [0, 0], max: [4, 1.8], sides: {x_min: sea, x_max: sea}}",
      "water={level: 1, seed: [2, 0.9]}",
      "sea={source: theory, wave: components, depth: 1, ramp: 0.2, components: [{amplitude: 0.2, period: 1.6}]}",
      "numerics.settle_steps=4"}},
    {"given sea at a corner",
     TANK,
     25,
     {"resolution=0.2", "domain={min: [0, 0, 0], max: [3.2, 3.2, 1.8], sides: {x_min: sea, y_max: sea}}",
      "water={level: 1, seed: [1.6, 1.6, 0.8]}",
      "sea={source: theory, wave: components, depth: 1, ramp: 0.2, components: [{amplitude: 0.2, period: 1.6}]}",
      "numerics.settle_steps=4"}},
    {"foam", COLUMN, 14, {"resolution=0.05", "numerics.settle_steps=4", "foam={enabled: true, most: 200}"}},
    {"weakly compressible water",
     COLUMN,
     8,
     {"resolution=0.05", "numerics.preset=wen", "numerics.walls=particles", "numerics.kernel_correction=none"}},
    {"dynamic boundary particles", COLUMN, 8, {"resolution=0.05", "numerics.preset=wen"}},
    {"surface tension",
     TANK,
     10,
     {"fluid.surface_tension=0.0728", "domain={min: [0, 0, 0], max: [0.02, 0.02, 0.02]}", "resolution=0.001",
      "water={boxes: [{min: [0.004, 0.004, 0.004], max: [0.014, 0.010, 0.012]}]}"}},
    {"surface tension in 2D",
     TANK,
     10,
     {"dimensions=2", "fluid.surface_tension=0.0728", "domain={min: [0, 0], max: [0.04, 0.04]}", "resolution=0.001",
      "water={boxes: [{min: [0.004, 0.004], max: [0.034, 0.016]}]}"}},
};
enum { CASES = sizeof cases / sizeof cases[0] };

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

/* The run alone, with which others are compared. */
static ranks_end run_alone(const ranks_case *c, const ranks_made *made, const ranks_way *way)
{
    const ranks_end alone = ranks_run(c, made, way);
    if (alone.error.status != SB_OK) fail_msg("%s: %s", c->name, alone.error.text);
    printf("%s: %zu particles, t = %g s; %zu recorded forces, %zu departures, %g came in\n", c->name, alone.fluid,
           alone.time, alone.push_count, alone.departures.count, (double)alone.crossing.in);
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
    check_case(&column, ways, sizeof ways / sizeof *ways);
}

static void messages_in_any_order(void **state)
{
    (void)state;
    static const ranks_way ways[] = {{.ranks = 3, .threads = 1, .disturb = 1},
                                     {.ranks = 3, .threads = 1, .disturb = 2}};
    check_case(&column, ways, sizeof ways / sizeof *ways);
}

static void each_kind_of_scene(void **state)
{
    (void)state;
    const char *only = getenv("SB_RANKS_CASE");
    for (size_t c = 0; c < CASES; c++) {
        const ranks_way way = {.ranks = 2 + (int)(c % 3), .threads = 1};
        if (!only || strstr(cases[c].name, only)) check_case(&cases[c], &way, 1);
    }
}

/* A state saved by `from` ranks, and continued by others, is that of a run that was not interrupted. */
static void saved_states_have_no_trace_of_ranks(void **state)
{
    (void)state;
    enum { BEFORE = 3, AFTER = 3 };
    ranks_made made;
    ranks_make(&column, &made);
    ranks_end alone = run_alone(&column, &made, &(ranks_way){.ranks = 1, .threads = 1, .steps = BEFORE});
    ranks_end whole =
        run_alone(&column, &made, &(ranks_way){.ranks = 1, .threads = 1, .from = &alone.saved, .steps = AFTER});
    ranks_end four = ranks_run(&column, &made, &(ranks_way){.ranks = 4, .threads = 1, .steps = BEFORE});
    for (int ranks = 1; ranks <= 3; ranks += 2) {
        ranks_end rest =
            ranks_run(&column, &made, &(ranks_way){.ranks = ranks, .threads = 1, .from = &four.saved, .steps = AFTER});
        check_same(&column, &whole, &rest, ranks);
        ranks_end_free(&rest);
    }
    ranks_end_free(&four);
    ranks_end_free(&whole);
    ranks_end_free(&alone);
    ranks_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_ranks),
        cmocka_unit_test(messages_in_any_order),
        cmocka_unit_test(each_kind_of_scene),
        cmocka_unit_test(saved_states_have_no_trace_of_ranks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

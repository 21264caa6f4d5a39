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
#define SEA "water={level: 0.4, seed: [0.05, 0.05, 0.05]}"
#define WAVE "initial_wave={kind: solitary, height: 0.1, position: 0.3, depth: 0.4, direction: [1, 0]}"

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
    {"periodic along both axes",
     TANK,
     8,
     {"domain={min: [0, 0, 0], max: [0.9, 0.7, 1], sides: {x_min: periodic, x_max: periodic, y_min: periodic, y_max: "
      "periodic}}",
      "water={boxes: [{min: [0, 0, 0], max: [0.45, 0.7, 0.5]}]}"}},
    {"periodic channel",
     TANK,
     8,
     {"domain={min: [0, 0, 0], max: [3, 0.5, 1], sides: {y_min: periodic, y_max: periodic}}",
      "water={boxes: [{min: [0, 0, 0], max: [1, 0.5, 0.6]}]}", "resolution=0.08"}},
};
enum { CASES = sizeof cases / sizeof cases[0] };

static void check_same(const ranks_case *c, const ranks_end *alone, const ranks_end *several, int ranks)
{
    if (several->error.status != SB_OK) fail_msg("%s, %d ranks: %s", c->name, ranks, several->error.text);
    if (several->differs) fail_msg("%s: the %d ranks differ", c->name, ranks);
    if (several->hash != alone->hash || several->time != alone->time)
        fail_msg("%s, %d ranks: state hash %016llx at t = %.17g s, expected %016llx at %.17g s", c->name, ranks,
                 (unsigned long long)several->hash, several->time, (unsigned long long)alone->hash, alone->time);
    assert_memory_equal(&several->energy, &alone->energy, sizeof alone->energy);
}

/* Runs a case alone, and on each of these numbers of ranks. */
static void check_case(const ranks_case *c, const int *counts, size_t count, int threads, uint64_t disturb)
{
    ranks_made made;
    ranks_make(c, &made);
    const ranks_end alone = ranks_run(c, &made, 1, 2, 0);
    if (alone.error.status != SB_OK) fail_msg("%s: %s", c->name, alone.error.text);
    printf("%s: %zu particles, t = %g s\n", c->name, alone.particles[0], alone.time);
    for (size_t k = 0; k < count; k++) {
        const ranks_end several = ranks_run(c, &made, counts[k], threads, disturb);
        check_same(c, &alone, &several, counts[k]);
        printf("  %d ranks:", counts[k]);
        for (int r = 0; r < counts[k]; r++) printf(" %zu", several.particles[r]);
        printf("\n");
    }
    ranks_free(&made);
}

static void any_number_of_ranks(void **state)
{
    (void)state;
    static const int counts[] = {2, 3, 4, 7};
    check_case(&column, counts, sizeof counts / sizeof *counts, 1, 0);
}

static void messages_in_any_order(void **state)
{
    (void)state;
    static const int counts[] = {3};
    for (uint64_t seed = 1; seed <= 3; seed++) check_case(&column, counts, 1, 2, seed);
}

static void each_kind_of_scene(void **state)
{
    (void)state;
    const char *only = getenv("SB_RANKS_CASE");
    for (size_t c = 0; c < CASES; c++) {
        const int count = 2 + (int)(c % 3);
        if (!only || strstr(cases[c].name, only)) check_case(&cases[c], &count, 1, 1, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_ranks),
        cmocka_unit_test(messages_in_any_order),
        cmocka_unit_test(each_kind_of_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

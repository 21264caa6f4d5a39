/* Domains: a bad cut is mended without a trace in the bits, particles are where the cut says, and a failure in one rank
   is told by all, with the message of a run alone. */
#include "base/memory.h"
#include "check.h"
#include "sim/exchange/domains.h"
#include "sim/exchange/ranks_case.h"
#include "sim/search/sort.h"
#include "sim/step/stages.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

#define BASIN "domain={min: [0, 0, 0], max: [2.4, 1.2, 1]}"
#define WATER "water={boxes: [{min: [0, 0, 0], max: [1.2, 1.2, 0.6]}]}"

static const ranks_case basin = {
    .name = "basin", .file = "tests/sim/tank.yaml", .set = {BASIN, WATER, "numerics.settle_steps=0"}};

static const ranks_case paper = {.name = "basin of the paper",
                                 .file = "tests/sim/tank.yaml",
                                 .set = {BASIN, WATER, "numerics.preset=paper", "numerics.settle_steps=0"}};

enum { RANKS = 3, STEPS = 20 };
static const uint32_t NONE = UINT32_MAX;

typedef struct job {
    const ranks_made *made;
    bool spoil; /* one rank begins with all the water */
    int full;   /* steps that begin as if all numbers of particles were in use; 0: STEPS, with as many as there are */
    uint32_t fast;                           /* a particle that is too fast in the end; NONE: none */
    uint32_t slower;                         /* another one, half as fast if `fast` is too fast */
    int misplaced[RANKS];                    /* particles that are not in their rank's range of keys after a sort */
    bool has_fast[RANKS], has_slower[RANKS]; /* in the end */
    uint64_t hash[RANKS], cuts[RANKS];
    double imbalance[RANKS], mean[RANKS], worst[RANKS];
    size_t first_owned[RANKS];
    size_t walls[RANKS]; /* static boundary particles that a rank has in the end */
    sb_error error[RANKS];
} job;

/* The sort has put all particles into their domains, one domain after another in the order of keys and ids. */
static int count_misplaced(const sb_sim *sim)
{
    int misplaced = 0;
    for (size_t i = 0; sim->domains && i < sim->state.n; i++) {
        const uint64_t key = sb_space_key(&sim->space, sim->state.position[i]);
        misplaced += !sb_domains_owns(sim->domains, key);
        if (i == 0) continue;
        const uint64_t before = sb_space_key(&sim->space, sim->state.position[i - 1]);
        misplaced += before > key || (before == key && sim->state.id[i - 1] >= sim->state.id[i]);
    }
    return misplaced;
}

static void spoil(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    for (int r = 1; r < d->ranks->count; r++) d->cut[r] = r == 1 ? 0 : UINT64_MAX;
}

static void run(sb_ranks *ranks, void *context)
{
    job *j = context;
    const int rank = sb_ranks_own(ranks);
    sb_sim *sim = NULL;
    omp_set_num_threads(1);
    sb_status status = sb_sim_create(&j->made->scene, &j->made->model, ranks, &sim, &j->error[rank]);
    if (status == SB_OK && j->spoil && sim->domains) spoil(sim);
    if (status == SB_OK) status = sb_sim_settle(sim, &j->error[rank]);
    for (int step = 0; step < (j->full ? j->full : STEPS) && status == SB_OK; step++) {
        if (j->full) sim->work.everywhere = ((uint64_t)1 << SB_INDEX_BITS) - 1;
        status = sb_sim_step(sim, &j->error[rank]);
        if (step == 0) j->first_owned[rank] = sb_sim_owned(sim);
    }
    for (size_t i = 0; status == SB_OK && i < sim->state.n && j->fast != NONE; i++) {
        if (sim->state.id[i] == j->fast) sim->state.velocity[i][0] = 1e6f;
        if (sim->state.id[i] == j->slower) sim->state.velocity[i][0] = 5e5f;
        j->has_fast[rank] |= sim->state.id[i] == j->fast;
        j->has_slower[rank] |= sim->state.id[i] == j->slower;
    }
    if (status == SB_OK && j->fast != NONE) status = sb_sim_step(sim, &j->error[rank]);
    if (status == SB_OK) {
        j->hash[rank] = sb_sim_hash(sim);
        const sb_division division = sb_sim_division(sim);
        j->imbalance[rank] = division.imbalance;
        j->worst[rank] = division.worst;
        j->cuts[rank] = division.cuts;
        j->mean[rank] = division.mean;
        status = sb_stage_sort(sim, &j->error[rank]);
        j->misplaced[rank] = count_misplaced(sim);
        j->walls[rank] = sim->walls.set[SB_STATIC].count;
    }
    sb_sim_destroy(sim);
}

static void run_on_ranks(job *j)
{
    sb_error error = {0};
    if (sb_ranks_threads_run(RANKS, 0, run, j, &error) != SB_OK) fail_msg("%s", error.text);
}

static void a_bad_cut_is_mended(void **state)
{
    (void)state;
    ranks_made made;
    ranks_make(&basin, &made);
    job alone = {.made = &made, .fast = NONE}, ranks = {.made = &made, .spoil = true, .fast = NONE};
    run(NULL, &alone);
    run_on_ranks(&ranks);
    assert_int_equal(ranks.first_owned[0], 0);
    assert_int_equal(ranks.first_owned[2], 0);
    for (int r = 0; r < RANKS; r++) {
        if (ranks.error[r].status != SB_OK) fail_msg("%s", ranks.error[r].text);
        assert_true(ranks.hash[r] == alone.hash[0]);
        assert_int_equal(ranks.misplaced[r], 0);
        assert_true(ranks.cuts[r] >= 1 && ranks.cuts[r] <= 2);
        /* Blocks of up to 170 of the 864 particles are not divided. */
        assert_true(ranks.imbalance[r] < 0.12 && ranks.imbalance[r] == ranks.imbalance[0]);
        assert_true(ranks.worst[r] >= ranks.imbalance[r] && ranks.worst[r] == ranks.worst[0]);
        assert_true(ranks.mean[r] > 0 && ranks.mean[r] <= ranks.worst[r] && ranks.mean[r] == ranks.mean[0]);
    }
    printf("imbalance %g after %d cuts\n", ranks.imbalance[0], (int)ranks.cuts[0]);
    for (int r = 0; r < RANKS; r++) {
        printf("rank %d has %zu of %zu boundary particles\n", r, ranks.walls[r], alone.walls[0]);
        assert_true(ranks.walls[r] > 0 && ranks.walls[r] < alone.walls[0]);
    }
    ranks_free(&made);
}

/* Runs alone and on ranks, which all give the message of the run alone. */
static job fail_alike(const job *what)
{
    job alone = *what, ranks = *what;
    run(NULL, &alone);
    run_on_ranks(&ranks);
    assert_int_equal(alone.error[0].status, SB_FAILED);
    for (int r = 0; r < RANKS; r++) {
        assert_int_equal(ranks.error[r].status, SB_FAILED);
        assert_string_equal(ranks.error[r].text, alone.error[0].text);
    }
    return ranks;
}

static void a_failure_is_told_by_all(void **state)
{
    (void)state;
    ranks_made made;
    ranks_make(&basin, &made);
    for (uint32_t fast = 0; fast < (uint32_t)made.model.fluid_count; fast += (uint32_t)made.model.fluid_count / 3) {
        const job one = {.made = &made, .fast = fast, .slower = NONE};
        (void)fail_alike(&one);
    }
    printf("%s\n", "the same message in all ranks");
    ranks_free(&made);
}

/* Of two particles in different ranks that are too fast, all name the faster one, in whichever rank it is. Without the
   correction of stresses, which comes earlier and names the one with the least id. */
static void the_fastest_is_named(void **state)
{
    (void)state;
    ranks_made made;
    ranks_make(&paper, &made);
    const uint32_t last = (uint32_t)made.model.fluid_count - 1;
    const uint32_t pairs[][2] = {{0, last}, {last, 0}};
    for (int k = 0; k < 2; k++) {
        const job two = {.made = &made, .fast = pairs[k][0], .slower = pairs[k][1]};
        const job ranks = fail_alike(&two);
        char name[32];
        snprintf(name, sizeof name, "particle %u ", two.fast);
        if (!strstr(ranks.error[0].text, name)) fail_msg("\"%s\", expected %s", ranks.error[0].text, name);
        for (int r = 0; r < RANKS; r++) assert_false(ranks.has_fast[r] && ranks.has_slower[r]);
    }
    printf("%s\n", "the message of the fastest particle");
    ranks_free(&made);
}

/* The limit of particles is that of all ranks together. */
static void too_many_come_in(void **state)
{
    (void)state;
    const ranks_case *c = ranks_cases;
    while (c->name && !(c->has & RANKS_INFLOW)) c++;
    assert_non_null(c->name);
    ranks_made made;
    ranks_make(c, &made);
    const job full = {.made = &made, .full = c->steps, .fast = NONE};
    const job ranks = fail_alike(&full);
    if (!strstr(ranks.error[0].text, "more water comes in from the sea than")) fail_msg("%s", ranks.error[0].text);
    printf("%s\n", ranks.error[0].text);
    ranks_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bad_cut_is_mended),
        cmocka_unit_test(a_failure_is_told_by_all),
        cmocka_unit_test(the_fastest_is_named),
        cmocka_unit_test(too_many_come_in),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Passes that follow an exchange begin while its values are on their way: nothing reads them before they have come, and
   most groups of a domain need none. */
#include "base/memory.h"
#include "check.h"
#include "sim/exchange/domains.h"
#include "sim/exchange/ranks_case.h"
#include "sim/passes/passes.h"
#include "sim/search/around.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* Water that each domain has more of than its neighbours see. */
#define CHANNEL "domain={min: [0, 0, 0], max: [12, 0.6, 1]}"
#define WATER "water={boxes: [{min: [0, 0, 0], max: [9.6, 0.6, 0.4]}]}"
#define WIDE "domain={min: [0, 0, 0], max: [12, 2, 1]}"
#define WIDE_WATER "water={boxes: [{min: [0, 0, 0], max: [9.6, 2, 0.4]}]}"
#define AT_ONCE "numerics.settle_steps=0"

enum { RANKS = 3, STEPS = 4 };

typedef struct job {
    const ranks_made *made;
    uint64_t hash[RANKS];
    int passes[RANKS],
        early[RANKS];    /* of the pressure, viscosity and strain; those that began while values were on their way */
    double inner[RANKS]; /* share of the groups that read no ghosts */
    int ahead[RANKS];    /* passes that began while the stopping test was on its way */
    int begun[RANKS];    /* those of them that had computed groups when it came */
    sb_error error[RANKS];
} job;

/* Of the thread of a rank. */
static _Thread_local int passes, early;
static _Thread_local double inner;
static _Thread_local int ahead, begun;

/* Spoils the values that are on their way. */
static void watch(const sb_sim *sim)
{
    const float spoilt = NAN;
    passes++;
    if (!sim->domains || !sim->domains->under_way) return;
    const sb_halo *halo = &sim->domains->flight;
    for (size_t k = 0; k < sim->ghosts.halo + sim->ghosts.count; k++)
        for (size_t at = 0; at < halo->size; at += sizeof spoilt)
            memcpy((char *)halo->ghosts + k * halo->ghost_stride + at, &spoilt, sizeof spoilt);
    early++;
    inner = (double)sim->groups.inner / (double)sim->groups.count;
}

/* A pass ahead of the stopping test reads no ghosts: theirs are those of the sweep before. They are spoilt meanwhile.
 */
static void accelerate_ahead(sb_sim *sim)
{
    const size_t ghosts = sim->ghosts.halo + sim->ghosts.count, n = sim->state.n;
    sb_record *kept = sb_alloc_untouched(ghosts, sizeof *kept);
    assert_non_null(kept);
    memcpy(kept, sim->state.position + n, ghosts * sizeof *kept);
    for (size_t k = 0; k < ghosts; k++) sb_carry(&sim->state.position[n + k], NAN);
    sb_passes_choose()->accelerate(sim);
    memcpy(sim->state.position + n, kept, ghosts * sizeof *kept);
    sb_free(kept);
    ahead++;
    begun += sim->work.groups_ahead > 0;
}

static void accelerate(sb_sim *sim)
{
    if (sim->domains && sim->domains->sums.under_way) {
        accelerate_ahead(sim);
        return;
    }
    watch(sim);
    sb_passes_choose()->accelerate(sim);
}

static void diverge(sb_sim *sim, const sb_f4 *field, float factor, float *out)
{
    watch(sim);
    sb_passes_choose()->diverge(sim, field, factor, out);
}

static sb_status forces(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error)
{
    watch(sim);
    return sb_passes_choose()->forces(sim, viscous, law, error);
}

static void mean_deviator(sb_sim *sim)
{
    watch(sim);
    sb_passes_choose()->mean_deviator(sim);
}

static void run(sb_ranks *ranks, void *context)
{
    job *j = context;
    const int rank = sb_ranks_own(ranks);
    sb_sim *sim = NULL;
    sb_passes watched = *sb_passes_choose();
    watched.accelerate = accelerate;
    watched.diverge = diverge;
    watched.forces = forces;
    watched.mean_deviator = mean_deviator;
    passes = early = ahead = begun = 0;
    omp_set_num_threads(1);
    sb_status status = sb_sim_create(&j->made->scene, &j->made->model, ranks, &sim, &j->error[rank]);
    if (status == SB_OK) sim->passes = &watched;
    for (int step = 0; step < STEPS && status == SB_OK; step++) status = sb_sim_step(sim, &j->error[rank]);
    if (status == SB_OK) j->hash[rank] = sb_sim_hash(sim);
    j->ahead[rank] = ahead;
    j->begun[rank] = begun;
    j->passes[rank] = passes;
    j->early[rank] = early;
    j->inner[rank] = inner;
    sb_sim_destroy(sim);
}

static void check_case(const ranks_case *c)
{
    ranks_made made;
    sb_error error = {0};
    ranks_make(c, &made);
    job alone = {.made = &made}, several = {.made = &made};
    run(NULL, &alone);
    if (alone.error[0].status != SB_OK) fail_msg("%s: %s", c->name, alone.error[0].text);
    assert_int_equal(alone.early[0], 0);
    if (sb_ranks_threads_run(RANKS, 0, run, &several, &error) != SB_OK) fail_msg("%s", error.text);
    for (int r = 0; r < RANKS; r++) {
        if (several.error[r].status != SB_OK) fail_msg("%s, rank %d: %s", c->name, r, several.error[r].text);
        printf("%s, rank %d: %d of %d passes began early, %.0f %% of the groups inside\n", c->name, r, several.early[r],
               several.passes[r], 100 * several.inner[r]);
        assert_true(several.passes[r] > 0 && several.early[r] == several.passes[r]);
        assert_true(several.inner[r] > 0 && several.inner[r] < 1);
        assert_int_equal(several.hash[r], alone.hash[0]);
    }
    ranks_free(&made);
}

static void values_that_come_are_not_read_before(void **state)
{
    (void)state;
    check_case(&(ranks_case){.name = "channel", .file = "tests/sim/tank.yaml", .set = {CHANNEL, WATER, AT_ONCE}});
}

/* While the stopping test is on its way the next sweep begins, more or less of it, and the last one of each solve is
   dropped: the bits are those of one rank. Messages are late and in any order. */
static void sweeps_begin_before_the_test_has_come(void **state)
{
    (void)state;
    const ranks_case c = {.name = "disturbed", .file = "tests/sim/tank.yaml", .set = {CHANNEL, WATER, AT_ONCE}};
    ranks_made made;
    sb_error error = {0};
    ranks_make(&c, &made);
    job alone = {.made = &made};
    run(NULL, &alone);
    int sum = 0, some = 0;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        job several = {.made = &made};
        if (sb_ranks_threads_run(2 + (int)(seed % 2), seed, run, &several, &error) != SB_OK) fail_msg("%s", error.text);
        for (int r = 0; r < 2 + (int)(seed % 2); r++) {
            if (several.error[r].status != SB_OK) fail_msg("rank %d: %s", r, several.error[r].text);
            assert_int_equal(several.hash[r], alone.hash[0]);
            sum += several.ahead[r];
            some += several.begun[r];
        }
    }
    printf("%d passes began ahead, %d of them computed groups\n", sum, some);
    assert_true(sum > 50 && some > 10);
    assert_int_equal(alone.ahead[0], 0);
    ranks_free(&made);
}

/* Images beyond periodic sides are made from values that come. */
static void images_wait_as_well(void **state)
{
    (void)state;
    check_case(&(ranks_case){.name = "periodic channel",
                             .file = "tests/sim/tank.yaml",
                             .set = {WIDE, WIDE_WATER, AT_ONCE, "domain.sides={y_min: periodic, y_max: periodic}"}});
}

static void each_solver_waits(void **state)
{
    (void)state;
    static const char *const solvers[] = {"numerics.solver=cg", "numerics.solver=jacobi"};
    for (int k = 0; k < 2; k++)
        check_case(&(ranks_case){
            .name = solvers[k], .file = "tests/sim/tank.yaml", .set = {CHANNEL, WATER, AT_ONCE, solvers[k]}});
}

/* Around the first group are owned particles only; around the others a run that goes on with ghosts, and one of ghosts.
 */
static void inner_groups_read_no_ghosts(void **state)
{
    (void)state;
    sb_run runs[] = {{0, 6}, {6, 4}, {2, 3}, {8, 3}, {0, 1}, {10, 2}};
    sb_group groups[] = {{.run = 2, .runs = 2}, {.run = 0, .runs = 2}, {.run = 4, .runs = 2}};
    sb_sim sim = {.state.n = 10, .groups = {.group = groups, .count = 3, .run = runs}};
    assert_int_equal(sb_groups_order(&sim), 0);
    assert_int_equal(sim.groups.inner, 1);
    assert_int_equal(sim.groups.order[0], 1);
    assert_int_equal(sim.groups.order[1] + sim.groups.order[2], 2);
    sb_free(sim.groups.order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inner_groups_read_no_ghosts),
        cmocka_unit_test(values_that_come_are_not_read_before),
        cmocka_unit_test(sweeps_begin_before_the_test_has_come),
        cmocka_unit_test(images_wait_as_well),
        cmocka_unit_test(each_solver_waits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Memory that runs out in one rank ends the run of all with the same message: no rank waits for another one. One
   allocation fails, of any rank, because ranks allocate at the same time. A rank that waits in vain ends the test. */
#include "base/memory.h"
#include "check.h"
#include "sim/exchange/ranks_case.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RANKS = 2, STEPS = 2, STRIDE = 211, FIRST = 40, SAMPLES = 64, RUNS_MAX = 100000 };

typedef struct job {
    const ranks_made *made;
    sb_error error[RANKS];
} job;

/* What reads the water of all ranks after the steps. */
static sb_status read_water(sb_sim *sim, sb_error *error)
{
    sb_fluid_sample samples[SAMPLES];
    sb_sim_find_virial_pressures(sim);
    sb_frame *frame = sb_sim_snapshot(sim);
    if (!frame) return sb_fail_memory(error, "a frame");
    sb_frame_release(frame);
    const sb_vec3 far = sb_vec(100, 100, 100);
    const size_t found = sb_sim_query(sim, sb_scale(far, -1), far, samples, SAMPLES);
    return found == SIZE_MAX ? sb_fail_memory(error, "samples") : SB_OK;
}

static void run(sb_ranks *ranks, void *context)
{
    job *j = context;
    sb_error *error = &j->error[sb_ranks_own(ranks)];
    sb_sim *sim = NULL;
    omp_set_num_threads(1);
    sb_push_place places[RANKS_BODIES_MAX];
    const size_t count = ranks_places(j->made, places);
    sb_status status = sb_sim_create(&j->made->scene, &j->made->model, ranks, &sim, error);
    if (status == SB_OK) status = sb_sim_record_pushes(sim, places, count, error);
    if (status == SB_OK) status = sb_sim_settle(sim, error);
    for (int step = 0; step < STEPS && status == SB_OK; step++) status = sb_sim_step(sim, error);
    if (status == SB_OK) status = read_water(sim, error);
    sb_sim_destroy(sim);
}

/* Runs with the n-th allocation failing. Returns whether there was one. */
static bool fail_one(const ranks_case *c, const ranks_made *made, long n)
{
    job j = {.made = made};
    sb_error error = {0};
    sb_memory_fail_at(n);
    const sb_status status = sb_ranks_threads_run(RANKS, 0, run, &j, &error);
    const bool failed = !sb_memory_fail_pending();
    sb_memory_fail_at(0);
    if (status != SB_OK) return failed; /* the ranks themselves */
    for (int r = 0; r < RANKS; r++) {
        const sb_error *e = &j.error[r];
        if ((e->status == SB_FAILED && strstr(e->text, "out of memory")) != failed || (!failed && e->status != SB_OK))
            fail_msg("%s, allocation %ld, rank %d: status %d, \"%s\"", c->name, n, r, (int)e->status, e->text);
        if (strcmp(e->text, j.error[0].text) != 0)
            fail_msg("%s, allocation %ld, rank %d: \"%s\", expected \"%s\"", c->name, n, r, e->text, j.error[0].text);
    }
    return failed;
}

static long next_of(long n, long first)
{
    const char *requested = getenv("SB_EACH_ALLOCATION");
    return n < first || (requested && strcmp(requested, "all") == 0) ? n + 1 : n + STRIDE;
}

/* first: so many allocations fail one after another; later ones with strides. */
static void fail_each(const ranks_case *c, long first)
{
    ranks_made made;
    ranks_make(c, &made);
    long n = 1 + STRIDE / 2;
    if (first > 0) n = 1;
    while (n < RUNS_MAX && fail_one(c, &made, n)) n = next_of(n, first);
    printf("%s: %ld allocations\n", c->name, n);
    assert_true(n > 2 * STRIDE);
    ranks_free(&made);
}

static void the_beginning(void **state)
{
    (void)state;
    fail_each(&ranks_column, FIRST);
}

static void each_kind_of_scene(void **state)
{
    (void)state;
    for (const ranks_case *c = ranks_cases; c->name; c++) fail_each(c, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_beginning),
        cmocka_unit_test(each_kind_of_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

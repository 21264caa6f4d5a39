/* Walls that reflect water where many facets are near each other: the search divides groups of particles until their
   images are few enough, and this changes no sum. */
#include "base/memory.h"
#include "check.h"
#include "sim/passes/passes.h"
#include "sim/walls/basin.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Blocks of one spacing with alleys of one spacing between them, in shallow water. Their tops are far from it: an edge
   that reflection at the floor moves would make the ends of shadows sharp for the groups that are near it. */
static void fill_alleys(basin *b, int blocks)
{
    char bodies[2048] = "[";
    for (int k = 0; k < blocks * blocks; k++) {
        const double x = 0.3 + 0.1 * (k % blocks), y = 0.3 + 0.1 * (k / blocks); /* NOLINT(bugprone-integer-division) */
        const size_t used = strlen(bodies);
        snprintf(bodies + used, sizeof bodies - used,
                 "%s{name: b%d, shape: box, min: [%.2f, %.2f, 0], max: [%.2f, %.2f, 0.8]}", k > 0 ? ", " : "", k, x, y,
                 x + 0.05, y + 0.05);
    }
    strcat(bodies, "]");
    basin_fill(b, 3, "0.05", "[1, 1, 0.9]", "{level: 0.2, seed: [0.1, 0.1, 0.1]}", bodies, "completed");
}

static uint64_t hash_after(int blocks, int threads)
{
    basin b;
    omp_set_num_threads(threads);
    fill_alleys(&b, blocks);
    assert_int_equal(tank_steps(b.sim, 2), 0);
    const uint64_t hash = sb_sim_hash(b.sim);
    basin_free(&b);
    return hash;
}

/* 16 blocks have more images around one block of cells than the search can hold. */
static void groups_are_divided(void **state)
{
    (void)state;
    basin b;
    fill_alleys(&b, 4);
    const size_t before = b.sim->groups.count;
    assert_int_equal(tank_steps(b.sim, 1), 0);
    const size_t after = b.sim->groups.count;
    printf("%zu groups were divided into %zu\n", before, after);
    assert_true(after > before);
    uint32_t next = 0;
    for (size_t g = 0; g < after; g++) {
        assert_int_equal(b.sim->groups.group[g].first, next);
        next = b.sim->groups.group[g].end;
    }
    assert_int_equal(next, b.sim->state.n);
    basin_free(&b);
    const int threads = omp_get_max_threads();
    assert_true(hash_after(4, 1) == hash_after(4, 2));
    omp_set_num_threads(threads);
}

/* Four blocks need no division. The search of each particle for itself gives the same sums. */
static void division_changes_no_sum(void **state)
{
    (void)state;
    basin b;
    sb_error error = {0};
    fill_alleys(&b, 2);
    assert_int_equal(tank_prepare(b.sim, 0.01), 0);
    sb_groups *groups = &b.sim->groups;
    const size_t n = b.sim->state.n, count = groups->count;
    float *density = sb_alloc(n, sizeof *density), *diagonal = sb_alloc(n, sizeof *diagonal);
    sb_f4 *push = sb_alloc(n, sizeof *push);
    assert_true(density && diagonal && push);
    assert_int_equal(b.sim->passes->neighbours(b.sim, &error), SB_OK); /* later stages have corrected the density */
    memcpy(density, b.sim->work.density, n * sizeof *density);
    memcpy(diagonal, b.sim->work.diagonal, n * sizeof *diagonal);
    memcpy(push, b.sim->work.image_push, n * sizeof *push);
    assert_int_equal(sb_grow((void **)&groups->group, &groups->capacity, n, sizeof *groups->group), 0);
    for (uint32_t i = 0; i < n; i++) groups->group[i] = (sb_group){.first = i, .end = i + 1};
    groups->count = n;
    assert_int_equal(b.sim->passes->neighbours(b.sim, &error), SB_OK);
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fabs((double)(b.sim->work.density[i] / density[i] - 1)));
        most =
            fmax(most, fabs((double)(b.sim->work.diagonal[i] - diagonal[i])) / (double)b.sim->constant.full_diagonal);
        for (int axis = 0; axis < 3; axis++)
            most = fmax(most, fabs((double)(b.sim->work.image_push[i][axis] - push[i][axis])) / 9.81);
    }
    printf("%zu groups, then %zu: greatest difference %.2g\n", count, n, most);
    assert_true(most < 5e-4); /* weights below 1e-4 are 0, and which edges are near depends on the group */
    sb_free(density);
    sb_free(diagonal);
    sb_free(push);
    basin_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(groups_are_divided), cmocka_unit_test(division_changes_no_sum)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

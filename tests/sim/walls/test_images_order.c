/* Walls that reflect water: the state does not depend on the order in which particles are stored, and facets beyond a
   periodic side act as those of a domain of twice the length. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/walls/basin.h"

#include <stdio.h>

enum { STEPS = 15 };

/* Water that runs against a block, with periodic sides in x. */
static void fill(basin *b, int dimensions)
{
    const bool flat = dimensions == 2;
    const sb_override set[] = {
        {"dimensions", flat ? "2" : "3"},
        {"resolution", flat ? "0.05" : "0.1"},
        {"domain.min", flat ? "[0, 0]" : "[0, 0, 0]"},
        {"domain.max", flat ? "[1.6, 1.2]" : "[1.6, 0.9, 1.2]"},
        {"domain.sides", "{x_min: periodic, x_max: periodic}"},
        {"water",
         flat ? "{boxes: [{min: [0, 0], max: [1.6, 0.4]}, {min: [0.8, 0.4], max: [1.2, 0.7]}]}"
              : "{boxes: [{min: [0, 0, 0], max: [1.6, 0.9, 0.4]}, {min: [0.8, 0, 0.4], max: [1.2, 0.9, 0.7]}]}"},
        {"bodies", flat ? "[{name: block, shape: box, min: [0.1, 0], max: [0.4, 0.5]}]"
                        : "[{name: block, shape: box, min: [0.1, 0.3, 0], max: [0.4, 0.6, 0.5]}]"},
    };
    basin_build(b, set, sizeof set / sizeof *set);
    basin_start(b);
    basin_settle(b);
}

static void the_order_of_storage_does_not_matter(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        uint64_t hash[2];
        for (int shuffled = 0; shuffled < 2; shuffled++) {
            basin b;
            fill(&b, dimensions);
            for (int step = 0; step < STEPS; step++) {
                if (shuffled) tank_shuffle(b.sim, (uint64_t)step << 32);
                assert_int_equal(tank_steps(b.sim, 1), 0);
            }
            assert_true(b.sim->groups.images_used > 0 && b.sim->work.edge_pairs.used > 0);
            hash[shuffled] = sb_sim_hash(b.sim);
            basin_free(&b);
        }
        assert_true(hash[0] == hash[1]);
    }
}

/* ---- periodic sides ---- */

/* Water on a lattice in a periodic domain with a block beside its side; twice: of twice the length, with two blocks. */
static void fill_lattice(basin *b, bool flat, bool twice)
{
    const char *const size = flat    ? (twice ? "[3.2, 1.2]" : "[1.6, 1.2]")
                             : twice ? "[3.2, 0.9, 1.2]"
                                     : "[1.6, 0.9, 1.2]";
    const char *const water =
        flat    ? (twice ? "{boxes: [{min: [0, 0], max: [3.2, 0.8]}]}" : "{boxes: [{min: [0, 0], max: [1.6, 0.8]}]}")
        : twice ? "{boxes: [{min: [0, 0, 0], max: [3.2, 0.9, 0.8]}]}"
                : "{boxes: [{min: [0, 0, 0], max: [1.6, 0.9, 0.8]}]}";
    const char *const bodies = flat    ? (twice ? "[{name: block, shape: box, min: [0.1, 0], max: [0.4, 0.5]},"
                                                  " {name: other, shape: box, min: [1.7, 0], max: [2, 0.5]}]"
                                                : "[{name: block, shape: box, min: [0.1, 0], max: [0.4, 0.5]}]")
                               : twice ? "[{name: block, shape: box, min: [0.1, 0.3, 0], max: [0.4, 0.6, 0.5]},"
                                         " {name: other, shape: box, min: [1.7, 0.3, 0], max: [2, 0.6, 0.5]}]"
                                       : "[{name: block, shape: box, min: [0.1, 0.3, 0], max: [0.4, 0.6, 0.5]}]";
    const sb_override set[] = {
        {"dimensions", flat ? "2" : "3"},
        {"domain.min", flat ? "[0, 0]" : "[0, 0, 0]"},
        {"domain.max", size},
        {"domain.sides", "{x_min: periodic, x_max: periodic}"},
        {"numerics.jitter", "0"},
        {"water", water},
        {"bodies", bodies},
    };
    basin_build(b, set, sizeof set / sizeof *set);
    for (size_t i = 0; i < b->model.fluid_count; i++) { /* off the lattice, the same in each half */
        sb_vec3 *at = &b->model.fluid_position[i];
        const double x = at->x - (at->x > 1.6 ? 1.6 : 0);
        const uint64_t k =
            (uint64_t)lround(20 * x) << 40 | (uint64_t)lround(20 * at->y) << 20 | (uint64_t)lround(20 * at->z);
        *at = sb_add(*at, sb_vec(0.03 * (sb_random(1, k) - 0.5), flat ? 0 : 0.03 * (sb_random(2, k) - 0.5),
                                 0.03 * (sb_random(3, k) - 0.5)));
    }
    basin_start(b);
    assert_int_equal(tank_prepare(b->sim, 0.01), 0);
}

static size_t particle_at(const sb_sim *sim, sb_vec3 at)
{
    for (size_t i = 0; i < sim->state.n; i++)
        if (sb_norm(sb_sub(sb_space_position(&sim->space, sim->state.position[i]), at)) < 1e-4) return i;
    fail_msg("no particle at (%g %g %g)", at.x, at.y, at.z);
    return 0;
}

static void walls_beyond_a_periodic_side(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        basin one, two;
        fill_lattice(&one, dimensions == 2, false);
        fill_lattice(&two, dimensions == 2, true);
        const sb_work *w = &one.sim->work, *v = &two.sim->work;
        assert_int_equal(two.sim->state.n, 2 * one.sim->state.n);
        double density = 0, diagonal = 0, push = 0, pushes = 0;
        for (size_t i = 0; i < one.sim->state.n; i++) {
            const sb_vec3 at = sb_space_position(&one.sim->space, one.sim->state.position[i]);
            for (int half = 0; half < 2; half++) {
                const size_t j = particle_at(two.sim, sb_add(at, sb_vec(half * 1.6, 0, 0)));
                density = fmax(density, fabs((double)(w->density[i] - v->density[j])));
                diagonal = fmax(diagonal, fabs((double)(w->diagonal[i] - v->diagonal[j])) /
                                              (double)one.sim->constant.full_diagonal);
                for (int axis = 0; axis < 3; axis++) {
                    push = fmax(push, fabs((double)(w->image_push[i][axis] - v->image_push[j][axis])));
                    pushes = fmax(pushes, fabs((double)w->image_push[i][axis]));
                }
            }
        }
        printf("  %dD: %zu and %zu images; density differs by %.2g kg/m^3, diagonal by %.2g, push by %.2g of %.2g "
               "m/s^2\n",
               dimensions, one.sim->groups.images_used, two.sim->groups.images_used, density, diagonal, push, pushes);
        /* Pairs at edges are left out below 1e-3 of the largest; round-off decides which. */
        assert_true(density < 0.02 && diagonal < 3e-3 && push < 1e-3 * pushes);
        basin_free(&one);
        basin_free(&two);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_of_storage_does_not_matter),
        cmocka_unit_test(walls_beyond_a_periodic_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

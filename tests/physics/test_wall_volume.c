/* Boundary particles' volumes: what a lattice at rest over a plane asks for, and what edges do. */
#include "../check.h"
#include "base/vec.h"
#include "physics/wall_volume.h"

#include <stdio.h>

enum { REACH = 8 };

/* What is over, of 2 sum_j V grad W + B, 1/spacing, for the water's place k layers from a plane, in the direction
   across; each neighbour by itself. */
static double left_over(const sb_kernel *kernel, int dimension, double support, double offset, double gamma, int k)
{
    const int depth = dimension == 2 ? 0 : REACH;
    const double aside = dimension == 2 ? 0 : 0.5;
    double own = 0, water = 0, wall = 0;
    for (int x = -REACH; x <= REACH; x++)
        for (int y = -depth; y <= depth; y++) {
            own += sb_kernel_value(kernel, dimension, support, sb_norm(sb_vec(x, y, 0)));
            const sb_vec3 to_wall = sb_vec(x + 0.5, y + aside, k + 0.5 + offset);
            wall += sb_kernel_slope(kernel, dimension, support, sb_norm(to_wall)) * to_wall.z / sb_norm(to_wall);
            for (int layer = 0; layer <= k + REACH; layer++) {
                const sb_vec3 d = sb_vec(x, y, k - layer);
                if (sb_norm(d) > 0) water += sb_kernel_slope(kernel, dimension, support, sb_norm(d)) * d.z / sb_norm(d);
            }
        }
    return 2 * water + gamma * wall / own;
}

static double worst(const sb_kernel *kernel, int dimension, double support, double offset, double gamma)
{
    double most = 0;
    for (int k = 0; k < 4; k++) most = fmax(most, fabs(left_over(kernel, dimension, support, offset, gamma, k)));
    return most;
}

/* With the kernel of the defaults and the offset that suits it best, a hundredth of what a layer of water weighs per
   spacing of depth; a twentieth more or less gamma
   leaves three times as much. */
static void a_lattice_rests_on_a_plane(void **state)
{
    (void)state;
    const sb_kernel *kernel = sb_kernel_find("wendland-c2");
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double gamma = sb_wall_gamma(kernel, dimension, 3, 0.575, 1);
        const double best = worst(kernel, dimension, 3, 0.575, gamma);
        printf("%dD: gamma %.4f, left over %.4f\n", dimension, gamma, best);
        assert_true(best < 0.01);
        assert_true(worst(kernel, dimension, 3, 0.575, 0.95 * gamma) > 3 * best);
        assert_true(worst(kernel, dimension, 3, 0.575, 1.05 * gamma) > 3 * best);
    }
}

/* Least squares: no other gamma leaves a smaller sum of squares, whatever kernel and offset. */
static void gamma_is_the_best_one(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 2; dimension <= 3; dimension++)
            for (double offset = 0.4; offset < 0.9; offset += 0.1) {
                const double gamma = sb_wall_gamma(*row, dimension, (*row)->support, offset, 1);
                double sum[3] = {0};
                for (int way = 0; way < 3; way++)
                    for (int k = 0; k < 4; k++)
                        sum[way] +=
                            pow(left_over(*row, dimension, (*row)->support, offset, gamma * (0.99 + 0.01 * way), k), 2);
                assert_true(gamma > 0.1 && sum[1] < sum[0] && sum[1] < sum[2]);
            }
}

/* What stands for a wall hardly depends on how densely it is sampled. */
static void gamma_is_that_of_the_wall(void **state)
{
    (void)state;
    const sb_kernel *kernel = sb_kernel_find("wendland-c2");
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double usual = sb_wall_gamma(kernel, dimension, 3, 0.75, 1);
        for (double spacing = 0.5; spacing < 1; spacing += 0.1)
            assert_near(sb_wall_gamma(kernel, dimension, 3, 0.75, spacing) / usual, 1, 0.02);
    }
}

static void planes_are_left_alone_and_edges_are_not(void **state)
{
    (void)state;
    assert_near(sb_wall_bend(0), 1, 0);
    for (double bulge = 0.05; bulge < 0.21; bulge += 0.05) {
        assert_true(sb_wall_bend(bulge) > sb_wall_bend(bulge - 0.05));
        assert_near(sb_wall_bend(bulge) + sb_wall_bend(-bulge), 2, 1e-12);
        assert_true(sb_wall_bend(-bulge) > 0.5);
    }
    assert_true(sb_wall_bends_with(1) && sb_wall_bends_with(0) && !sb_wall_bends_with(-1));
}

/* The edge that a floor and a wall make, of lines of particles laid square; water in the quarter between: with the
   bend, what is left over within two spacings of it is less than without. */
static double beside_an_edge(bool bend)
{
    const sb_kernel *kernel = sb_kernel_find("wendland-c2");
    const double offset = 0.575, gamma = sb_wall_gamma(kernel, 2, 3, offset, 1);
    enum { SIDE = 12 };
    sb_vec3 at[2 * SIDE], normal[2 * SIDE];
    double psi[2 * SIDE], sum = 0;
    for (int i = 0; i < SIDE; i++) {
        at[2 * i] = sb_vec(i - offset, 0, -offset);
        normal[2 * i] = i > 0 ? sb_vec(0, 0, 1) : sb_normalize(sb_vec(1, 0, 1));
        at[2 * i + 1] = sb_vec(-offset, 0, i + 1 - offset);
        normal[2 * i + 1] = sb_vec(1, 0, 0);
    }
    for (int b = 0; b < 2 * SIDE; b++) {
        double all = 0, bulge = 0;
        for (int k = 0; k < 2 * SIDE; k++) {
            const sb_vec3 d = sb_sub(at[k], at[b]);
            const double w = sb_kernel_value(kernel, 2, 3, sb_norm(d));
            all += w;
            bulge += w * sb_dot(d, normal[b]) / 3;
        }
        psi[b] = gamma / all * (bend ? sb_wall_bend(bulge / all) : 1);
    }
    for (int x = 0; x < 2; x++)
        for (int z = 0; z < 2; z++) {
            const sb_vec3 i = sb_vec(x + 0.5, 0, z + 0.5);
            sb_vec3 rest = {0};
            for (int b = 0; b < 2 * SIDE; b++) {
                const sb_vec3 d = sb_sub(i, at[b]);
                rest = sb_madd(rest, psi[b] * sb_kernel_slope(kernel, 2, 3, sb_norm(d)) / sb_norm(d), d);
            }
            for (int jx = 0; jx < 6; jx++)
                for (int jz = 0; jz < 6; jz++) {
                    const sb_vec3 d = sb_sub(i, sb_vec(jx + 0.5, 0, jz + 0.5));
                    if (sb_norm(d) > 0)
                        rest = sb_madd(rest, 2 * sb_kernel_slope(kernel, 2, 3, sb_norm(d)) / sb_norm(d), d);
                }
            sum += sb_dot(rest, rest);
        }
    return sqrt(sum / 4);
}

static void an_edge_bears_its_water(void **state)
{
    (void)state;
    const double without = beside_an_edge(false), with = beside_an_edge(true);
    printf("left over at an edge: %.4f, with the bend %.4f\n", without, with);
    assert_true(with < 0.6 * without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lattice_rests_on_a_plane), cmocka_unit_test(gamma_is_the_best_one),
        cmocka_unit_test(gamma_is_that_of_the_wall),  cmocka_unit_test(planes_are_left_alone_and_edges_are_not),
        cmocka_unit_test(an_edge_bears_its_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

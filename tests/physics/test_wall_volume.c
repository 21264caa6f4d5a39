/* Wall volumes of boundary particles: the balance of a lattice at rest above a plane, and the effect of edges. */
#include "../check.h"
#include "base/vec.h"
#include "physics/kernels/wall_volume.h"

#include <stdio.h>

enum { RANGE = 8 };

/* The component of 2 sum_j V grad W + B normal to a plane wall, 1/spacing, for a fluid particle of the k-th layer from
   the wall, summed directly over its neighbours. */
static double residual(const sb_kernel *kernel, int dimension, double support, double offset, double gamma, int k)
{
    const int depth = dimension == 2 ? 0 : RANGE;
    const double aside = dimension == 2 ? 0 : 0.5;
    double own = 0, water = 0, wall = 0;
    for (int x = -RANGE; x <= RANGE; x++)
        for (int y = -depth; y <= depth; y++) {
            own += sb_kernel_value(kernel, dimension, support, sb_norm(sb_vec(x, y, 0)));
            const sb_vec3 to_wall = sb_vec(x + 0.5, y + aside, k + 0.5 + offset);
            wall += sb_kernel_slope(kernel, dimension, support, sb_norm(to_wall)) * to_wall.z / sb_norm(to_wall);
            for (int layer = 0; layer <= k + RANGE; layer++) {
                const sb_vec3 d = sb_vec(x, y, k - layer);
                if (sb_norm(d) > 0) water += sb_kernel_slope(kernel, dimension, support, sb_norm(d)) * d.z / sb_norm(d);
            }
        }
    return 2 * water + gamma * wall / own;
}

static double worst(const sb_kernel *kernel, int dimension, double support, double offset, double gamma)
{
    double most = 0;
    for (int k = 0; k < 4; k++) most = fmax(most, fabs(residual(kernel, dimension, support, offset, gamma, k)));
    return most;
}

/* With the default kernel and the offset that fits it best, the residual is below a hundredth of the weight of one
   layer of water per spacing of depth. A gamma that is 5 % larger or smaller gives over three times the residual. */
static void a_lattice_on_a_plane_is_at_rest(void **state)
{
    (void)state;
    const sb_kernel *kernel = sb_kernel_find("wendland-c2");
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double gamma = sb_wall_gamma(kernel, dimension, 3, 0.575, 1);
        const double best = worst(kernel, dimension, 3, 0.575, gamma);
        printf("%dD: gamma %.4f, residual %.4f\n", dimension, gamma, best);
        assert_true(best < 0.01);
        assert_true(worst(kernel, dimension, 3, 0.575, 0.95 * gamma) > 3 * best);
        assert_true(worst(kernel, dimension, 3, 0.575, 1.05 * gamma) > 3 * best);
    }
}

/* Least squares: for each kernel and offset, a gamma that is 1 % larger or smaller gives a larger sum of squares. */
static void gamma_is_the_best_one(void **state)
{
    (void)state;
    for (const sb_kernel *const *row = sb_kernels; *row; row++)
        for (int dimension = 2; dimension <= 3; dimension++)
            for (double offset = 0.4; offset < 0.9; offset += 0.1) {
                const double gamma = sb_wall_gamma(*row, dimension, (*row)->support, offset, 1);
                double sum[3] = {0};
                for (int trial = 0; trial < 3; trial++)
                    for (int k = 0; k < 4; k++)
                        sum[trial] += pow(
                            residual(*row, dimension, (*row)->support, offset, gamma * (0.99 + 0.01 * trial), k), 2);
                assert_true(gamma > 0.1 && sum[1] < sum[0] && sum[1] < sum[2]);
            }
}

/* gamma depends little on the spacing of the boundary particles. */
static void gamma_depends_little_on_the_wall_spacing(void **state)
{
    (void)state;
    const sb_kernel *kernel = sb_kernel_find("wendland-c2");
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double usual = sb_wall_gamma(kernel, dimension, 3, 0.75, 1);
        for (double spacing = 0.5; spacing < 1; spacing += 0.1)
            assert_near(sb_wall_gamma(kernel, dimension, 3, 0.75, spacing) / usual, 1, 0.02);
    }
}

static void curvature_factor_is_one_on_planes_and_differs_at_edges(void **state)
{
    (void)state;
    assert_near(sb_wall_curvature_factor(0), 1, 0);
    for (double curvature = 0.05; curvature < 0.21; curvature += 0.05) {
        assert_true(sb_wall_curvature_factor(curvature) > sb_wall_curvature_factor(curvature - 0.05));
        assert_near(sb_wall_curvature_factor(curvature) + sb_wall_curvature_factor(-curvature), 2, 1e-12);
        assert_true(sb_wall_curvature_factor(-curvature) > 0.5);
    }
    assert_true(sb_wall_curvature_includes(1) && sb_wall_curvature_includes(0) && !sb_wall_curvature_includes(-1));
}

/* The concave edge of a floor and a wall, both lines of boundary particles, with water in the quarter between them.
   Returns the root mean square residual within two spacings of the edge, with or without the curvature factor. */
static double residual_at_an_edge(bool curved)
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
        double all = 0, curvature = 0;
        for (int k = 0; k < 2 * SIDE; k++) {
            const sb_vec3 d = sb_sub(at[k], at[b]);
            const double w = sb_kernel_value(kernel, 2, 3, sb_norm(d));
            all += w;
            curvature += w * sb_dot(d, normal[b]) / 3;
        }
        psi[b] = gamma / all * (curved ? sb_wall_curvature_factor(curvature / all) : 1);
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

static void the_curvature_factor_reduces_the_residual_at_an_edge(void **state)
{
    (void)state;
    const double without = residual_at_an_edge(false), with = residual_at_an_edge(true);
    printf("residual at an edge: %.4f, with the curvature factor %.4f\n", without, with);
    assert_true(with < 0.6 * without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lattice_on_a_plane_is_at_rest),
        cmocka_unit_test(gamma_is_the_best_one),
        cmocka_unit_test(gamma_depends_little_on_the_wall_spacing),
        cmocka_unit_test(curvature_factor_is_one_on_planes_and_differs_at_edges),
        cmocka_unit_test(the_curvature_factor_reduces_the_residual_at_an_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

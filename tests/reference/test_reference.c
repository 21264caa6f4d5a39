/* Tests of the reference itself: lattice values, symmetry of the operator, balance of forces, complementarity of the
   solution; in 2D and 3D, in a box with one moving side and one isolated particle. */
#include "../check.h"
#include "base/random.h"
#include "reference/reference.h"

#include <string.h>

enum { MOST = 1200 };

static sb_vec3 position[MOST], velocity[MOST], wall_position[MOST], wall_velocity[MOST];
static sb_vec3 acceleration[MOST];
static double psi[MOST], rho[MOST], rho_after[MOST], q[MOST], source[MOST], product[MOST];
static double matrix[MOST * 300];
static uint32_t body[MOST];

static double jitter(size_t index)
{
    return sb_random(7, index) - 0.5;
}

static sb_reference_cloud empty_cloud(int dimension, double spacing)
{
    return (sb_reference_cloud){.kernel = sb_kernel_find("cubic"),
                                .dimension = dimension,
                                .h = 2 * spacing,
                                .spacing = spacing,
                                .rest_density = 1000,
                                .time_step = 0.004,
                                .position = position,
                                .velocity = velocity,
                                .wall_position = wall_position,
                                .wall_velocity = wall_velocity,
                                .psi = psi,
                                .body = body,
                                .sound_speed = 10,
                                .artificial_viscosity = 0.05,
                                .wall_friction = 0.1};
}

static void add_wall(sb_reference_cloud *cloud, sb_vec3 x, uint32_t owner)
{
    size_t b = cloud->wall_count++;
    assert_true(b < MOST);
    wall_position[b] = x;
    wall_velocity[b] = owner == 1 ? sb_vec(0.3, 0, 0) : sb_vec(0, 0, 0);
    body[b] = owner;
}

/* A jittered block of 5 x 5 x 6 (5 x 12 in 2D) on a floor, body 0, beside a moving side, body 1. The last particle is
   isolated. */
static sb_reference make_box(int dimension)
{
    const double d = 0.1;
    sb_reference_cloud cloud = empty_cloud(dimension, d);
    int wide = 5, deep = dimension == 3 ? 5 : 1, high = dimension == 3 ? 6 : 12;
    for (int i = 0; i < wide; i++)
        for (int j = 0; j < deep; j++)
            for (int k = 0; k < high; k++) {
                size_t p = cloud.fluid_count++;
                double y = dimension == 3 ? j + 0.3 * jitter(3 * p + 1) : 0;
                position[p] = sb_scale(sb_vec(i + 0.3 * jitter(3 * p), y, k + 0.3 * jitter(3 * p + 2)), d);
                velocity[p] = sb_vec(jitter(5000 + 3 * p), y != 0 ? jitter(5001 + 3 * p) : 0, jitter(5002 + 3 * p));
            }
    position[cloud.fluid_count] = sb_vec(2, 0, 2);
    velocity[cloud.fluid_count++] = sb_vec(1, 0, -1);
    for (int i = -2; i < wide + 2; i++)
        for (int j = dimension == 3 ? -2 : 0; j < (dimension == 3 ? deep + 2 : 1); j++)
            add_wall(&cloud, sb_scale(sb_vec(i, j, -0.95), d), 0);
    for (int k = 0; k < high; k++)
        for (int j = dimension == 3 ? -2 : 0; j < (dimension == 3 ? deep + 2 : 1); j++)
            add_wall(&cloud, sb_scale(sb_vec(-0.97, j, k), d), 1);
    sb_reference_psi(&cloud, 0.8, false, psi);
    sb_reference reference;
    assert_int_equal(sb_reference_create(&cloud, &reference), 0);
    return reference;
}

static void lattice_figures(void **state)
{
    (void)state;
    sb_reference_cloud cloud = empty_cloud(3, 0.5);
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++)
            for (int k = -2; k <= 2; k++) position[cloud.fluid_count++] = sb_vec(0.5 * i, 0.5 * j, 0.5 * k);
    position[cloud.fluid_count++] = sb_vec(99, 0, 0);
    sb_reference reference;
    assert_int_equal(sb_reference_create(&cloud, &reference), 0);
    size_t middle = 62;
    assert_int_equal(reference.fluid_start[middle + 1] - reference.fluid_start[middle], 26);
    sb_reference_density(&reference, rho);
    assert_near(rho[middle], 999.97, 5e-3);
    assert_near(rho[cloud.fluid_count - 1], 318.31, 5e-3);
    sb_reference_diagonal(&reference, product);
    assert_near(product[middle] / sb_reference_lattice_diagonal(&cloud), 1, 1e-12);
    assert_true(product[cloud.fluid_count - 1] == 0);
    sb_reference_destroy(&reference);
}

/* On a plane with one boundary particle per spacing, wall volumes are 1.427 spacing^3 at gamma = 1. */
static void plane_has_its_known_volume(void **state)
{
    (void)state;
    sb_reference_cloud cloud = empty_cloud(3, 0.5);
    for (int i = -4; i <= 4; i++)
        for (int j = -4; j <= 4; j++) add_wall(&cloud, sb_vec(0.5 * i, 0.5 * j, 3), 0);
    sb_reference_psi(&cloud, 1, false, psi);
    assert_near(psi[40] / (1000 * 0.125), 1.427, 5e-4);
    sb_reference_psi(&cloud, 0.7, false, psi);
    assert_near(psi[40] / (1000 * 0.125), 0.7 * 1.427, 5e-4);
}

static void pairs_are_mutual(void **state)
{
    (void)state;
    sb_reference reference = make_box(3);
    size_t n = reference.cloud.fluid_count;
    assert_true(reference.fluid_start[n] > 10 * n && reference.wall_start[n] > 100);
    for (size_t i = 0; i < n; i++)
        for (size_t k = reference.fluid_start[i]; k < reference.fluid_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference.fluid[k], *back = NULL;
            assert_true(pair->other != i && sb_norm(pair->offset) < 0.2);
            for (size_t l = reference.fluid_start[pair->other]; l < reference.fluid_start[pair->other + 1]; l++)
                if (reference.fluid[l].other == i) back = &reference.fluid[l];
            assert_non_null(back);
            assert_true(sb_norm(sb_add(pair->gradient, back->gradient)) == 0);
            assert_true(pair->w == back->w);
        }
    sb_reference_destroy(&reference);
}

/* div is the rate of the density while fluid and walls move. */
static void divergence_is_the_rate_of_the_density(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double step = 1e-6;
        sb_reference reference = make_box(dimension), moved;
        sb_reference_cloud *cloud = &reference.cloud;
        sb_reference_divergence(&reference, velocity, 1, product);
        for (int side = 0; side <= 1; side++) {
            double by = side ? 2 * step : -step;
            for (size_t i = 0; i < cloud->fluid_count; i++) position[i] = sb_madd(position[i], by, velocity[i]);
            for (size_t b = 0; b < cloud->wall_count; b++)
                wall_position[b] = sb_madd(wall_position[b], by, wall_velocity[b]);
            assert_int_equal(sb_reference_create(cloud, &moved), 0);
            sb_reference_density(&moved, side ? rho_after : rho);
            sb_reference_destroy(&moved);
        }
        for (size_t i = 0; i < cloud->fluid_count; i++)
            assert_near((rho_after[i] - rho[i]) / (2 * step), product[i], 1e-3);
        sb_reference_destroy(&reference);
    }
}

static void source_mixes_density_and_divergence(void **state)
{
    (void)state;
    sb_reference reference = make_box(2);
    sb_reference_density(&reference, rho);
    sb_reference_divergence(&reference, velocity, 1, product);
    sb_reference_source(&reference, rho, velocity, 0.3, source);
    for (size_t i = 0; i < reference.cloud.fluid_count; i++)
        assert_near(source[i], 0.3 * (1000 - rho[i]) - 0.004 * product[i], 1e-12 * 1000);
    sb_reference_destroy(&reference);
}

/* The whole matrix, from unit vectors, is symmetric and has the diagonal of the closed form. */
static void operator_is_symmetric_with_its_diagonal(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sb_reference reference = make_box(dimension);
        size_t n = reference.cloud.fluid_count;
        assert_true(n <= 300);
        memset(q, 0, sizeof q);
        for (size_t k = 0; k < n; k++) {
            q[k] = 1;
            sb_reference_apply(&reference, q, acceleration, &matrix[k * n]);
            q[k] = 0;
        }
        sb_reference_diagonal(&reference, product);
        double largest = 0;
        for (size_t k = 0; k < n; k++) largest = fmax(largest, fabs(matrix[k * n + k]));
        assert_true(largest > 0);
        for (size_t k = 0; k < n; k++) {
            assert_near(matrix[k * n + k], product[k], 1e-12 * largest);
            assert_true(product[k] <= 0 && (product[k] < 0 || k == n - 1));
            for (size_t l = 0; l < k; l++) assert_near(matrix[k * n + l], matrix[l * n + k], 1e-12 * largest);
        }
        sb_reference_destroy(&reference);
    }
}

/* x.Ax = -dt^2 |Gx|^2 for any x. */
static void operator_is_negative_semidefinite(void **state)
{
    (void)state;
    sb_reference reference = make_box(3);
    size_t n = reference.cloud.fluid_count;
    for (size_t trial = 0; trial < 50; trial++) {
        double form = 0, squares = 0;
        for (size_t i = 0; i < n; i++) q[i] = jitter(90000 + trial * n + i);
        sb_reference_apply(&reference, q, acceleration, product);
        for (size_t i = 0; i < n; i++) {
            form += q[i] * product[i];
            squares += sb_dot(acceleration[i], acceleration[i]);
        }
        assert_true(form < 0);
        assert_near(form / (-0.004 * 0.004 * squares), 1, 1e-12);
    }
    sb_reference_destroy(&reference);
}

/* Checks that sum m a + forces = 0, and that moments balance, relative to the sum of |m a|. */
static void check_balance(const sb_reference *reference, const sb_vec3 *center, const sb_vec3 *force,
                          const sb_vec3 *torque)
{
    sb_vec3 sum = sb_add(force[0], force[1]);
    sb_vec3 turn = sb_add(torque[0], torque[1]);
    double size = 0;
    for (int k = 0; k < 2; k++) turn = sb_add(turn, sb_cross(center[k], force[k]));
    for (size_t i = 0; i < reference->cloud.fluid_count; i++) {
        sb_vec3 push = sb_scale(acceleration[i], reference->mass);
        sum = sb_add(sum, push);
        turn = sb_add(turn, sb_cross(position[i], push));
        size += sb_norm(push);
    }
    assert_true(size > 0 && sb_norm(force[0]) > 0 && sb_norm(force[1]) > 0);
    assert_near(sb_norm(sum) / size, 0, 1e-14);
    assert_near(sb_norm(turn) / size, 0, 1e-14);
}

static void momentum_is_conserved(void **state)
{
    (void)state;
    const sb_vec3 center[2] = {{0.2, -0.1, 0.4}, {1, 2, 3}};
    for (int dimension = 2; dimension <= 3; dimension++) {
        sb_reference reference = make_box(dimension);
        sb_vec3 force[2] = {{0}}, torque[2] = {{0}};
        for (size_t i = 0; i < reference.cloud.fluid_count; i++) q[i] = 1 + jitter(i);
        sb_reference_pressure_acceleration(&reference, q, acceleration);
        sb_reference_pressure_forces(&reference, q, center, force, torque);
        check_balance(&reference, center, force, torque);
        assert_true(force[0].z < 0 && force[1].x < 0); /* away from the water */
        sb_reference_destroy(&reference);
    }
}

static void viscous_forces_conserve_momentum_and_remove_energy(void **state)
{
    (void)state;
    const sb_vec3 center[2] = {{0.2, -0.1, 0.4}, {1, 2, 3}};
    sb_reference reference = make_box(3);
    size_t n = reference.cloud.fluid_count;
    sb_vec3 force[2] = {{0}}, torque[2] = {{0}};
    sb_reference_density(&reference, rho);
    memset(acceleration, 0, sizeof acceleration);
    sb_reference_viscosity(&reference, rho, acceleration);
    double power = 0;
    for (size_t i = 0; i < n; i++) power += sb_dot(acceleration[i], velocity[i]);
    assert_true(power < 0);
    sb_reference_friction(&reference, rho, acceleration, center, force, torque);
    check_balance(&reference, center, force, torque);
    sb_reference_destroy(&reference);
}

/* Two particles, calculated by hand: viscosity acts if they approach each other, and not if they separate. */
static void viscosity_acts_on_approach_only(void **state)
{
    (void)state;
    sb_reference_cloud cloud = empty_cloud(3, 1);
    cloud.fluid_count = 2;
    for (int sign = -1; sign <= 1; sign += 2) {
        position[0] = sb_vec(0, 0, 0);
        position[1] = sb_vec(1, 0, 0);
        velocity[0] = sb_vec(-3.0 * sign, 5, 0);
        velocity[1] = sb_vec(0, 0, 0);
        rho[0] = 900;
        rho[1] = 1100;
        memset(acceleration, 0, sizeof acceleration);
        sb_reference reference;
        assert_int_equal(sb_reference_create(&cloud, &reference), 0);
        sb_reference_viscosity(&reference, rho, acceleration);
        /* nu = 2 0.05 2 10/2000, Pi = nu 3/1.04, W' = -(8/pi) 6 (1/4)/2^4 */
        double expected = -1000 * (0.001 * 3 / 1.04) * (8 / M_PI * 1.5 / 16);
        assert_near(acceleration[0].x, sign < 0 ? expected : 0, 1e-12);
        assert_near(acceleration[1].x, sign < 0 ? -expected : 0, 1e-12);
        assert_near(acceleration[0].y, 0, 0);
        sb_reference_destroy(&reference);
    }
}

/* On v = (z^2/2, 0, 0), whose Laplacian is 1, the term gives its effective kinematic viscosity alpha h c_s/(2(d + 2)),
   with h the support radius, halved by the switch. The sum needs a fine lattice: at h = 2 spacings it is only 0.65 (2D)
   and 0.70 (3D) of that. */
static void viscosity_has_its_effective_value(void **state)
{
    (void)state;
    const struct {
        double support, share[4];
    } cases[] = {{2, {0, 0, 0.649, 0.698}}, {3, {0, 0, 0.914, 0.938}}, {4.5, {0, 0, 0.94, 0.96}}};
    for (size_t c = 0; c < 3; c++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            sb_reference_cloud cloud = empty_cloud(dimension, 0.5);
            cloud.h = 0.5 * cases[c].support;
            int radius = (int)cases[c].support, deep = dimension == 3 ? radius : 0;
            for (int i = -radius; i <= radius; i++)
                for (int j = -deep; j <= deep; j++)
                    for (int k = -radius; k <= radius; k++) {
                        position[cloud.fluid_count] = sb_vec(0.5 * i, 0.5 * j, 0.5 * k);
                        rho[cloud.fluid_count] = 1000;
                        velocity[cloud.fluid_count++] = sb_vec(0.125 * k * k, 0, 0);
                    }
            memset(acceleration, 0, sizeof acceleration);
            sb_reference reference;
            assert_int_equal(sb_reference_create(&cloud, &reference), 0);
            sb_reference_viscosity(&reference, rho, acceleration);
            double full = 0.05 * cloud.h * 10 / (4 * (dimension + 2));
            assert_near(acceleration[cloud.fluid_count / 2].x / full, cases[c].share[dimension], 0.012);
            sb_reference_destroy(&reference);
        }
}

/* Water falling onto its floor: each particle is either under pressure or has q = 0, and both kinds occur. */
static void solution_is_complementary(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sb_reference reference = make_box(dimension);
        size_t n = reference.cloud.fluid_count, pressed = 0, slack = 0;
        for (size_t i = 0; i < n; i++) velocity[i] = sb_madd(velocity[i], 1, sb_vec(0, 0, -1));
        sb_reference_density(&reference, rho);
        sb_reference_source(&reference, rho, velocity, 1, source);
        assert_int_equal(sb_reference_solve(&reference, source, 1e-11, 3, q), -2);
        assert_true(sb_reference_solve(&reference, source, 1e-11, 10000, q) > 3);
        sb_reference_apply(&reference, q, acceleration, product);
        for (size_t i = 0; i + 1 < n; i++) {
            double excess = product[i] - source[i];
            assert_true(q[i] >= 0);
            assert_true(excess <= 1.1e-8);
            if (q[i] > 1e-6) assert_near(excess, 0, 1.1e-8);
            pressed += q[i] > 1e-6;
            slack += excess < -1e-3;
        }
        assert_true(pressed > n / 5 && slack > n / 10);
        assert_true(q[n - 1] == 0); /* isolated: ballistic */
        sb_reference_destroy(&reference);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_figures),
        cmocka_unit_test(plane_has_its_known_volume),
        cmocka_unit_test(pairs_are_mutual),
        cmocka_unit_test(divergence_is_the_rate_of_the_density),
        cmocka_unit_test(source_mixes_density_and_divergence),
        cmocka_unit_test(operator_is_symmetric_with_its_diagonal),
        cmocka_unit_test(operator_is_negative_semidefinite),
        cmocka_unit_test(momentum_is_conserved),
        cmocka_unit_test(viscous_forces_conserve_momentum_and_remove_energy),
        cmocka_unit_test(viscosity_acts_on_approach_only),
        cmocka_unit_test(viscosity_has_its_effective_value),
        cmocka_unit_test(solution_is_complementary),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The field of the water against direct sums in double precision, and its weights against their principle. */
#include "lattice.h"
#include "surface/level.h"

#include <omp.h>

static const double pi = 3.14159265358979323846;

/* Integral of the kernel along a line at the distance r, by the trapezoidal rule. */
static double along_line(double r)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double x = -2 + 4.0 * i / STEPS;
        sum += sb_level_kernel(sqrt(r * r + x * x));
    }
    return sum * 4 / STEPS;
}

/* Integral over a plane at the distance z. */
static double over_plane(double z)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double r = 2 * (i + 0.5) / STEPS;
        sum += 2 * pi * r * sb_level_kernel(sqrt(r * r + z * z));
    }
    return sum * 2 / STEPS;
}

/* The sum of the kernel at a particle in the middle of the last layer of a lattice with distances a. */
static double density_of(double a, int ni, int nj, int nk)
{
    double sum = 0;
    for (int k = -nk; k <= 0; k++)
        for (int j = -nj; j <= nj; j++)
            for (int i = -ni; i <= ni; i++) sum += sb_level_kernel(a * sqrt(i * i + j * j + k * k));
    return sum;
}

static void the_kernel_is_normalised(void **state)
{
    (void)state;
    double sum = 0;
    for (int i = 0; i < 100; i++) sum += over_plane(-2 + 4 * (i + 0.5) / 100);
    assert_near(sum * 4 / 100, 1, 1e-6);
}

/* With these weights the level encloses the volume of a particle, a row, and layers of two densities. */
static void weights_follow_their_principle(void **state)
{
    (void)state;
    const double sphere = cbrt(3 / (4 * pi)), tube = sqrt(1 / pi);
    assert_near(sb_level_weight(sb_level_kernel(0)) * sb_level_kernel(sphere), 0.5, 1e-6);
    assert_near(sb_level_weight(density_of(1, 1, 0, 0)) * along_line(tube), 0.5, 1e-5);
    assert_near(sb_level_weight(density_of(1.1, 2, 2, 0)) * over_plane(0.5 / 1.21) / 1.21, 0.5, 1e-5);
    assert_near(sb_level_weight(density_of(1, 2, 2, 0)) * over_plane(0.5), 0.5, 1e-5);
    assert_near(sb_level_weight(density_of(1, 2, 2, 2)), 1, 1e-6);
    assert_near(sb_level_weight(1), 1, 0);
}

static sb_frame *cloud(void)
{
    sb_frame *frame = empty_frame(600, 0.5);
    srand(3);
    for (int i = 0; i < 600; i++)
        add_particle(frame, -3 + 7.0 * rand() / RAND_MAX, 6.0 * rand() / RAND_MAX, 2.0 * rand() / RAND_MAX);
    return frame;
}

static double distance(const sb_frame *frame, size_t i, const double at[3])
{
    double sum = 0;
    for (size_t a = 0; a < 3; a++) sum += pow((double)frame->position[3 * i + a] - at[a], 2);
    return sqrt(sum) / frame->spacing;
}

/* Every node near particles has the direct sum; nodes without a block have no particle in reach. */
static void nodes_have_the_direct_sum(void **state)
{
    (void)state;
    static const double cells[] = {0.25, 0.4, 0.5, 1};
    sb_frame *frame = cloud();
    double weights[600];
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        const double at[3] = {(double)p[0], (double)p[1], (double)p[2]};
        double sum = 0;
        for (size_t j = 0; j < frame->count; j++) sum += sb_level_kernel(distance(frame, j, at));
        weights[i] = sb_level_weight(sum);
    }
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
        sb_blocks blocks;
        sb_error error = {0};
        assert_int_equal(sb_blocks_build(frame, cells[c], SB_LEVEL_REACH, &blocks, &error), SB_OK);
        float *value = sb_level_build(&blocks);
        assert_non_null(value);
        double total = 0;
        for (size_t b = 0; b < blocks.count; b++)
            for (int n = 0; n < SB_BLOCK_NODES; n++) {
                total += (double)value[b * SB_BLOCK_NODES + (size_t)n];
                if (n % 37 != (int)(b % 37)) continue; /* a sample: direct sums are slow */
                double at[3], sum = 0;
                sb_blocks_start(&blocks, b, at);
                at[0] += n % 8 * blocks.cell;
                at[1] += n / 8 % 8 * blocks.cell;
                at[2] += n / 64 * blocks.cell;
                for (size_t i = 0; i < frame->count; i++) sum += weights[i] * sb_level_kernel(distance(frame, i, at));
                assert_near((double)value[b * SB_BLOCK_NODES + (size_t)n], sum, 2e-5 * (1 + sum));
            }
        double all = 0;
        for (size_t i = 0; i < frame->count; i++) all += weights[i];
        assert_near(total * pow(cells[c], 3) / all, 1, 0.01); /* no block is missing */
        sb_free(value);
        sb_blocks_free(&blocks);
    }
    sb_frame_release(frame);
}

int main(void)
{
    omp_set_num_threads(2);
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_kernel_is_normalised),
                                       cmocka_unit_test(weights_follow_their_principle),
                                       cmocka_unit_test(nodes_have_the_direct_sum)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

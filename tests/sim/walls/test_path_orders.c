/* Shares of orders of reflection at facets that meet at other than right angles: how much all orders have together,
   where they are those of right angles, and that both ends see the same. */
#include "base/random.h"
#include "check.h"
#include "sim/passes/cpu/path_orders.h"
#include "sim/search/around.h"

#include <stdio.h>

static sb_near near;
static uint64_t draws;

static float draw(void)
{
    return (float)sb_random(5, draws++) * 2 - 1;
}

/* Planes through the corner, with these normals. */
static void stand(const sb_f4 *normal, size_t count)
{
    near.count = count;
    for (size_t a = 0; a < count; a++) {
        near.facet[a] = (sb_near_facet){.plane = normal[a] * sb_splat(1 / sqrtf(sb_sum3(normal[a] * normal[a])))};
        for (size_t b = 0; b < a; b++) {
            const float along = sb_sum3(near.facet[a].plane * near.facet[b].plane);
            near.sectors[a][b] = near.sectors[b][a] = fabsf(along) < 1e-3f ? 2 : (float)M_PI / acosf(-along);
        }
    }
}

/* A place before all planes. */
static sb_f4 place(void)
{
    for (;;) {
        const sb_f4 at = {draw(), draw(), draw(), 0};
        bool before = true;
        for (size_t a = 0; a < near.count; a++) before &= sb_before_facet(&near.facet[a], at) > 0.01f;
        if (before) return at;
    }
}

static float share(const size_t *by, int count, sb_f4 self, sb_f4 source)
{
    sb_path_share of;
    return sb_path_order_share(&near, by, count, self, source, &of) ? of.value : 0;
}

/* Two planes: the images fill the angle round their line, once, as long as four reflections are enough. At a right
   angle one order stands for both. */
static void two_planes_fill_the_angle(void **state)
{
    (void)state;
    static const size_t by[2][4] = {{0, 1, 0, 1}, {1, 0, 1, 0}};
    for (double degrees = 45; degrees <= 120; degrees += 1) {
        const double angle = degrees * M_PI / 180;
        stand((sb_f4[]){{0, 0, 1, 0}, {(float)sin(angle), 0, (float)-cos(angle), 0}}, 2);
        for (int k = 0; k < 20; k++) {
            const sb_f4 self = place(), source = place();
            double all = 3;
            for (int count = 2; count <= 4; count++)
                for (int first = 0; first < (near.sectors[0][1] == 2 ? 1 : 2); first++)
                    all += (double)share(by[first], count, self, source);
            assert_true(fabs(all * angle - 2 * M_PI) < 1e-4);
        }
    }
}

/* Three planes: all six orders together have the product of what pairs have; at right angles, as one word stands for
   all orders there, exactly 1. From the other end, backwards, an order has the same share. */
static void three_planes(void **state)
{
    (void)state;
    static const size_t by[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    stand((sb_f4[]){{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, 3);
    for (int k = 0; k < 6; k++) assert_true(share(by[k], 3, place(), place()) == 1);
    for (int trial = 0; trial < 100; trial++) {
        stand((sb_f4[]){{1, 0.3f * draw(), 0, 0}, {0.3f * draw(), 1, 0.3f * draw(), 0}, {0.3f * draw(), 0, 1, 0}}, 3);
        double product = 1, all = 0;
        bool blunt = true, square = false;
        int acute = 0; /* pairs whose two orders are different images */
        for (int p = 0; p < 3; p++) {
            const double sectors = (double)near.sectors[p][(p + 1) % 3];
            square |= sectors == 2;
            blunt &= sectors < 2;
            acute += sectors > 2;
            product *= fmin(1, 2 * sectors - 3);
        }
        if (square) continue;
        const sb_f4 self = place(), source = place();
        for (int k = 0; k < 6; k++) {
            const size_t back[3] = {by[k][2], by[k][1], by[k][0]};
            const float one = share(by[k], 3, self, source);
            all += (double)one;
            assert_true(fabsf(one - share(back, 3, source, self)) < 1e-4f);
        }
        if (blunt) assert_true(fabs(all - product) < 1e-4);
        assert_true(all > 0.99 * product && all < (1 << acute) * product + 1e-4);
    }
}

/* The derivatives are those of the share. */
static void slopes(void **state)
{
    (void)state;
    double worst = 0;
    for (int trial = 0; trial < 2000; trial++) {
        stand((sb_f4[]){{1, 0.3f * draw(), 0, 0}, {0.3f * draw(), 1, 0.3f * draw(), 0}, {0.3f * draw(), 0, 1, 0}}, 3);
        const size_t by[4] = {(size_t)trial % 3, (size_t)(trial + 1) % 3, (size_t)(trial + 2) % 3, (size_t)trial % 3};
        const int count = 2 + trial % 3;
        const sb_f4 self = place(), source = place(), a = {draw(), draw(), draw(), 0}, b = {draw(), draw(), draw(), 0};
        sb_path_share of;
        if (!sb_path_order_share(&near, by, count, self, source, &of)) continue;
        sb_f4 own = {0}, other = {0};
        for (int k = 0; k < of.facets; k++) {
            own += of.own[k], other += of.other[k];
            const sb_f4 n = near.facet[by[of.at[k]]].plane, both = of.own[k] + of.other[k];
            const sb_f4 across = both - n * sb_splat(sb_sum3(both * n));
            assert_true(sqrtf(sb_sum3(across * across)) < 1e-3f * (1 + sqrtf(sb_sum3(both * both))));
        }
        const float step = 1e-3f, rate = sb_sum3(own * a) + sb_sum3(other * b);
        const float change = share(by, count, self + a * sb_splat(step), source + b * sb_splat(step)) -
                             share(by, count, self - a * sb_splat(step), source - b * sb_splat(step));
        const double off = fabs((double)(change / (2 * step) - rate)) / (1 + sqrt((double)sb_sum3(own * own)));
        worst = fmax(worst, off);
    }
    printf("  derivatives differ by at most %.2g\n", worst);
    assert_true(worst < 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_planes_fill_the_angle), cmocka_unit_test(three_planes),
                                       cmocka_unit_test(slopes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

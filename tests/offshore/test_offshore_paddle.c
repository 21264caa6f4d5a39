/* A side that moves water as a paddle does. */
#include "grid_case.h"
#include "offshore/paddle.h"

#include <math.h>
#include <string.h>

static const double G = 9.81;

static double floor_1m(double x, double y)
{
    (void)x;
    (void)y;
    return -1;
}

static grid_water still(double x, double y, double time)
{
    (void)x;
    (void)y;
    (void)time;
    return (grid_water){.h = 1};
}

/* height: of a solitary wave, or the stroke of a piston with a greatest speed of 0.3 m/s. */
static sb_offshore_paddle *paddle_of(const char *kind, double height, double ahead)
{
    const sb_offshore_paddle_options options = {.law = {.kind = sb_wavemaker_find(kind),
                                                        .height = height,
                                                        .depth = 1,
                                                        .gravity = G,
                                                        .stroke = height,
                                                        .speed = 0.3},
                                                .ahead = ahead,
                                                .depth = 1};
    sb_offshore_paddle *made = NULL;
    sb_error error = {0};
    assert_int_equal(sb_offshore_paddle_create(&options, &made, &error), SB_OK);
    return made;
}

static double highest(const sb_offshore *water, double *place)
{
    const sb_offshore_view v = sb_offshore_read(water);
    size_t top = 1;
    for (size_t i = 1; i + 1 < v.columns; i++) top = v.h[i] > v.h[top] ? i : top;
    const double a = v.h[top - 1], b = v.h[top], c = v.h[top + 1], shift = 0.5 * (a - c) / (a - 2 * b + c);
    *place = v.x + ((double)top + 0.5 + shift) * v.cell;
    return b - 0.25 * (a - c) * shift - 1;
}

/* Rayleigh's profile is the solitary wave of these equations, and Goring's motion of the paddle is that of its water.
   The side stands where the paddle begins, or where it ends. The law begins and ends with a part of its wave missing.
 */
static void solitary_wave_is_exact(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        const double height = (double[]){0.1, 0.3, 0.5, 0.65}[k / 2], c = sqrt(G * (1 + height));
        const double kappa = sqrt(0.75 * height / (1 + height)), stroke = 2 * height / kappa;
        const double ahead = k % 2 ? stroke : 0, duration = 2 / (kappa * c) * (3.8 + height);
        sb_offshore_options options = {.columns = 500,
                                       .rows = 1,
                                       .cell = 0.1,
                                       .x = ahead,
                                       .gravity = G,
                                       .side = {SB_OFFSHORE_PADDLE, SB_OFFSHORE_WALL},
                                       .dispersion = true,
                                       .paddle = paddle_of("goring-rayleigh", height, ahead)};
        sb_offshore *water = grid_create(&options, floor_1m, still);
        double place;
        grid_run(water, duration / 2 + (25 - stroke / 2) / c); /* half way the paddle is at the crest */
        assert_near(highest(water, &place), height, 2e-3 * height);
        assert_near(place, 25, 0.05);
        const sb_offshore_balance b = sb_offshore_find_balance(water);
        assert_near(b.now - b.first, 2 * height / kappa, 1e-3 * 2 * height / kappa);
        assert_near(grid_imbalance(water), 0, 1e-13);
        sb_offshore_destroy(water);
    }
}

/* After its motion it is a wall: the wave comes back from the far wall and from the side with no less height than
   between two walls, and no water passes. */
static void afterwards_it_is_a_wall(void **state)
{
    (void)state;
    const double height = 0.3, c = sqrt(G * (1 + height)), stroke = 2 * height / sqrt(0.75 * height / (1 + height));
    sb_offshore_options options = {.columns = 300,
                                   .rows = 1,
                                   .cell = 0.1,
                                   .x = stroke,
                                   .gravity = G,
                                   .side = {SB_OFFSHORE_PADDLE, SB_OFFSHORE_WALL},
                                   .dispersion = true,
                                   .paddle = paddle_of("goring-rayleigh", height, stroke)};
    sb_offshore *water = grid_create(&options, floor_1m, still);
    double place, before;
    grid_run(water, 13); /* it has passed the far wall, and is on the way back */
    before = highest(water, &place);
    const sb_offshore_balance first = sb_offshore_find_balance(water);
    grid_run(water, 13 + 36 / c); /* and is on the way to the far wall */
    assert_near(highest(water, &place), before, 0.02 * height);
    const sb_offshore_balance last = sb_offshore_find_balance(water);
    assert_near(last.now, first.now, 1e-12);
    assert_near(last.entered[0], first.entered[0], 1e-12);
    sb_offshore_destroy(water);
}

/* A side at rest has the bits of a wall. */
static void at_rest_it_is_a_wall(void **state)
{
    (void)state;
    enum { COLUMNS = 40 };
    double bed[COLUMNS] = {0}, depth[COLUMNS], h[2][COLUMNS];
    sb_error error = {0};
    for (int i = 0; i < COLUMNS; i++) depth[i] = 1 + 0.2 * exp(-0.1 * (i - 15) * (i - 15));
    for (int paddle = 0; paddle < 2; paddle++) {
        sb_offshore_options options = {.columns = COLUMNS, .rows = 1, .cell = 0.1, .gravity = G, .dispersion = true};
        if (paddle) {
            sb_offshore_paddle_options law = {
                .law = {.kind = sb_wavemaker_find("stroke"), .start = 1e3, .stroke = 1, .speed = 1, .gravity = G},
                .depth = 1};
            options.side[0] = SB_OFFSHORE_PADDLE;
            assert_int_equal(sb_offshore_paddle_create(&law, &options.paddle, &error), SB_OK);
        }
        sb_offshore *water = NULL;
        assert_int_equal(sb_offshore_create(&options, bed, depth, NULL, NULL, &water, &error), SB_OK);
        grid_run(water, 2);
        memcpy(h[paddle], sb_offshore_read(water).h, sizeof h[paddle]);
        sb_offshore_destroy(water);
    }
    assert_memory_equal(h[0], h[1], sizeof h[0]);
}

/* Without dispersion a piston makes a simple wave: where the water has the speed u, sqrt(g h) = sqrt(g d) + u/2. At
   each of the four sides. */
static void a_piston_makes_a_simple_wave(void **state)
{
    (void)state;
    for (int side = 0; side < SB_OFFSHORE_SIDES; side++) {
        const bool along_y = side >= SB_OFFSHORE_Y_MIN;
        sb_offshore_options options = {.columns = along_y ? 2 : 600,
                                       .rows = along_y ? 600 : 1,
                                       .cell = 0.02,
                                       .gravity = G,
                                       .paddle = paddle_of("stroke", 0.3, 0)};
        options.side[side] = SB_OFFSHORE_PADDLE;
        sb_offshore *water = grid_create(&options, floor_1m, still);
        grid_run(water, 2); /* before it breaks */
        const sb_offshore_view v = sb_offshore_read(water);
        double top = 0, worst = 0;
        for (size_t k = 0; k < 600; k++) {
            const size_t at = along_y ? k * v.stride : k;
            const double u = (along_y ? v.hv[at] : v.hu[at]) / v.h[at] * (side % 2 ? -1 : 1);
            worst = fmax(worst, fabs(sqrt(G * v.h[at]) - sqrt(G) - u / 2));
            top = fmax(top, u);
        }
        assert_near(top, 0.3, 2e-3);
        assert_near(worst, 0, 2e-3);
        const sb_offshore_balance b = sb_offshore_find_balance(water);
        assert_near(b.entered[side] / (along_y ? 0.04 : 1), 0.3, 1e-3); /* stroke times depth */
        sb_offshore_destroy(water);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solitary_wave_is_exact),
        cmocka_unit_test(afterwards_it_is_a_wall),
        cmocka_unit_test(at_rest_it_is_a_wall),
        cmocka_unit_test(a_piston_makes_a_simple_wave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

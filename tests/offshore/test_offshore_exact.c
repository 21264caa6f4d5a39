/* Exact solutions of the shallow-water equations, and the order at which the model converges to them. */
#include "grid_case.h"

#include <stdio.h>

static const double G = 9.81;

/* Order of convergence between two errors whose cells differ by a factor of 2. */
static double order_of(const char *name, double coarse, double fine)
{
    const double order = log2(coarse / fine);
    print_message("%s: errors %.3g, %.3g, order %.2f\n", name, coarse, fine, order);
    return order;
}

static double flat(double x, double y)
{
    (void)x;
    (void)y;
    return 0;
}

/* Ritter 1892: a dam at x = 0 breaks, 1 m of water to its left and a dry bed to its right. */
static grid_water ritter(double x, double y, double time)
{
    (void)y;
    const double c = sqrt(G);
    if (time == 0) return (grid_water){.h = x < 0};
    const double s = x / time;
    if (s <= -c) return (grid_water){.h = 1};
    if (s >= 2 * c) return (grid_water){0};
    return (grid_water){.h = (2 * c - s) * (2 * c - s) / (9 * G), .u = 2.0 / 3 * (c + s)};
}

/* Depth between the rarefaction from depth 1 and the bore into depth `low` (Stoker 1957), by bisection. */
static double stoker_middle(double low)
{
    double a = low, b = 1;
    for (int k = 0; k < 100; k++) {
        const double h = 0.5 * (a + b);
        const double rarefaction = 2 * (sqrt(G) - sqrt(G * h));
        const double bore = (h - low) * sqrt(0.5 * G * (h + low) / (h * low));
        if (rarefaction > bore)
            a = h;
        else
            b = h;
    }
    return a;
}

static grid_water stoker(double x, double y, double time)
{
    (void)y;
    const double low = 0.1;
    if (time == 0) return (grid_water){.h = x < 0 ? 1 : low};
    const double h = stoker_middle(low), u = 2 * (sqrt(G) - sqrt(G * h)), s = x / time;
    if (s <= -sqrt(G)) return (grid_water){.h = 1};
    if (s <= u - sqrt(G * h)) return (grid_water){.h = (2 * sqrt(G) - s) * (2 * sqrt(G) - s) / (9 * G)};
    return (grid_water){.h = s < u * h / (h - low) ? h : low};
}

static double dam_error(size_t columns, grid_state *dam)
{
    const sb_offshore_options options = {
        .columns = columns, .rows = 1, .x = -10, .cell = 20 / (double)columns, .gravity = G, .dry_depth = 1e-6};
    sb_offshore *offshore = grid_create(&options, flat, dam);
    grid_run(offshore, 1.2);
    const double error = grid_error(offshore, dam);
    sb_offshore_destroy(offshore);
    return error;
}

/* A discontinuity limits the order to 1. */
static void dams_converge(void **state)
{
    (void)state;
    assert_true(order_of("Ritter", dam_error(200, ritter), dam_error(400, ritter)) > 0.85);
    assert_true(order_of("Stoker", dam_error(200, stoker), dam_error(400, stoker)) > 0.85);
    assert_near(dam_error(400, ritter), 0, 2e-3);
    assert_near(dam_error(400, stoker), 0, 2e-3);
}

/* A simple wave u = 2 (c - c0), c constant along dx/dt = 3 c - 2 c0, before it breaks (period 20 m). */
static grid_water simple_wave(double x, double y, double time)
{
    (void)y;
    const double c0 = sqrt(G), k = 2 * M_PI / 20;
    double from = x;
    for (int n = 0; n < 200; n++) {
        const double c = c0 * (1 + 0.05 * sin(k * from)), slope = 1 + time * 3 * c0 * 0.05 * k * cos(k * from);
        from -= (from + (3 * c - 2 * c0) * time - x) / slope;
    }
    const double c = c0 * (1 + 0.05 * sin(k * from));
    return (grid_water){.h = c * c / G, .u = 2 * (c - c0)};
}

static double simple_wave_error(size_t columns)
{
    const sb_offshore_options options = {.columns = columns,
                                         .rows = 1,
                                         .cell = 20 / (double)columns,
                                         .gravity = G,
                                         .side = {SB_OFFSHORE_PERIODIC, SB_OFFSHORE_PERIODIC}};
    sb_offshore *offshore = grid_create(&options, flat, simple_wave);
    grid_run(offshore, 3); /* it breaks at 6.8 s */
    const double error = grid_error(offshore, simple_wave);
    sb_offshore_destroy(offshore);
    return error;
}

static void smooth_wave_converges(void **state)
{
    (void)state;
    const double coarse = simple_wave_error(200), fine = simple_wave_error(400);
    assert_true(order_of("simple wave", coarse, fine) > 1.7);
    assert_near(fine, 0, 1e-4);
}

/* Thacker 1981: depth h0 (1 - r^2 / a^2) at rest. */
static const double H0 = 0.1, A = 1;

static double bowl(double x, double y)
{
    return -H0 * (1 - (x * x + y * y) / (A * A));
}

/* A plane surface that turns around the bowl. */
static grid_water turning(double x, double y, double time)
{
    const double w = sqrt(2 * G * H0) / A, s = 0.5 * A;
    const double surface = s * H0 / (A * A) * (2 * x * cos(w * time) + 2 * y * sin(w * time) - s);
    const double h = surface - bowl(x, y);
    return h > 0 ? (grid_water){.h = h, .u = -s * w * sin(w * time), .v = s * w * cos(w * time)} : (grid_water){0};
}

/* A paraboloid that rises and falls. */
static grid_water breathing(double x, double y, double time)
{
    const double r2 = (x * x + y * y) / (A * A), w = sqrt(8 * G * H0) / A, r0 = 0.8;
    const double e = (1 - r0 * r0 * r0 * r0) / (1 + r0 * r0 * r0 * r0), f = 1 - e * cos(w * time);
    const double surface = H0 * (sqrt(1 - e * e) / f - 1 - r2 * ((1 - e * e) / (f * f) - 1));
    const double h = surface - bowl(x, y), rate = 0.5 * w * e * sin(w * time) / f;
    return h > 0 ? (grid_water){.h = h, .u = rate * x, .v = rate * y} : (grid_water){0};
}

static double bowl_error(size_t columns, grid_state *motion, double period, double periods)
{
    const sb_offshore_options options = {.columns = columns,
                                         .rows = columns,
                                         .x = -2,
                                         .y = -2,
                                         .cell = 4 / (double)columns,
                                         .gravity = G,
                                         .dry_depth = 1e-6};
    sb_offshore *offshore = grid_create(&options, bowl, motion);
    grid_run(offshore, periods * period);
    const double error = grid_error(offshore, motion);
    assert_near(grid_imbalance(offshore), 0, 1e-12);
    sb_offshore_destroy(offshore);
    return error;
}

/* The shore, where the depth has a kink, limits the order to between 1 and 2. */
static void thacker_converges(void **state)
{
    (void)state;
    const double turn = 2 * M_PI * A / sqrt(2 * G * H0), breath = 2 * M_PI * A / sqrt(8 * G * H0);
    const double coarse = bowl_error(80, turning, turn, 1), fine = bowl_error(160, turning, turn, 1);
    assert_true(order_of("turning plane", coarse, fine) > 1.2);
    assert_near(fine / H0, 0, 5e-3);
    const double coarse2 = bowl_error(80, breathing, breath, 1), fine2 = bowl_error(160, breathing, breath, 1);
    assert_true(order_of("breathing paraboloid", coarse2, fine2) > 1.2);
    assert_near(fine2 / H0, 0, 5e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dams_converge),
        cmocka_unit_test(smooth_wave_converges),
        cmocka_unit_test(thacker_converges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Friction, bores, sides, exchange and samples. */
#include "grid_case.h"

static const double G = 9.81;

static double flat(double x, double y)
{
    (void)x;
    (void)y;
    return 0;
}

static grid_water current(double x, double y, double time)
{
    (void)x;
    (void)y;
    (void)time;
    return (grid_water){.h = 0.5, .u = 1.2, .v = -0.9};
}

/* du/dt = -g n^2 u^2 / h^(4/3), so 1/u grows linearly. */
static void friction_stops_a_current(void **state)
{
    (void)state;
    const sb_offshore_side p = SB_OFFSHORE_PERIODIC;
    const sb_offshore_options options = {
        .columns = 4, .rows = 4, .cell = 0.5, .gravity = G, .manning = 0.04, .side = {p, p, p, p}};
    sb_offshore *offshore = grid_create(&options, flat, current);
    grid_run(offshore, 20);
    const sb_offshore_view v = sb_offshore_read(offshore);
    const double speed = hypot(v.hu[0], v.hv[0]) / 0.5;
    const double exact = 1 / (1 / 1.5 + 20 * G * 0.04 * 0.04 / pow(0.5, 4.0 / 3));
    assert_near(speed / exact, 1, 0.01);
    assert_near(v.hv[0] / v.hu[0], -0.75, 1e-12);
    sb_offshore_destroy(offshore);
}

static double incline(double x, double y)
{
    (void)y;
    return -0.002 * x;
}

/* Manning: u = h^(2/3) S^(1/2) / n. */
static double normal_speed(void)
{
    return sqrt(0.002) / 0.03;
}

static grid_water slower(double x, double y, double time)
{
    (void)x;
    (void)y;
    (void)time;
    return (grid_water){.h = 1, .u = 0.5 * normal_speed()};
}

static sb_offshore_water uniform(void *context, double time, double x, double y)
{
    (void)context;
    (void)time;
    const double middle = x <= 0 ? 5 : x - 5; /* of the cell at the side */
    return (sb_offshore_water){.surface = incline(middle, y) + 1, .u = normal_speed()};
}

/* Uniform flow down a slope: friction and weight are in balance, u = h^(2/3) S^(1/2) / n. The sides disturb it over
   h / S = 500 m, so that only the middle counts. */
static void friction_balances_a_slope(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 400,
                                         .rows = 1,
                                         .cell = 10,
                                         .gravity = G,
                                         .manning = 0.03,
                                         .side = {SB_OFFSHORE_GIVEN, SB_OFFSHORE_GIVEN},
                                         .given = uniform};
    sb_offshore *offshore = grid_create(&options, incline, slower);
    grid_run(offshore, 6000);
    const sb_offshore_view v = sb_offshore_read(offshore);
    for (size_t i = 100; i < 250; i++) {
        assert_near(v.h[i], 1, 0.01);
        assert_near(v.hu[i] / v.h[i] / (pow(v.h[i], 2.0 / 3) * normal_speed()), 1, 1e-3);
    }
    sb_offshore_destroy(offshore);
}

static grid_water towards_wall(double x, double y, double time)
{
    (void)x;
    (void)y;
    (void)time;
    return (grid_water){.h = 1, .u = 2};
}

static sb_offshore_water inflow(void *context, double time, double x, double y)
{
    (void)context;
    (void)time;
    (void)x;
    (void)y;
    return (sb_offshore_water){.surface = 1, .u = 2};
}

/* A bore returns from a wall: u0 = (h1 - h0) sqrt(g (h1 + h0) / (2 h0 h1)), speed u0 h0 / (h1 - h0). */
static void bore_returns_from_a_wall(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 400,
                                         .rows = 1,
                                         .cell = 0.1,
                                         .gravity = G,
                                         .side = {SB_OFFSHORE_GIVEN, SB_OFFSHORE_WALL},
                                         .given = inflow};
    sb_offshore *offshore = grid_create(&options, flat, towards_wall);
    grid_run(offshore, 8);
    double low = 1, high = 4;
    for (int k = 0; k < 60; k++) {
        const double h = 0.5 * (low + high);
        if ((h - 1) * sqrt(0.5 * G * (h + 1) / h) < 2)
            low = h;
        else
            high = h;
    }
    const sb_offshore_view v = sb_offshore_read(offshore);
    assert_near(v.h[390], low, 2e-3);
    double front = 0;
    for (size_t i = 0; i < 400 && v.h[i] < 0.5 * (1 + low); i++) front = 40 - 0.1 * ((double)i + 1);
    assert_near(front, 8 * 2 / (low - 1), 0.2);
    sb_offshore_destroy(offshore);
}

static double basin(double x, double y)
{
    (void)y;
    return -10 + 2 * sin(x / 40);
}

static grid_water bump(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = 0.05 * exp(-(x - 200) * (x - 200) / 800) - basin(x, y)};
}

/* Waves of 0.5 % of the depth leave; what stays is what theory reflects from the uneven bed, and less than 1 %. */
static void waves_leave(void **state)
{
    (void)state;
    const sb_offshore_options options = {
        .columns = 200, .rows = 1, .cell = 2, .gravity = G, .side = {SB_OFFSHORE_OPEN, SB_OFFSHORE_OPEN}};
    sb_offshore *offshore = grid_create(&options, basin, bump);
    grid_run(offshore, 200);
    const sb_offshore_view v = sb_offshore_read(offshore);
    for (size_t i = 0; i < 200; i++) assert_near(v.h[i] + v.bed[i], 0, 0.05 * 0.01);
    assert_near(grid_imbalance(offshore), 0, 1e-13);
    sb_offshore_destroy(offshore);
}

static sb_offshore_water incoming(void *context, double time, double x, double y)
{
    (void)context;
    (void)x;
    (void)y;
    const double eta = 0.05 * exp(-(time - 20) * (time - 20) / 20);
    return (sb_offshore_water){.surface = eta, .u = eta * sqrt(G / 10)};
}

static double level_floor(double x, double y)
{
    (void)x;
    (void)y;
    return -10;
}

static grid_water calm(double x, double y, double time)
{
    (void)x;
    (void)y;
    (void)time;
    return (grid_water){.h = 10};
}

/* A wave that is given at one side crosses and leaves at the other: height within 1 %, no reflection above 1 %. */
static void given_wave_crosses(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 200,
                                         .rows = 1,
                                         .cell = 2,
                                         .gravity = G,
                                         .side = {SB_OFFSHORE_GIVEN, SB_OFFSHORE_OPEN},
                                         .given = incoming};
    sb_offshore *offshore = grid_create(&options, level_floor, calm);
    double crest = 0;
    for (int k = 1; k <= 600; k++) {
        grid_run(offshore, 0.1 * k);
        crest = fmax(crest, sb_offshore_at(offshore, 200, 0).water[1].surface);
    }
    assert_near(crest, 0.05, 0.05 * 0.01);
    grid_run(offshore, 120);
    const sb_offshore_view v = sb_offshore_read(offshore);
    for (size_t i = 0; i < 200; i++) assert_near(v.h[i] + v.bed[i], 0, 0.05 * 0.01);
    sb_offshore_destroy(offshore);
}

/* Water that is added and removed is in the balance, and no more is removed than there is. */
static void exchange_is_booked(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 20, .rows = 10, .cell = 2, .gravity = G};
    sb_offshore *offshore = grid_create(&options, level_floor, calm);
    assert_near(sb_offshore_add(offshore, 3, 4, 0.5, 0.1, -0.2), 0.5, 1e-14);
    assert_near(sb_offshore_add(offshore, 5, 5, -20, 0, 0), -10, 1e-14);
    assert_near(sb_offshore_find_balance(offshore).added, 4 * (0.5 - 10), 1e-12);
    const sb_offshore_view v = sb_offshore_read(offshore);
    assert_near(v.hu[4 * v.stride + 3], 0.1, 0);
    assert_near(v.hv[4 * v.stride + 3], -0.2, 0);
    grid_run(offshore, 1);
    assert_near(grid_imbalance(offshore), 0, 1e-13);
    sb_offshore_destroy(offshore);
}

static grid_water tilted(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = 10 + 0.01 * x - 0.02 * y, .u = 0.001 * x, .v = 0.002 * y};
}

/* A linear surface is sampled exactly; rates are differences of the two levels. */
static void samples_are_bilinear(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 20, .rows = 10, .cell = 2, .gravity = G};
    sb_offshore *offshore = grid_create(&options, level_floor, tilted);
    sb_offshore_sample s = sb_offshore_at(offshore, 13.3, 7.7);
    assert_true(s.wet[1]);
    assert_near(s.bed, -10, 1e-14);
    assert_near(s.water[1].surface, 0.133 - 0.154, 1e-12);
    assert_near(s.water[1].u, 0.0133, 1e-5);
    assert_near(s.rate.surface, 0, 0);
    double taken;
    sb_error error = {0};
    assert_int_equal(sb_offshore_step(offshore, 0.05, &taken, &error), SB_OK);
    s = sb_offshore_at(offshore, 13.3, 7.7);
    assert_near(s.time[1] - s.time[0], taken, 1e-15);
    assert_near(s.water[0].surface, 0.133 - 0.154, 1e-12);
    assert_near(s.rate.surface, (s.water[1].surface - s.water[0].surface) / taken, 1e-12);
    assert_near(s.rate.u, -G * 0.01, 0.002);
    assert_near(s.rate.v, G * 0.02, 0.002);
    sb_offshore_destroy(offshore);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(friction_stops_a_current), cmocka_unit_test(friction_balances_a_slope),
        cmocka_unit_test(bore_returns_from_a_wall), cmocka_unit_test(waves_leave),
        cmocka_unit_test(given_wave_crosses),       cmocka_unit_test(exchange_is_booked),
        cmocka_unit_test(samples_are_bilinear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

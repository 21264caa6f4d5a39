/* A paddle that absorbs, in a flume of long waves: it stays at its law over a hundred periods. The flume is Lagrangian
   columns of water of equal mass with hydrostatic pressure, which is the nonlinear theory of long waves, mean values of
   second order included. */
#include "check.h"
#include "physics/absorption/absorbing.h"
#include "physics/waves/dispersion.h"

#include <stdio.h>

enum { CELLS = 150, PERIODS = 100, TENTHS = PERIODS / 10 };
static const double GRAVITY = 9.81, DEPTH = 1, KD = 0.2, HEIGHT = 0.04;

typedef struct flume {
    double x[CELLS + 1], v[CELLS + 1]; /* m, m/s: edges of the columns; the first is the paddle's face */
    double mass;                       /* m^2, volume of a column */
    double length, sponge;             /* m, of the flume, and of the zone before its far wall that slows water down */
} flume;

static void begin(flume *f, double length, double sponge)
{
    *f = (flume){.mass = DEPTH * length / CELLS, .length = length, .sponge = sponge};
    for (int i = 0; i <= CELLS; i++) f->x[i] = length * i / CELLS;
}

static double depth_of(const flume *f, int i)
{
    return f->mass / (f->x[i + 1] - f->x[i]);
}

static void step(flume *f, double face, double omega, double dt)
{
    for (int i = 1; i < CELLS; i++) {
        const double before = depth_of(f, i - 1), behind = depth_of(f, i);
        const double within = fmax(f->x[i] - f->length + f->sponge, 0);
        const double part = f->sponge > 0 ? within / f->sponge : 0;
        f->v[i] += 0.5 * GRAVITY * (before * before - behind * behind) / f->mass * dt;
        f->v[i] *= exp(-2.6 * omega * part * part * dt);
    }
    for (int i = 1; i < CELLS; i++) f->x[i] += f->v[i] * dt;
    f->x[0] = face;
}

/* What one run shows: means of the offset over each ten periods, and its largest half range in one of the last ten, all
   over the stroke. */
typedef struct outcome {
    double drift[TENTHS], swing;
} outcome;

/* Long waves of a height, made by a piston whose law has no mean. second: whether it knows the mean of its surface. */
static outcome run(double wavelengths, double sponge, bool second)
{
    const double k = KD / DEPTH, omega = k * sqrt(GRAVITY * DEPTH), period = 2 * M_PI / omega;
    const double stroke = 0.5 * HEIGHT / KD, distance = 0.01, length = 2 * M_PI / k;
    const sb_band_part band = {omega, 1};
    /* Without dispersion the gain is omega/kd; the filter's own is that of linear theory. */
    sb_absorbing_filter filter =
        sb_absorbing_filter_of(SB_PADDLE_PISTON, &band, 1, omega / 40, DEPTH, GRAVITY, distance);
    if (!second) filter.square = 0, filter.gravity = (double)INFINITY;
    sb_absorbing_state state = {0};
    outcome found = {{0}, 0};
    flume f;
    begin(&f, wavelengths * length, sponge * length);
    const int steps = (int)(600 / wavelengths); /* a Courant number of 1/4 */
    const double dt = period / steps;
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (int n = 0; n < PERIODS * steps; n++) {
        const double t = n * dt, later = t + dt, ramp = fmin(0.5 * t / period, 1),
                     grown = fmin(0.5 * later / period, 1);
        const double law = grown * stroke * sin(omega * later), had = ramp * stroke * sin(omega * t);
        const sb_absorbing_input input = {.surface = depth_of(&f, 0) - DEPTH,
                                          .expected = ramp * 0.5 * HEIGHT * cos(omega * t - k * distance),
                                          .law_speed = (law - had) / dt,
                                          .least = -DEPTH,
                                          .most = DEPTH};
        assert_false(sb_absorbing_advance(&filter, &input, dt, &state));
        step(&f, law + state.offset, omega, dt);
        found.drift[n / (10 * steps)] += state.offset / (20 * stroke * steps);
        if (n < (PERIODS - 10) * steps) continue;
        least = fmin(least, state.offset), most = fmax(most, state.offset);
    }
    found.swing = (most - least) / (2 * stroke);
    return found;
}

static double worst(const outcome *of, int first)
{
    double most = 0;
    for (int i = first; i < TENTHS; i++) most = fmax(most, fabs(of->drift[i]));
    return most;
}

static void show(const char *name, const outcome *of)
{
    printf("%s: mean displacement over the stroke, each ten periods:", name);
    for (int i = 0; i < TENTHS; i++) printf(" %.2f", 100 * of->drift[i]);
    printf(" %%, swing %.3g\n", of->swing);
}

/* Waves of a = 0.02 d. Without the mean of second order the paddle gives way by several per cent; with it, by less than
 * 1 %. */
static void it_stays_before_a_sponge(void **state)
{
    (void)state;
    const outcome blind = run(3, 1, false), one = run(3, 1, true);
    show("without the mean", &blind);
    show("with it", &one);
    assert_true(worst(&blind, 1) > 0.02);
    assert_true(worst(&one, 1) < 0.01);
}

/* With waves that return from a wall at several distances the paddle moves by as much as its law; its mean place is off
   by less than half as much as without the mean, and by less than 1 % of the stroke after 60 periods. */
static void it_stays_before_a_wall(void **state)
{
    (void)state;
    static const double lengths[] = {0.65, 1.1, 2.3, 4};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        const outcome blind = run(lengths[i], 0, false), one = run(lengths[i], 0, true);
        char name[48];
        snprintf(name, sizeof name, "wall at %g wavelengths, without", lengths[i]);
        show(name, &blind);
        show("with", &one);
        assert_true(one.swing > 0.8 && one.swing < 1.1);
        assert_true(worst(&one, 1) < 0.5 * worst(&blind, 1));
        assert_true(worst(&one, 6) < 0.01);
    }
}

/* The mean is that of a simple wave of long waves: a^2/(8 d) at the face, where the mean at a place near it is
   -3 a^2/(8 d). */
static void the_mean_is_that_of_long_waves(void **state)
{
    (void)state;
    const double a = 0.01, kd = 1e-3, stroke = a / kd, omega = kd * sqrt(GRAVITY);
    const double mean =
        0.25 * omega * omega * stroke * stroke / GRAVITY + sb_paddle_mean_of_square(kd, 1) * 0.5 * a * a;
    assert_true(fabs(mean / (0.5 * a * a) - 1) < 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_is_that_of_long_waves),
        cmocka_unit_test(it_stays_before_a_sponge),
        cmocka_unit_test(it_stays_before_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The law that lets waves out, against linear potential theory: all modes of the water beside a boundary that moves by
   the law, the near field in the measured water included. Depth 1, g 1; time as exp(i w t), x inwards. */
#include "../check.h"
#include "physics/absorption/outgoing.h"
#include "physics/waves/dispersion.h"

#include <complex.h>

enum { MODES = 40, HEIGHTS = 400 };

/* Decay rates inwards: i k of the wave, and those of the near field, w^2 = -q tan q. */
static void modes_of(double omega, double complex q[MODES])
{
    q[0] = CMPLX(0, sb_wave_number(2 * M_PI / omega, 1, 1));
    for (int n = 1; n < MODES; n++) {
        double low = (n - 0.5) * M_PI, high = n * M_PI;
        for (int i = 0; i < 60; i++) {
            const double middle = 0.5 * (low + high);
            if (omega * omega + middle * tan(middle) < 0)
                low = middle;
            else
                high = middle;
        }
        q[n] = 0.5 * (low + high);
    }
}

/* Integral over the depth, by Simpson's rule. */
static double complex over_depth(double complex q, double complex mean, double complex curvature, bool squared)
{
    double complex sum = 0;
    for (int i = 0; i <= HEIGHTS; i++) {
        const double z = (double)i / HEIGHTS, weight = i == 0 || i == HEIGHTS ? 1 : i % 2 ? 4 : 2;
        const double complex psi = ccos(q * z);
        sum += weight / (3 * HEIGHTS) * psi * (squared ? psi : mean + curvature * (1.0 / 6 - 0.5 * z * z));
    }
    return sum;
}

/* u - 2 sqrt(g h) of a mode whose velocity at the boundary is cos(q z), as it is measured. */
static double complex measured(double complex q, double omega, double distance)
{
    double complex mean = 0, weights = 0;
    for (int i = 1; i < HEIGHTS; i++) {
        const double s = distance * (2.0 * i / HEIGHTS - 1), weight = 1 + cos(M_PI * s / distance);
        mean += weight * cexp(-q * (distance + s));
        weights += weight;
    }
    return mean / weights * (csin(q) / q - CMPLX(0, omega) * ccos(q) / q);
}

/* What comes back of a wave that reaches the boundary, and the gain of the loop through the near field. */
static double complex returned(double omega, double distance, double complex *loop)
{
    const sb_outgoing_law law = sb_outgoing_law_make(1, distance, 0, 1);
    const double complex s = CMPLX(0, omega), y = 1 / (1 + law.lag * s + law.inertia * s * s);
    const double complex mean = 0.5 * y * (1 + law.lead * s * s), curvature = 0.5 * y * s * s;
    double complex q[MODES], made = 0;
    modes_of(omega, q);
    *loop = 0;
    for (int n = 0; n < MODES; n++) {
        const double complex a = over_depth(q[n], mean, curvature, false) / over_depth(q[n], 0, 0, true);
        *loop += a * measured(q[n], omega, distance);
        if (n == 0) made = a;
    }
    /* The wave that leaves, cos(q z) at the boundary, and what a boundary at rest in its place would send back. */
    const double complex arrives = measured(-q[0], omega, distance), sent = measured(q[0], omega, distance);
    return made * (arrives - sent) / (1 - *loop) - 1;
}

static void assert_below(const char *what, double value, double bar)
{
    if (!(value < bar)) fail_msg("%s: %g, expected below %g", what, value, bar);
}

static double omega_of(double kh)
{
    return sqrt(kh * tanh(kh));
}

static void no_wave_comes_back(void **state)
{
    (void)state;
    static const double distance[] = {0.25, 0.3, 0.5, 0.75};
    double complex loop;
    for (size_t d = 0; d < sizeof distance / sizeof *distance; d++) {
        assert_below("kh 0.1", cabs(returned(omega_of(0.1), distance[d], &loop)), 0.001);
        for (double kh = 0.2; kh <= 1.2; kh += 0.1)
            assert_below("shorter waves", cabs(returned(omega_of(kh), distance[d], &loop)),
                         distance[d] <= 0.5 ? 0.011 : 0.025);
        assert_below("kh 1.2", cabs(returned(1, distance[d], &loop)), 0.01);
    }
    assert_below("kh 0.3, distance 1.5", cabs(returned(omega_of(0.3), 1.5, &loop)), 0.02);
    assert_below("kh 0.1, distance 3", cabs(returned(omega_of(0.1), 3, &loop)), 0.02);
}

static void waves_of_one_and_a_half_come_back_by_a_per_cent(void **state)
{
    (void)state;
    double complex loop;
    assert_below("distance 0.25", cabs(returned(omega_of(1.5), 0.25, &loop)), 0.01);
    assert_below("distance 0.3", cabs(returned(omega_of(1.5), 0.3, &loop)), 0.012);
}

/* By Nyquist: 1 - loop does not go round 0, and stays away from it. */
static void the_loop_through_the_near_field_is_stable(void **state)
{
    (void)state;
    static const double distance[] = {0.25, 0.3, 0.5, 1, 2};
    for (size_t d = 0; d < sizeof distance / sizeof *distance; d++) {
        double turned = 0, last = 0;
        for (double omega = 0.05; omega < 20; omega += 0.05) {
            double complex loop;
            returned(omega, distance[d], &loop);
            const double angle = carg(1 - loop);
            assert_below("nearness to 0", 1 / cabs(1 - loop), 2);
            turned += angle - last;
            assert_true(fabs(angle - last) < 1);
            last = angle;
        }
        assert_below("turn", fabs(turned), 0.3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_wave_comes_back),
        cmocka_unit_test(waves_of_one_and_a_half_come_back_by_a_per_cent),
        cmocka_unit_test(the_loop_through_the_near_field_is_stable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Second-order motion of a piston: against a solution of its boundary value problem by finite volumes, which has no
   free wave; long waves have Madsen's motion. */
#include "base/memory.h"
#include "check.h"
#include "physics/wavemakers/paddle_second.h"
#include "physics/waves/dispersion.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>

static const double GRAVITY = 9.81;

/* First-order potential P of a piston at Re(X1 exp(i omega t)), its surface A, and what they ask of the second order.
 */
enum { MODES = 800 };

typedef struct linear {
    double omega, depth, number;
    double complex motion;
    double complex k[MODES + 1], c[MODES + 1];
} linear;

typedef struct at_place {
    double complex x, z, xx, zz, surface; /* derivatives of P */
} at_place;

static void make(linear *l, double kd, double height, double depth)
{
    l->depth = depth;
    l->number = kd / depth;
    l->omega = sqrt(GRAVITY * l->number * tanh(kd));
    l->motion = -0.5 * CMPLX(0, 1) * height * (2 * kd + sinh(2 * kd)) / (4 * pow(sinh(kd), 2));
    for (int j = 0; j <= MODES; j++) {
        const double y = l->omega * l->omega * depth / GRAVITY;
        const double x = j == 0 ? kd : sb_evanescent_root(j, y);
        const double complex k = j == 0 ? x / depth : -CMPLX(0, 1) * x / depth;
        /* i omega X1 int cosh = -i k c int cosh^2 */
        const double mean =
            j == 0 ? 0.5 * depth * (1 + sinh(2 * x) / (2 * x)) : 0.5 * depth * (1 + sin(2 * x) / (2 * x));
        const double across = depth * (j == 0 ? sinh(x) : sin(x)) / x;
        l->k[j] = k;
        l->c[j] = -l->omega * l->motion / k * across / mean;
    }
}

static at_place look(const linear *l, double x, double z, int first)
{
    at_place a = {0};
    for (int j = first; j <= MODES; j++) {
        const double complex k = l->k[j], e = l->c[j] * cexp(-CMPLX(0, 1) * k * x), ik = CMPLX(0, 1) * k;
        const double complex cosine = e * ccosh(k * (z + l->depth)), sine = e * csinh(k * (z + l->depth));
        a.x -= ik * cosine;
        a.z += k * sine;
        a.xx -= k * k * cosine;
        a.zz += k * k * cosine;
        a.surface -= CMPLX(0, 1) * l->omega / GRAVITY * cosine;
    }
    return a;
}

static double complex forcing(const linear *l, at_place a)
{
    return -CMPLX(0, 1) * l->omega * (a.x * a.x + a.z * a.z) -
           0.5 * a.surface * (GRAVITY * a.zz - l->omega * l->omega * a.z);
}

/* Complex amplitude of the free wave's surface far away, with the second-order motion X: potential less that of the
   bound wave, in cells of a strip of six depths, DEEP over the depth. */
static double complex free_wave_by(int DEEP, const linear *l, double complex motion)
{
    const int LONG = 6 * DEEP, N = DEEP * LONG, BAND = 2 * DEEP + 1;
    const double h = l->depth / DEEP, w = l->omega, K = sb_wave_number(M_PI / w, l->depth, GRAVITY);
    const double complex i = CMPLX(0, 1), k2 = 2 * l->number;
    linear *alone = sb_alloc(1, sizeof *alone);
    double complex *m = sb_alloc((size_t)N * (size_t)BAND, sizeof *m), *q = sb_alloc((size_t)N, sizeof *q);
    assert_true(alone && m && q);
    *alone = *l;
    for (int j = 1; j <= MODES; j++) alone->c[j] = 0;
    const double complex steady = forcing(alone, look(alone, 0, 0, 0));
    const double complex bound = steady / (GRAVITY * k2 * csinh(k2 * l->depth) - 4 * w * w * ccosh(k2 * l->depth));
#define AT(row, column) m[(size_t)(row) * (size_t)BAND + (size_t)((column) - (row) + DEEP)]
    for (int c = 0; c < LONG; c++)
        for (int r = 0; r < DEEP; r++) {
            const int n = c * DEEP + r;
            const double x = (c + 0.5) * h, z = (r + 0.5) * h - l->depth;
            if (c > 0) AT(n, n - DEEP) += 1, AT(n, n) -= 1;
            if (c + 1 < LONG) AT(n, n + DEEP) += 1, AT(n, n) -= 1;
            if (r > 0) AT(n, n - 1) += 1, AT(n, n) -= 1;
            if (r + 1 < DEEP) AT(n, n + 1) += 1, AT(n, n) -= 1;
            if (c + 1 == LONG) AT(n, n) -= i * K * h / (1 + 0.5 * i * K * h);
            if (r + 1 == DEEP) {
                const double complex rest = forcing(l, look(l, x, 0, 0)) - steady * cexp(-i * k2 * x);
                AT(n, n) += 4 * w * w * h / (GRAVITY - 2 * w * w * h);
                q[n] -= rest * h / (GRAVITY - 2 * w * w * h);
            }
            if (c == 0) {
                const double complex of_bound = -i * k2 * bound * ccosh(k2 * (z + l->depth));
                q[n] += h * (2 * i * w * motion - 0.5 * l->motion * look(l, 0, z, 0).xx - of_bound);
            }
        }
    for (int n = 0; n < N; n++)
        for (int row = n + 1; row <= n + DEEP && row < N; row++) {
            const double complex f = AT(row, n) / AT(n, n);
            if (f == 0) continue;
            for (int column = n; column <= n + DEEP && column < N; column++) AT(row, column) -= f * AT(n, column);
            q[row] -= f * q[n];
        }
    for (int n = N - 1; n >= 0; n--) {
        for (int column = n + 1; column <= n + DEEP && column < N; column++) q[n] -= AT(n, column) * q[column];
        q[n] /= AT(n, n);
    }
#undef AT
    double complex share = 0;
    double whole = 0;
    for (int r = 0; r < DEEP; r++) {
        const double cosine = cosh(K * (r + 0.5) * h);
        share += q[(LONG - 1) * DEEP + r] * cosine;
        whole += cosine * cosine;
    }
    sb_free(alone);
    sb_free(m);
    sb_free(q);
    return 2 * w / GRAVITY * share / whole * cosh(K * l->depth);
}

/* The error of the cells falls as their size, unless they are coarse for the free wave, as at kd 2.5. */
static double free_wave(const linear *l, double complex motion)
{
    return cabs(2 * free_wave_by(64, l, motion) - free_wave_by(32, l, motion));
}

static void no_free_wave_leaves(void **state)
{
    (void)state;
    static const double kds[] = {0.5, 1, 1.5, 2.5}, most[] = {0.01, 0.01, 0.01, 0.06};
    for (size_t n = 0; n < sizeof kds / sizeof *kds; n++) {
        const double kd = kds[n], height = 0.1, depth = 0.8;
        linear *l = sb_alloc(1, sizeof *l);
        assert_non_null(l);
        make(l, kd, height, depth);
        const double complex second = sb_paddle_second(height, l->omega, depth, GRAVITY);
        const double without = free_wave(l, 0), with = free_wave(l, second);
        const double e = height * height / (32 * depth) *
                         (3 * cosh(kd) / pow(sinh(kd), 3) - 0.5 * (2 * kd + sinh(2 * kd)) / pow(sinh(kd), 2));
        printf("kd %.1f: free wave %.3f mm with linear motion, %.3f with Madsen's, %.3f with second-order motion\n", kd,
               1e3 * without, 1e3 * free_wave(l, -CMPLX(0, 1) * e), 1e3 * with);
        assert_true(with < most[n] * without);
        sb_free(l);
    }
}

static void long_waves_have_the_published_motion(void **state)
{
    (void)state;
    for (double kd = 0.05; kd < 0.35; kd += 0.05) {
        const double depth = 0.4, height = 0.003, omega = sqrt(GRAVITY * kd / depth * tanh(kd));
        const double w = 4 * pow(sinh(kd), 2) / (2 * kd + sinh(2 * kd));
        const double e = height * height / (32 * depth) * (3 * cosh(kd) / pow(sinh(kd), 3) - 2 / w);
        const double complex second = sb_paddle_second(height, omega, depth, GRAVITY);
        assert_true(cabs(second - -CMPLX(0, 1) * e) < 0.15 * kd * kd * e);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_free_wave_leaves),
                                       cmocka_unit_test(long_waves_have_the_published_motion)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

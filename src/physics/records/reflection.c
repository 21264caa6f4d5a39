/* Incident and reflected waves from gauges in a line. */
#include "physics/records/reflection.h"

#include <complex.h>
#include <limits.h>
#include <math.h>

/* Two samples per period are 0 of a sine; numbers of a scene are rounded. */
int sb_harmonics_most(double period, double interval)
{
    const double samples = 0.5 * period / interval * (1 - 1e-9);
    return samples < INT_MAX ? (int)ceil(samples) - 1 : INT_MAX;
}

/* The sums are the upper triangle of the normal matrix, row by row in full rows, then its right-hand side. */
static size_t terms_of(int harmonics)
{
    return 2 * (size_t)harmonics + 1;
}

size_t sb_harmonics_size(int harmonics)
{
    const size_t n = terms_of(harmonics);
    return n * n + n;
}

/* The functions of the fit at a phase: 1, cos, sin, cos 2, sin 2, ... */
static double function_of(size_t i, double phase)
{
    const double angle = (double)((i + 1) / 2) * phase;
    return i == 0 ? 1 : i % 2 ? cos(angle) : sin(angle);
}

void sb_harmonics_add(double *sums, int harmonics, double omega, double t, double value)
{
    const size_t n = terms_of(harmonics);
    const double phase = fmod(omega * t, 2 * M_PI);
    for (size_t i = 0; i < n; i++) {
        const double f = function_of(i, phase);
        for (size_t j = i; j < n; j++) sums[i * n + j] += f * function_of(j, phase);
        sums[n * n + i] += f * value;
    }
}

/* Cholesky's factor U of the matrix, in place. A pivot is the part of a function that the earlier ones do not explain.
   It is compared with the number of samples: a sine may be 0 at all of them but for rounding. */
static bool factorise(double *a, size_t n)
{
    const double samples = a[0];
    for (size_t i = 0; i < n; i++) {
        double pivot = a[i * n + i];
        for (size_t k = 0; k < i; k++) pivot -= a[k * n + i] * a[k * n + i];
        if (!(pivot > 1e-6 * samples)) return false;
        a[i * n + i] = sqrt(pivot);
        for (size_t j = i + 1; j < n; j++) {
            double sum = a[i * n + j];
            for (size_t k = 0; k < i; k++) sum -= a[k * n + i] * a[k * n + j];
            a[i * n + j] = sum / a[i * n + i];
        }
    }
    return true;
}

bool sb_harmonics_solve(const double *sums, int harmonics, double *scratch, double *cosines, double *sines)
{
    const size_t n = terms_of(harmonics);
    if (!(sums[0] >= (double)n)) return false; /* the number of samples */
    for (size_t i = 0; i < n * n + n; i++) scratch[i] = sums[i];
    double *a = scratch, *x = scratch + n * n;
    if (!factorise(a, n)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++) x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (int h = 0; h < harmonics; h++) {
        cosines[h] = x[2 * h + 1];
        sines[h] = x[2 * h + 2];
    }
    return true;
}

static double complex turned(double angle)
{
    return CMPLX(cos(angle), sin(angle));
}

double sb_split_separation(const double *x, size_t count, double number)
{
    double complex sum = 0;
    for (size_t i = 0; i < count; i++) sum += turned(2 * number * (x[i] - x[0]));
    return fmax(1 - cabs(sum) / (double)count, 0);
}

/* With z = A - iB the surface is Re(z exp(iwt)), and z = a exp(-ikx) + b exp(ikx). The normal equations are
   n a + s b = p and conj(s) a + n b = q, with s the sum of exp(2ikx), p of z exp(ikx), q of z exp(-ikx). */
sb_split sb_split_of(const double *x, const double *cosines, const double *sines, size_t count, double number)
{
    const double n = (double)count;
    double complex s = 0, p = 0, q = 0;
    const double none = (double)NAN;
    sb_split split = {none, none, none, sb_split_separation(x, count, number), none, none};
    for (size_t i = 0; i < count; i++) {
        const double complex e = turned(number * (x[i] - x[0])), z = CMPLX(cosines[i], -sines[i]);
        s += e * e;
        p += z * e;
        q += z * conj(e);
    }
    const double determinant = n * n - creal(s * conj(s));
    if (!(determinant > 1e-8 * n * n)) return split;
    const double complex a = (n * p - s * q) / determinant, b = (n * q - conj(s) * p) / determinant;
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        const double complex e = turned(number * (x[i] - x[0]));
        const double rest = cabs(CMPLX(cosines[i], -sines[i]) - a * conj(e) - b * e);
        square += rest * rest;
    }
    split.incident = cabs(a);
    split.reflected = cabs(b);
    split.misfit = sqrt(square / n);
    return split;
}

/* Free incident and reflected wave, bound incident and reflected wave. */
enum { WAVES = 4 };

/* The waves exp(-i k_m x) at a place. */
static void waves_at(double x, double free, double bound, double complex waves[WAVES])
{
    const double numbers[WAVES] = {free, -free, bound, -bound};
    for (int m = 0; m < WAVES; m++) waves[m] = turned(-numbers[m] * x);
}

/* The normal matrix over the number of places, whose diagonal is 1. */
static void normal_matrix(const double *x, size_t count, double free, double bound, double complex g[WAVES][WAVES])
{
    double complex waves[WAVES];
    for (int m = 0; m < WAVES; m++)
        for (int l = 0; l < WAVES; l++) g[m][l] = 0;
    for (size_t i = 0; i < count; i++) {
        waves_at(x[i] - x[0], free, bound, waves);
        for (int m = 0; m < WAVES; m++)
            for (int l = 0; l < WAVES; l++) g[m][l] += conj(waves[m]) * waves[l] / (double)count;
    }
}

/* Cholesky's factor L of a Hermitian matrix less `shift` on its diagonal. False: that matrix is not positive. */
static bool factorise_waves(double complex g[WAVES][WAVES], double shift, double complex lower[WAVES][WAVES])
{
    for (int m = 0; m < WAVES; m++)
        for (int l = 0; l <= m; l++) {
            double complex sum = g[m][l] - (m == l ? shift : 0);
            for (int k = 0; k < l; k++) sum -= lower[m][k] * conj(lower[l][k]);
            if (m == l && !(creal(sum) > 1e-14)) return false;
            lower[m][l] = m == l ? sqrt(creal(sum)) : sum / lower[l][l];
        }
    return true;
}

double sb_split_bound_separation(const double *x, size_t count, double free, double bound)
{
    double complex g[WAVES][WAVES], lower[WAVES][WAVES];
    double below = 0, above = 1; /* the mean of the eigenvalues is 1 */
    normal_matrix(x, count, free, bound, g);
    for (int i = 0; i < 40; i++) { /* to 1e-12 */
        const double middle = 0.5 * (below + above);
        *(factorise_waves(g, middle, lower) ? &below : &above) = middle;
    }
    return below;
}

sb_split sb_split_bound_of(const double *x, const double *cosines, const double *sines, size_t count, double free,
                           double bound)
{
    const double none = (double)NAN;
    double complex g[WAVES][WAVES], lower[WAVES][WAVES], waves[WAVES], a[WAVES] = {0};
    sb_split split = {none, none, none, sb_split_bound_separation(x, count, free, bound), none, none};
    normal_matrix(x, count, free, bound, g);
    if (split.separation < 1e-8 || !factorise_waves(g, 0, lower)) return split;
    for (size_t i = 0; i < count; i++) {
        waves_at(x[i] - x[0], free, bound, waves);
        for (int m = 0; m < WAVES; m++) a[m] += conj(waves[m]) * CMPLX(cosines[i], -sines[i]) / (double)count;
    }
    for (int m = 0; m < WAVES; m++) {
        for (int k = 0; k < m; k++) a[m] -= lower[m][k] * a[k];
        a[m] /= lower[m][m];
    }
    for (int m = WAVES; m-- > 0;) {
        for (int k = m + 1; k < WAVES; k++) a[m] -= conj(lower[k][m]) * a[k];
        a[m] /= lower[m][m];
    }
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        double complex rest = CMPLX(cosines[i], -sines[i]);
        waves_at(x[i] - x[0], free, bound, waves);
        for (int m = 0; m < WAVES; m++) rest -= a[m] * waves[m];
        square += creal(rest * conj(rest));
    }
    split.incident = cabs(a[0]);
    split.reflected = cabs(a[1]);
    split.bound_incident = cabs(a[2]);
    split.bound_reflected = cabs(a[3]);
    split.misfit = sqrt(square / (double)count);
    return split;
}
